// SPDX-License-Identifier: BSD-3-Clause
#include "io/pace.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa::io {
namespace {

/// An execution that keeps what is reported, and is cancelled in the report number `last`.
struct Watched {
  explicit Watched(std::size_t last = 1000000) {
    run.cancel = &stop;
    run.progress = [this, last](double done) {
      reported.push_back(done);
      if (reported.size() > last) stop = true;
    };
  }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  std::atomic<bool> stop{false};
  std::vector<double> reported;
  Execution run;
};

TEST(Pace, ReportsTheFirstPauseAndFewOfThoseThatFollowFast) {
  Watched w;
  Pace pace(w.run, 1000000, 10);
  for (std::size_t i = 0; i < 10; ++i) pace.at(i);
  EXPECT_TRUE(w.reported.empty());
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = 10; i < 1000000; ++i) pace.at(i);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ASSERT_FALSE(w.reported.empty());
  EXPECT_EQ(w.reported.front(), 10 / 1e6);
  EXPECT_LE(static_cast<double>(w.reported.size()), 1 + 10 * seconds);
}

TEST(Pace, LooksForCancellationAtEveryPause) {
  Watched w;
  Pace pace(w.run, 100, 10);
  pace.at(10);
  w.stop = true;
  EXPECT_NO_THROW(pace.at(19));
  EXPECT_THROW(pace.at(20), Cancelled);
}

TEST(Pace, EndsAtOnceWhenCancelledInAReport) {
  Watched w(0);
  Pace pace(w.run, 100, 10);
  EXPECT_THROW(pace.at(10), Cancelled);
}

TEST(Pace, NeverReportsMoreThanAll) {
  Watched w;
  Pace pace(w.run, 100, 10);
  pace.at(1000);
  EXPECT_EQ(w.reported, std::vector<double>{1.0});
}

TEST(ForEachRow, TakesEveryRowOnceInOrder) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kRowsAtOnce, 3 * kRowsAtOnce + 1}) {
    std::vector<std::size_t> rows, all(count);
    for_each_row(count, {}, [&](std::size_t i) { rows.push_back(i); });
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(rows, all);
  }
}

TEST(ForEachRow, StopsInTheFirstReport) {
  Watched w(0);
  std::size_t rows = 0;
  EXPECT_THROW(for_each_row(10 * kRowsAtOnce, w.run, [&](std::size_t) { ++rows; }), Cancelled);
  EXPECT_EQ(rows, kRowsAtOnce);
  EXPECT_EQ(w.reported, std::vector<double>{0.1});
}

TEST(AnyRow, StopsAtTheFirstThatIsSo) {
  std::size_t last = 0;
  const auto is_five = [&](std::size_t i) { return (last = i) == 5; };
  EXPECT_TRUE(any_row(10, {}, is_five));
  EXPECT_EQ(last, 5u);
  EXPECT_FALSE(any_row(5, {}, is_five));
  Watched w(0);
  EXPECT_THROW(any_row(10 * kRowsAtOnce, w.run, [](std::size_t) { return false; }), Cancelled);
}

TEST(Part, MapsProgressIntoItsShare) {
  Watched w;
  part(w.run, 1, 4).progress(0.5);
  part(stage(w.run, 0.5, 1.0), 0, 2).progress(1.0);
  EXPECT_EQ(w.reported, (std::vector<double>{0.375, 0.75}));
}

TEST(Silent, ReportsNothingAndIsStillCancelled) {
  Watched w;
  EXPECT_FALSE(silent(w.run).progress);
  w.stop = true;
  EXPECT_THROW(check_cancelled(silent(w.run)), Cancelled);
}

}  // namespace
}  // namespace kappa::io
