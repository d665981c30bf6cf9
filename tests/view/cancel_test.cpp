// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>

#include "../../src/view/steps.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/display.hpp"
#include "kappa/view/figure.hpp"
#include "picture_reader.hpp"

namespace kappa {
namespace {

/// Draws figures that are cancelled in their k-th call of progress, for every k.
class CancelTest : public ::testing::Test {
 protected:
  static constexpr int kSide = 150;

  void SetUp() override {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) scan_.points.emplace_back(i, j, std::sin(0.1 * i));
    }
    options_.width = options_.height = 120;
    options_.direction_fields.dir_min.assign(scan_.points.size(), Vec3::UnitX());
    options_.direction_fields.dir_max.assign(scan_.points.size(), Vec3::UnitY());
    options_.directions = Directions::Both;
    options_.edges = Edges::Shown;
  }

  void add_faces() {
    for (Index j = 0; j + 1 < kSide; ++j) {
      for (Index i = 0; i + 1 < kSide; ++i) {
        const Index a = j * kSide + i;
        scan_.faces.add({a, a + 1, a + 1 + kSide, a + kSide});
      }
    }
  }

  template <class Draw>
  void cancel_everywhere(const Draw& draw) {
    const std::string path = folder_ / "x.png";
    for (int last = 1;; ++last) {
      std::atomic<bool> stop{false};
      int calls = 0;
      double before = 0;
      Execution run;
      run.threads = 2;
      run.cancel = &stop;
      run.progress = [&](double done) {
        EXPECT_GE(done, before - 1e-12);
        EXPECT_LE(done, 1 + 1e-12);
        before = done;
        if (++calls == last) stop = true;
      };
      try {
        draw(path, run);
        EXPECT_EQ(1U, folder_.file_count());
        EXPECT_LE(calls, last) << "went on after it was cancelled";
        EXPECT_GT(calls, 5) << "progress of the stages";
        EXPECT_EQ(1, before);
        return;
      } catch (const Cancelled&) {
        ASSERT_EQ(last, calls);
        ASSERT_EQ(0U, folder_.file_count()) << "call " << last;
      }
    }
  }

  void cancel_scalar() {
    const std::vector<double> values(scan_.points.size(), 1.0);
    cancel_everywhere([&](const std::string& path, const Execution& run) {
      draw_scalar(path, scan_, values, ScalarStyle(), options_, run);
    });
  }

  const VirtualDisplay display_;
  test::TemporaryFolder folder_;
  Scan scan_;
  FigureOptions options_;
};

TEST_F(CancelTest, ScalarOnAMesh) {
  add_faces();
  cancel_scalar();
}

TEST_F(CancelTest, ScalarOnDiscs) {
  cancel_scalar();
}

TEST_F(CancelTest, ScalarOnPoints) {
  options_.point_size = 2;
  cancel_scalar();
}

TEST_F(CancelTest, Labels) {
  add_faces();
  std::vector<Label> labels;
  for (std::size_t i = 0; i < scan_.points.size(); ++i) labels.push_back(i % 2 == 0 ? Label::Flat : Label::Convex);
  cancel_everywhere(
      [&](const std::string& path, const Execution& run) { draw_labels(path, scan_, labels, options_, run); });
}

TEST_F(CancelTest, BeforeTheStart) {
  const std::atomic<bool> stop{true};
  Execution run;
  run.cancel = &stop;
  const std::vector<double> values(scan_.points.size(), 1.0);
  EXPECT_THROW(draw_scalar(folder_ / "x.png", scan_, values, ScalarStyle(), options_, run), Cancelled);
  EXPECT_EQ(0U, folder_.file_count());
}

TEST_F(CancelTest, AFileThatWasThereStays) {
  const std::string path = folder_ / "x.png";
  std::ofstream(path) << "before";
  std::atomic<bool> stop{false};
  Execution run;
  run.cancel = &stop;
  run.progress = [&](double) { stop = true; };
  const std::vector<double> values(scan_.points.size(), 1.0);
  EXPECT_THROW(draw_scalar(path, scan_, values, ScalarStyle(), options_, run), Cancelled);
  EXPECT_EQ("before", test::file_bytes(path));
}

TEST(EachStep, ComesInOrderAndStopsSoonAfterACancellation) {
  constexpr std::size_t kCount = 100000, kLast = 5000;
  std::atomic<bool> stop{false};
  Execution run;
  run.cancel = &stop;
  double done = 0;
  run.progress = [&](double fraction) { done = fraction; };
  std::size_t next = 0;
  view_detail::each(kCount, run, [&](std::size_t i) { EXPECT_EQ(next++, i); });
  EXPECT_EQ(kCount, next);
  EXPECT_EQ(1, done);
  next = 0;
  const auto cancel_later = [&](std::size_t) { stop = ++next == kLast || stop; };
  EXPECT_THROW(view_detail::each(kCount, run, cancel_later), Cancelled);
  EXPECT_GE(next, kLast);
  EXPECT_LT(next, kLast + 10000);
}

}  // namespace
}  // namespace kappa
