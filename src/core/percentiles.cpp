// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/percentiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "kappa/core/types.hpp"

namespace kappa {
namespace {

double nth_of(std::vector<double>& values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Whole numbers in the order of the values: the first bits of the values, those of negative ones turned over.
std::size_t bucket_of(double value) {
  constexpr int kRest = 48;
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63) >> kRest;
}

/// Values of the given ranks by counting: choosing a side for each value, as nth_element does, is a guess that is wrong
/// half of the time.
std::vector<double> nth_of_many(const std::vector<double>& values, std::vector<std::size_t> ranks) {
  constexpr std::size_t kBuckets = std::size_t{1} << 16;
  std::vector<std::uint32_t> counts(kBuckets);
  for (const double v : values) ++counts[bucket_of(v)];
  std::vector<char> wanted(kBuckets);
  std::vector<std::size_t> buckets;
  for (std::size_t& rank : ranks) {  // from here on among those of its bucket
    std::size_t bucket = 0;
    for (; rank >= counts[bucket]; ++bucket) rank -= counts[bucket];
    buckets.push_back(bucket);
    wanted[bucket] = 1;
  }
  std::vector<double> chosen;
  for (const double v : values) {
    if (wanted[bucket_of(v)]) chosen.push_back(v);
  }
  std::vector<double> found, of_bucket;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    of_bucket.clear();
    std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(of_bucket),
                 [&](double v) { return bucket_of(v) == buckets[i]; });
    found.push_back(nth_of(of_bucket, ranks[i]));
  }
  return found;
}

}  // namespace

double percentile(std::vector<double>& values, double p) {
  return percentiles(values, {p}).front();
}

double median(std::vector<double>& values) {
  return percentile(values, 50);
}

std::vector<double> percentiles(std::vector<double>& values, const std::vector<double>& p) {
  if (values.empty()) return std::vector<double>(p.size(), kNaN);
  constexpr std::size_t kMany = 20000;
  std::vector<std::size_t> ranks;
  for (const double part : p)
    ranks.push_back(static_cast<std::size_t>(std::llround(part / 100 * static_cast<double>(values.size() - 1))));
  if (values.size() >= kMany) return nth_of_many(values, ranks);
  std::vector<double> found;
  for (const std::size_t rank : ranks) found.push_back(nth_of(values, rank));
  return found;
}

}  // namespace kappa
