// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/execution.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

constexpr int kMaxThreads = 4096;

/// What the threads of one loop share.
class Loop {
 public:
  Loop(std::size_t count, std::size_t block, const Execution& run,
       const std::function<void(std::size_t, std::size_t, int)>& body)
      : count_(count), block_(block), run_(run), body_(body), report_(run) {}

  /// Takes blocks until none is left; the calling thread (worker 0) also reports progress.
  void work(int worker) noexcept {
    try {
      while (!stop_.load(std::memory_order_relaxed)) {
        check_cancelled(run_);
        const std::size_t begin = next_.fetch_add(block_, std::memory_order_relaxed);
        if (begin >= count_) return;
        const std::size_t end = std::min(count_, begin + block_);
        body_(begin, end, worker);
        done_.fetch_add(end - begin, std::memory_order_relaxed);
        if (worker == 0)
          report_(static_cast<double>(done_.load(std::memory_order_relaxed)) / static_cast<double>(count_));
      }
    } catch (...) {
      fail(std::current_exception());
    }
  }

  void finish() const {
    if (error_) std::rethrow_exception(error_);
    report_progress(run_, 1.0);
  }

 private:
  void fail(std::exception_ptr error) noexcept {
    const std::lock_guard<std::mutex> lock(error_mutex_);
    if (!error_) error_ = std::move(error);
    stop_.store(true, std::memory_order_relaxed);
  }

  const std::size_t count_, block_;
  const Execution& run_;
  const std::function<void(std::size_t, std::size_t, int)>& body_;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> stop_{false};
  std::mutex error_mutex_;
  std::exception_ptr error_;
  Reporter report_;
};

/// Joins the helper threads however the scope is left.
class ThreadGroup {
 public:
  ~ThreadGroup() {
    for (std::thread& thread : threads_) thread.join();
  }
  /// False where the system allows no more threads.
  template <class Function>
  bool start(Function&& function) {
    try {
      threads_.emplace_back(std::forward<Function>(function));
      return true;
    } catch (const std::system_error&) {
      return false;
    }
  }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace

int thread_count(const Execution& run) {
  if (run.threads < 0 || run.threads > kMaxThreads)
    throw Error(ErrorCode::InvalidArgument,
                "threads = " + std::to_string(run.threads) + ": give 0 (all) to " + std::to_string(kMaxThreads));
  if (run.threads > 0) return run.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void check_cancelled(const Execution& run) {
  if (run.cancel && run.cancel->load(std::memory_order_relaxed)) throw Cancelled();
}

void report_progress(const Execution& run, double done) {
  if (run.progress) run.progress(done);
  check_cancelled(run);
}

void Reporter::operator()(double done) {
  check_cancelled(run_);
  if (!run_.progress) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_report_ < std::chrono::milliseconds(100)) return;
  last_report_ = now;
  report_progress(run_, done);
}

Execution stage(const Execution& run, double from, double to) {
  Execution part = run;
  if (run.progress) {
    part.progress = [whole = run.progress, from, to](double done) { whole(from + (to - from) * done); };
  }
  return part;
}

void parallel_for(std::size_t count, std::size_t block, const Execution& run,
                  const std::function<void(std::size_t, std::size_t, int)>& body) {
  block = std::max<std::size_t>(block, 1);
  const std::size_t blocks = (count + block - 1) / block;
  const int threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(thread_count(run)), blocks));
  check_cancelled(run);
  Loop loop(count, block, run, body);
  {
    ThreadGroup group;
    int worker = 1;
    while (worker < threads && group.start([&loop, worker] { loop.work(worker); })) ++worker;
    loop.work(0);
  }
  loop.finish();
}

void serial_for(std::size_t count, std::size_t block, const Execution& run,
                const std::function<void(std::size_t, std::size_t)>& body) {
  thread_count(run);  // refuses what parallel_for refuses
  Execution on_this_thread = run;
  on_this_thread.threads = 1;
  parallel_for(count, block, on_this_thread, [&](std::size_t begin, std::size_t end, int) { body(begin, end); });
}

}  // namespace kappa
