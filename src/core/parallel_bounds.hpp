// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/bounds.hpp"
#include "kappa/core/execution.hpp"

namespace kappa {

/// The bounds of what `add(i, bounds)` adds for every i below `count`. `add` may be called on any thread.
/// @throws Cancelled as `parallel_for` does.
template <class Add>
Bounds parallel_bounds(std::size_t count, const Execution& run, const Add& add) {
  constexpr std::size_t kBlock = 16384;
  std::vector<Bounds> parts((count + kBlock - 1) / kBlock);
  parallel_for(count, kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    Bounds part;
    for (std::size_t i = begin; i < end; ++i) add(i, part);
    parts[begin / kBlock] = part;
  });
  Bounds all;
  for (const Bounds& part : parts) {
    all.min = all.min.cwiseMin(part.min);
    all.max = all.max.cwiseMax(part.max);
  }
  return all;
}

}  // namespace kappa
