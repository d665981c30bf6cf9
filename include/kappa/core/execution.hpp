// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

namespace kappa {

/// How a long computation is run. It never changes what is computed.
struct Execution {
  /// The number of threads; 0 stands for all that the machine has. Every number gives the same bits, also where the
  /// system lets fewer threads start.
  int threads = 1;
  /// A function that is told which part of the work is done, a number in [0, 1]. It is called on the calling thread, a
  /// few times a second at most, and at least once by every function that may run long.
  std::function<void(double)> progress;
  /// A flag that any thread may raise to stop the work: the call then throws `Cancelled` and leaves its outputs
  /// untouched. It is polled many times a second, and after each call of `progress`.
  const std::atomic<bool>* cancel = nullptr;
};

/// The number of threads that `run` stands for on this machine.
/// @throws Error InvalidArgument if `run.threads` is negative or above 4096.
int thread_count(const Execution& run);

/// Polls the flag.
/// @throws Cancelled if `run.cancel` is raised.
void check_cancelled(const Execution& run);

/// Reports that the part `done` of the work is done, and polls the flag: for stages without a loop.
/// @throws Cancelled if `run.cancel` is raised.
void report_progress(const Execution& run, double done);

/// `run` with its progress mapped into [from, to], for one stage of several. With from = to the stage is polled, and
/// its progress stands still.
Execution stage(const Execution& run, double from, double to);

/// Reports progress from a loop of its own, ten times a second at most.
class Reporter {
 public:
  /// `run` must outlive the reporter.
  explicit Reporter(const Execution& run) : run_(run) {}

  /// Polls the flag, and reports the part `done` if the last report is long enough ago.
  /// @throws Cancelled if `run.cancel` is raised.
  void operator()(double done);

 private:
  const Execution& run_;
  std::chrono::steady_clock::time_point last_report_ = std::chrono::steady_clock::now();
};

/// Calls `body(begin, end, worker)` for consecutive blocks of [0, count), in any order, on `thread_count(run)` threads.
///
/// `block` is the length of a block. `worker`, in [0, threads), tells workspaces of the threads apart. The result does
/// not depend on the number of threads if every output has one writer and does not depend on `worker`. The flag is
/// polled before each block, progress is reported between blocks, and 1 at the end.
/// @throws Cancelled if `run.cancel` is raised, even by the last report; Error as `thread_count` does; and whatever the
/// body throws, which ends the loop.
void parallel_for(std::size_t count, std::size_t block, const Execution& run,
                  const std::function<void(std::size_t begin, std::size_t end, int worker)>& body);

/// Calls `body(begin, end)` for consecutive blocks of [0, count), in order, on the calling thread: for loops of which
/// each step builds on those before. Polling, progress and exceptions are those of `parallel_for`.
void serial_for(std::size_t count, std::size_t block, const Execution& run,
                const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace kappa
