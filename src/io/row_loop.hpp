// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "kappa/core/execution.hpp"

namespace kappa::io {

/// Calls `row(i)` for each of `count` rows, with progress and cancellation between blocks.
template <class Row>
void for_each_row(std::size_t count, const Execution& run, Row&& row) {
  constexpr std::size_t kBlock = 16384;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    check_cancelled(run);
    if (run.progress) run.progress(static_cast<double>(begin) / static_cast<double>(count));
    for (std::size_t i = begin; i < count && i < begin + kBlock; ++i) row(i);
  }
}

}  // namespace kappa::io
