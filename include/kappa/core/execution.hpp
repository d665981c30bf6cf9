// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace kappa {

/// How a long computation is run; it never changes what is computed.
struct Execution {
  /// Number of threads, 0 = all the machine has. Any number gives the same bits, also where the system lets fewer
  /// start.
  int threads = 1;
  /// Called with a fraction in [0, 1], on the calling thread, a few times a second at most.
  std::function<void(double)> progress;
  /// Raise it from anywhere to stop: the call then throws `Cancelled`.
  const std::atomic<bool>* cancel = nullptr;
};

/// Threads `run` stands for on this machine.
/// @throws Error InvalidArgument if `run.threads` is negative or above 4096.
int thread_count(const Execution& run);

/// Throws `Cancelled` if `run.cancel` is raised.
void check_cancelled(const Execution& run);

/// `run` with its progress mapped into [from, to], for one stage of several.
Execution stage(const Execution& run, double from, double to);

/// Calls `body(begin, end, worker)` for consecutive blocks of [0, count), in any order and on
/// `thread_count(run)` threads, `worker` in [0, threads) telling per-thread workspaces apart.
/// Every output must have one writer and must not depend on `worker`: then the result does not
/// depend on the number of threads. An exception of the body ends the loop and is rethrown here.
/// @throws Cancelled if `run.cancel` is raised; it is polled before each block.
void parallel_for(std::size_t count, std::size_t block, const Execution& run,
                  const std::function<void(std::size_t begin, std::size_t end, int worker)>& body);

}  // namespace kappa
