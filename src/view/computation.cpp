// SPDX-License-Identifier: BSD-3-Clause
#include "computation.hpp"

#include <exception>
#include <utility>

#include "kappa/core/error.hpp"

namespace kappa::view_detail {

Computation::Computation(Recompute recompute, const Execution& run) : recompute_(std::move(recompute)) {
  run_.threads = run.threads;
  run_.cancel = &cancel_;
  run_.progress = [this](double done) { progress_ = done; };
  thread_ = std::thread([this] { work(); });
}

Computation::~Computation() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    cancel_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Computation::start(double radius) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    asked_ = radius;
    outcome_.reset();
    under_way_ = true;
    cancel_ = true;
    progress_ = 0;
  }
  wake_.notify_one();
}

bool Computation::under_way() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return under_way_;
}

std::optional<Computation::Outcome> Computation::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!outcome_) return {};
  under_way_ = false;
  return std::exchange(outcome_, std::nullopt);
}

void Computation::work() {
  for (;;) {
    double radius = 0;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || asked_; });
      if (stop_) return;
      radius = *asked_;
      asked_.reset();
      cancel_ = false;
    }
    Outcome outcome = compute(radius);
    const std::lock_guard<std::mutex> lock(mutex_);
    // A radius asked for meanwhile makes this outcome stale, cancelled or not.
    if (!asked_) outcome_ = std::move(outcome);
  }
}

Computation::Outcome Computation::compute(double radius) {
  try {
    return {recompute_(radius, run_), {}};
  } catch (const Cancelled&) {
    return {{}, "cancelled"};
  } catch (const std::exception& error) {
    return {{}, error.what()};
  } catch (...) {
    return {{}, "an unknown error"};
  }
}

}  // namespace kappa::view_detail
