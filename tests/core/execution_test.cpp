// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/execution.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

Execution with_threads(int threads) {
  Execution run;
  run.threads = threads;
  return run;
}

TEST(ParallelFor, CoversEachIndexOnce) {
  for (const int threads : {1, 2, 3, 7}) {
    for (const std::size_t count : {0UL, 1UL, 5UL, 1000UL, 1003UL}) {
      for (const std::size_t block : {1UL, 7UL, 64UL, 5000UL}) {
        std::vector<std::atomic<int>> seen(count);
        parallel_for(count, block, with_threads(threads), [&](std::size_t begin, std::size_t end, int worker) {
          EXPECT_LT(begin, end);
          EXPECT_LE(end, count);
          EXPECT_LE(end - begin, block);
          EXPECT_GE(worker, 0);
          EXPECT_LT(worker, threads);
          for (std::size_t i = begin; i < end; ++i) ++seen[i];
        });
        for (const auto& n : seen) EXPECT_EQ(n.load(), 1) << threads << ' ' << count << ' ' << block;
      }
    }
  }
}

TEST(ParallelFor, WorkersTellWorkspacesApart) {
  for (const int threads : {1, 2, 7}) {
    // A workspace that two bodies used at once would lose counts.
    std::vector<std::vector<int>> workspace(static_cast<std::size_t>(threads), std::vector<int>(16, 0));
    parallel_for(2000, 1, with_threads(threads), [&](std::size_t, std::size_t, int worker) {
      for (int& n : workspace[static_cast<std::size_t>(worker)]) ++n;
    });
    int total = 0;
    for (const auto& w : workspace) total += w[0];
    EXPECT_EQ(total, 2000);
  }
}

TEST(ParallelFor, CarriesTheExceptionOfTheBody) {
  for (const int threads : {1, 2, 3, 7}) {
    std::atomic<int> calls{0};
    const auto body = [&](std::size_t begin, std::size_t, int) {
      ++calls;
      if (begin == 30) throw std::out_of_range("thirty");
    };
    try {
      parallel_for(100000, 1, with_threads(threads), body);
      ADD_FAILURE() << "no exception with " << threads << " threads";
    } catch (const std::out_of_range& e) {
      EXPECT_STREQ(e.what(), "thirty");
    }
    EXPECT_LT(calls.load(), 100000) << "the loop goes on after the exception";
  }
}

TEST(ParallelFor, StopsWhenCancelled) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<bool> cancel{false};
    std::atomic<int> calls{0};
    Execution run = with_threads(threads);
    run.cancel = &cancel;
    const auto body = [&](std::size_t, std::size_t, int) {
      if (++calls == 10) cancel = true;
    };
    EXPECT_THROW(parallel_for(100000, 1, run, body), Cancelled);
    EXPECT_LT(calls.load(), 1000);
    EXPECT_THROW(check_cancelled(run), Cancelled);
    const int before = calls.load();
    EXPECT_THROW(parallel_for(10, 1, run, body), Cancelled) << "raised before the start";
    EXPECT_EQ(calls.load(), before);
  }
  EXPECT_NO_THROW(check_cancelled(Execution{}));
}

TEST(SerialFor, TakesTheBlocksInOrderOnTheCallingThread) {
  const std::thread::id caller = std::this_thread::get_id();
  std::vector<std::size_t> seen;
  serial_for(1003, 100, with_threads(3), [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_LE(end - begin, 100U);
    for (std::size_t i = begin; i < end; ++i) seen.push_back(i);
  });
  ASSERT_EQ(seen.size(), 1003U);
  for (std::size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(seen[i], i);
  EXPECT_THROW(serial_for(10, 1, with_threads(-1), [](std::size_t, std::size_t) {}), Error);
}

TEST(Reporter, PollsAlwaysAndReportsTenTimesASecond) {
  std::atomic<bool> cancel{false};
  int reports = 0;
  Execution run;
  run.cancel = &cancel;
  run.progress = [&](double) { ++reports; };
  Reporter report(run);
  const auto start = std::chrono::steady_clock::now();
  std::chrono::duration<double> seconds{0};
  while (seconds.count() < 0.35) {
    report(0.5);
    seconds = std::chrono::steady_clock::now() - start;
  }
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 10 * seconds.count());
  cancel = true;
  EXPECT_THROW(report(0.5), Cancelled);
}

TEST(ParallelFor, ProgressRisesOnTheCallingThread) {
  for (const int threads : {1, 2, 3}) {
    Execution run = with_threads(threads);
    const std::thread::id caller = std::this_thread::get_id();
    double last = 0;
    int reports = 0;
    run.progress = [&](double p) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_GE(p, last);
      EXPECT_GE(p, 0.0);
      EXPECT_LE(p, 1.0);
      last = p;
      ++reports;
    };
    const auto start = std::chrono::steady_clock::now();
    parallel_for(400, 1, run,
                 [](std::size_t, std::size_t, int) { std::this_thread::sleep_for(std::chrono::milliseconds(3)); });
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_GE(reports, 2) << threads << " threads: a second of work without a report but the last";
    EXPECT_LE(reports, 10 * seconds.count() + 1) << threads << " threads: more than ten reports a second";
    EXPECT_EQ(last, 1.0) << threads << " threads";
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// A process that may hardly grow can start a few threads at most: the loop is done by those.
TEST(ParallelFor, GoesOnWithTheThreadsThatStart) {
  const auto in_a_small_process = [] {
    rlimit small{};
    small.rlim_cur = small.rlim_max = 256UL << 20;
    if (setrlimit(RLIMIT_AS, &small) != 0) std::exit(2);
    std::atomic<int> sum{0};
    parallel_for(10000, 1, with_threads(4096), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) ++sum;
    });
    std::exit(sum == 10000 ? 0 : 1);
  };
  EXPECT_EXIT(in_a_small_process(), ::testing::ExitedWithCode(0), "");
}
#endif

TEST(ParallelFor, ExceptionOfTheProgressIsCarried) {
  Execution run = with_threads(2);
  run.progress = [](double) { throw std::runtime_error("window closed"); };
  EXPECT_THROW(
      parallel_for(400, 1, run,
                   [](std::size_t, std::size_t, int) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }),
      std::runtime_error);
}

TEST(Stage, MapsProgress) {
  std::vector<double> seen;
  std::atomic<bool> cancel{false};
  Execution run = with_threads(3);
  run.cancel = &cancel;
  run.progress = [&](double p) { seen.push_back(p); };
  const Execution part = stage(run, 0.25, 0.75);
  EXPECT_EQ(part.threads, 3);
  EXPECT_EQ(part.cancel, &cancel);
  part.progress(0);
  part.progress(0.5);
  part.progress(1);
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_DOUBLE_EQ(seen[0], 0.25);
  EXPECT_DOUBLE_EQ(seen[1], 0.5);
  EXPECT_DOUBLE_EQ(seen[2], 0.75);
  EXPECT_FALSE(stage(Execution{}, 0, 1).progress) << "nothing to report to";
}

TEST(ThreadCount, CountsAndRefuses) {
  EXPECT_EQ(thread_count(with_threads(5)), 5);
  EXPECT_GE(thread_count(with_threads(0)), 1);
  EXPECT_EQ(thread_count(with_threads(4096)), 4096);
  for (const int threads : {-1, -2147483647, 4097}) {
    try {
      thread_count(with_threads(threads));
      ADD_FAILURE() << threads << " was accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::InvalidArgument);
      EXPECT_NE(std::string(e.what()).find(std::to_string(threads)), std::string::npos) << e.what();
    }
    EXPECT_THROW(parallel_for(10, 1, with_threads(threads), [](std::size_t, std::size_t, int) {}), Error);
  }
}

}  // namespace
}  // namespace kappa
