// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kappa/core/decimal.hpp"

namespace kappa {
namespace {

TEST(Decimal, IsTheShortest) {
  EXPECT_EQ(decimal(0), "0");
  EXPECT_EQ(decimal(-0.0), "-0");
  EXPECT_EQ(decimal(0.1), "0.1");
  EXPECT_EQ(decimal(0.1 + 0.2), "0.30000000000000004");
  EXPECT_EQ(decimal(-1.5), "-1.5");
}

TEST(Decimal, HasAnExponentOnlyFarFromOne) {
  EXPECT_EQ(decimal(500000), "500000");
  EXPECT_EQ(decimal(999999999999999), "999999999999999");
  EXPECT_EQ(decimal(1e15), "1e+15");
  EXPECT_EQ(decimal(0.0001), "0.0001");
  EXPECT_EQ(decimal(0.00005), "5e-05");
}

TEST(Decimal, WritesWhatIsNoNumber) {
  EXPECT_EQ(decimal(std::nan("")), "nan");
  EXPECT_EQ(decimal(-std::nan("")), "nan");
  EXPECT_EQ(decimal(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Decimal, GivesBackEveryValue) {
  constexpr unsigned kSeed = 20261128;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    ASSERT_EQ(std::stod(decimal(value)), value);
    ASSERT_EQ(std::stod(decimal(-value)), -value);
  }
}

TEST(Decimal, IsAppended) {
  std::string text = "r = ";
  append_decimal(text, 0.25);
  EXPECT_EQ(text, "r = 0.25");
}

}  // namespace
}  // namespace kappa
