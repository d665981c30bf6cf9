// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "kappa/core/error.hpp"
#include "kappa/core/execution.hpp"

namespace kappa::test {

/// A call of a function that may run long, with a name for messages. It works on data of its own each time.
struct LongCall {
  std::string name;
  std::function<void(const Execution&)> call;
};

/// A call that changes a copy of `before` in place. Where it is cancelled, `equal` must find the copy unchanged.
template <class Data, class Equal, class Change>
LongCall change_in_place(const std::string& name, const Data& before, const Equal& equal, const Change& change) {
  return {name, [=](const Execution& run) {
            Data data = before;
            try {
              change(data, run);
            } catch (const Cancelled&) {
              EXPECT_TRUE(equal(data, before)) << name << " was cancelled and left its output touched";
              throw;
            }
          }};
}

/// The reports of a call that nobody cancels.
inline std::vector<double> reports_of(const LongCall& long_call, int threads) {
  std::vector<double> reports;
  Execution run;
  run.threads = threads;
  run.progress = [&](double done) { reports.push_back(done); };
  long_call.call(run);
  return reports;
}

/// Raises the flag in report `at`, which counts from 0. If the call comes so far, it must throw `Cancelled`.
inline void expect_cancelled_in(const LongCall& long_call, int threads, std::size_t at) {
  std::atomic<bool> cancel{false};
  std::size_t reports = 0;
  Execution run;
  run.threads = threads;
  run.cancel = &cancel;
  run.progress = [&](double) { cancel = cancel || reports++ == at; };
  try {
    long_call.call(run);
    EXPECT_FALSE(cancel) << long_call.name << " goes on after report " << at << " of " << reports;
  } catch (const Cancelled&) {
    EXPECT_TRUE(cancel) << long_call.name;
  }
}

/// Each call must report its progress at least once, in numbers of [0, 1] that do not fall, and must throw `Cancelled`
/// whichever report raises the flag.
inline void expect_cancellable(const std::vector<LongCall>& calls) {
  constexpr double kRounding = 1e-12;  // of a stage that ends where the next one begins
  for (const LongCall& c : calls) {
    for (const int threads : {1, 2}) {
      const std::vector<double> reports = reports_of(c, threads);
      EXPECT_FALSE(reports.empty()) << c.name << " reports nothing";
      double last = 0;
      for (const double done : reports) {
        EXPECT_GE(done, last - kRounding) << c.name;
        EXPECT_LE(done, 1.0) << c.name;
        last = done;
      }
      for (std::size_t at = 0; at < reports.size(); ++at) expect_cancelled_in(c, threads, at);
    }
  }
}

}  // namespace kappa::test
