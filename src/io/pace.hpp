// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "kappa/core/execution.hpp"

namespace kappa::io {

/// Rows after which a loop pauses: a fraction of a millisecond of work.
inline constexpr std::size_t kRowsAtOnce = 4096;
/// The same for bytes of text.
inline constexpr std::size_t kBytesAtOnce = std::size_t{1} << 16;

/// Lets a loop pause now and then: a pause looks whether the call is cancelled, and reports progress. The first pause
/// of a loop always reports, the later ones at most ten times a second.
class Pace {
 public:
  /// For a loop over `total` rows or bytes that pauses after each `step` of them.
  Pace(const Execution& run, std::size_t total, std::size_t step);

  /// Says that `done` rows or bytes are done; `done` never decreases.
  /// @throws Cancelled.
  void at(std::size_t done) {
    if (done >= next_) pause(done);
  }

 private:
  void pause(std::size_t done);

  Execution run_;
  std::size_t total_, step_, next_;
  std::chrono::steady_clock::time_point last_report_;
};

/// Calls `row(i)` for each of `count` rows, at a pace.
/// @throws Cancelled, or what `row` throws.
template <class Row>
void for_each_row(std::size_t count, const Execution& run, Row&& row) {
  Pace pace(run, count, kRowsAtOnce);
  for (std::size_t begin = 0; begin < count; begin += kRowsAtOnce) {
    pace.at(begin);
    const std::size_t end = std::min(count, begin + kRowsAtOnce);
    for (std::size_t i = begin; i < end; ++i) row(i);
  }
}

/// Whether `is_so(i)` for any of `count` rows, at a pace; stops at the first.
/// @throws Cancelled, or what `is_so` throws.
template <class Predicate>
bool any_row(std::size_t count, const Execution& run, Predicate&& is_so) {
  Pace pace(run, count, kRowsAtOnce);
  for (std::size_t i = 0; i < count; ++i) {
    pace.at(i);
    if (is_so(i)) return true;
  }
  return false;
}

/// `run` for part `k` of `parts` parts that take equally long.
Execution part(const Execution& run, std::size_t k, std::size_t parts);

/// `run` without its progress: for a look at the data that takes little of the time, or that may be repeated.
Execution silent(const Execution& run);

/// Reports that nothing is done yet.
/// @throws Cancelled.
void begin_progress(const Execution& run);

/// Reports that all is done.
void end_progress(const Execution& run);

}  // namespace kappa::io
