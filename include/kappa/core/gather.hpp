// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// The values that stand at the places `from`: values[from[0]], values[from[1]], ... If there are no values, as for an
/// attribute that a cloud lacks, the result has none. Otherwise every place must be below values.size(); this is not
/// checked.
/// @throws Cancelled as `serial_for` does.
template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<Index>& from, const Execution& run = {}) {
  constexpr std::size_t kBlock = 16384;
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(from.size());
  serial_for(from.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.push_back(values[from[i]]);
  });
  return result;
}

}  // namespace kappa
