// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/percentiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace kappa {
namespace {

TEST(Statistics, MedianIsTheGreaterOfTwoInTheMiddle) {
  std::vector<double> values = {4, 1, 3, 2};
  EXPECT_EQ(median(values), 3);
  values = {3, 1, 2};
  EXPECT_EQ(median(values), 2);
  values.clear();
  EXPECT_TRUE(std::isnan(median(values)));
}

TEST(Statistics, PercentilesAreRankedValues) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(-0.3, 1);
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{1000}, std::size_t{50001}}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      const double v = normal(random);
      values.push_back(i % 3 ? v : i % 2 ? std::exp(20 * v) : std::round(v) * 1e-3);  // also far apart, and many equal
    }
    if (count > 2) values[1] = HUGE_VAL, values[2] = -HUGE_VAL;
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::vector<double> parts = {0.0, 1.0, 37.5, 50.0, 99.0, 100.0}, together = percentiles(values, parts);
    for (const double p : parts) {
      const auto rank = static_cast<std::size_t>(std::llround(p / 100 * static_cast<double>(count - 1)));
      EXPECT_EQ(percentile(values, p), sorted[rank]) << p << " of " << count;
      const auto at = std::find(parts.begin(), parts.end(), p) - parts.begin();
      EXPECT_EQ(together[static_cast<std::size_t>(at)], sorted[rank]) << p << " of " << count << " with others";
    }
  }
  std::vector<double> none;
  EXPECT_TRUE(std::isnan(percentile(none, 50)));
}

}  // namespace
}  // namespace kappa
