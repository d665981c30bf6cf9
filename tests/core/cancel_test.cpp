// SPDX-License-Identifier: BSD-3-Clause
#include "support/cancelling.hpp"

#include "kappa/core/gather.hpp"
#include "kappa/core/spatial_order.hpp"
#include "support/utm_points.hpp"

namespace kappa {
namespace {

TEST(CoreCancel, InWhicheverReport) {
  const std::vector<Vec3> points = test::utm_points(Vec3(500000, 5400000, 100), 30, 1);
  std::vector<Index> all(points.size());
  for (Index i = 0; i < all.size(); ++i) all[i] = i;
  test::expect_cancellable({
      {"spatial_order", [&](const Execution& run) { spatial_order(points, run); }},
      {"gathered", [&](const Execution& run) { gathered(points, all, run); }},
      {"parallel_for", [](const Execution& run) { parallel_for(100, 10, run, [](std::size_t, std::size_t, int) {}); }},
      {"serial_for", [](const Execution& run) { serial_for(100, 10, run, [](std::size_t, std::size_t) {}); }},
      {"report_progress", [](const Execution& run) { report_progress(run, 0.5); }},
  });
}

TEST(CoreCancel, SpatialOrderReportsEachPassOfTheSort) {
  const std::vector<Vec3> points = test::utm_points(Vec3(500000, 5400000, 100), 30, 2);
  const test::LongCall order = {"spatial_order", [&](const Execution& run) { spatial_order(points, run); }};
  EXPECT_GE(test::reports_of(order, 1).size(), 9U) << "two loops, six passes and the end";
}

}  // namespace
}  // namespace kappa
