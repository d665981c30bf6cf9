// SPDX-License-Identifier: BSD-3-Clause
#include "sort_by_key.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace kappa {

void sort_by_key(std::vector<Keyed>& keyed, const Execution& run) {
  constexpr int kBits = 11, kPasses = 6;  // of 64 bits
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  const auto less = [](const Keyed& a, const Keyed& b) { return a.key < b.key; };
  if (std::is_sorted(keyed.begin(), keyed.end(), less)) return;
  if (keyed.size() < kDigits) {
    std::stable_sort(keyed.begin(), keyed.end(), less);
    return;
  }
  // Digit by digit, the last first. Digits that are the same in all keys are left out.
  const auto digit = [](const Keyed& entry, int pass) { return entry.key >> kBits * pass & (kDigits - 1); };
  std::vector<std::array<Index, kDigits>> places(kPasses);  // of each digit, how many there are; then where they start
  for (const Keyed& entry : keyed) {
    for (int pass = 0; pass < kPasses; ++pass) ++places[static_cast<std::size_t>(pass)][digit(entry, pass)];
  }
  std::vector<Keyed> sorted(keyed.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    report_progress(run, static_cast<double>(pass) / kPasses);
    auto& first = places[static_cast<std::size_t>(pass)];
    if (first[digit(keyed[0], pass)] == keyed.size()) continue;
    Index before = 0;
    for (Index& place : first) before += std::exchange(place, before);
    for (const Keyed& entry : keyed) sorted[first[digit(entry, pass)]++] = entry;
    keyed.swap(sorted);
  }
}

}  // namespace kappa
