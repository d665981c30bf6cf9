// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "kappa/core/execution.hpp"

class vtkAlgorithm;

namespace kappa::view_detail {

/// Passes progress on to an Execution, but ten times a second at most.
class Reporter {
 public:
  explicit Reporter(const Execution& run) : run_(run) {}
  void report(double done);

 private:
  const Execution& run_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Calls `body(i)` for i = 0 ... count - 1, in this order and on the calling thread: for loops that fill objects of
/// VTK. Polls `run` at the start and before each block of some thousand steps. Reports progress now and then, and at
/// the end.
/// @throws Cancelled.
template <class Body>
void each(std::size_t count, const Execution& run, Body&& body) {
  constexpr std::size_t kBlock = 8192;
  Reporter reporter(run);
  check_cancelled(run);
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    if (begin > 0) reporter.report(static_cast<double>(begin) / static_cast<double>(count));
    check_cancelled(run);
    const std::size_t end = std::min(count, begin + kBlock);
    for (std::size_t i = begin; i < end; ++i) body(i);
  }
  if (run.progress) run.progress(1.0);
}

/// Runs a filter of VTK; polls `run` and reports progress as often as the filter tells its own, and at the end.
/// @throws Cancelled.
void update(vtkAlgorithm* filter, const Execution& run);

}  // namespace kappa::view_detail
