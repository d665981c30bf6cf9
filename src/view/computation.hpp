// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "kappa/view/viewer.hpp"

namespace kappa::view_detail {

/// Computes data for the viewer on a thread of its own. Of several radii only the one asked for last counts: start()
/// cancels what is under way.
class Computation {
 public:
  /// Data, or the message why there are none.
  struct Outcome {
    std::optional<ViewData> data;
    std::string error;
  };

  /// Each computation gets the threads of `run`.
  Computation(Recompute recompute, const Execution& run);
  ~Computation();
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  /// Starts computing for a radius.
  void start(double radius);
  /// True from start() until its outcome is taken.
  bool under_way() const;
  /// Fraction done, in [0, 1].
  double progress() const { return progress_; }
  /// Hands out the outcome of the last start() once it is there.
  std::optional<Outcome> take();

 private:
  void work();
  Outcome compute(double radius);

  Recompute recompute_;
  Execution run_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<double> asked_;  // a radius nobody works on yet
  std::optional<Outcome> outcome_;
  bool under_way_ = false;
  bool stop_ = false;
  std::atomic<bool> cancel_{false};
  std::atomic<double> progress_{0};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace kappa::view_detail
