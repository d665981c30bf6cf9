// SPDX-License-Identifier: BSD-3-Clause
#include "support/cancelling.hpp"

#include <cmath>

#include "kappa/scan/compare.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/ground.hpp"
#include "kappa/scan/thin.hpp"
#include "kappa/scan/units.hpp"

namespace kappa {
namespace {

/// Records that tell which points they belong to.
struct Numbers : FileRecords {
  std::vector<Index> of_points;
  std::size_t point_count() const override { return of_points.size(); }
  std::shared_ptr<const FileRecords> picked(const std::vector<Index>& kept, const Execution& run) const override {
    const auto chosen = std::make_shared<Numbers>();
    serial_for(kept.size(), 16, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) chosen->of_points.push_back(of_points[kept[i]]);
    });
    return chosen;
  }
};

/// A wavy cloud with all that a scan may have.
Scan full_scan() {
  Scan scan;
  const auto records = std::make_shared<Numbers>();
  std::vector<double> classes, returns;
  for (Index i = 0; i < 3000; ++i) {
    const double x = i % 60, y = i / 60;
    scan.points.emplace_back(x, y, std::sin(0.2 * x) + std::cos(0.3 * y));
    scan.normals.emplace_back(0.1, 0.2, 1.0);
    classes.push_back(i % 3);
    returns.push_back(1 + i % 2);
    records->of_points.push_back(i);
  }
  scan.width = scan.points.size();
  scan.viewpoint = Vec3(0, 0, 50);
  for (const char* name : {"mean_curvature", "k_min", "dir_min_x", "dir_min_y", "dir_min_z", "number_of_returns"})
    scan.fields.push_back({name, Field::Type::Float64, returns});
  scan.fields.push_back({"classification", Field::Type::UInt8, classes});
  scan.fields.push_back({"return_number", Field::Type::UInt8, returns});
  scan.records = records;
  return scan;
}

bool equal(const Scan& a, const Scan& b) {
  bool same = a.points == b.points && a.normals == b.normals && a.width == b.width && a.height == b.height &&
              a.records == b.records && a.fields.size() == b.fields.size() && a.viewpoint == b.viewpoint;
  for (std::size_t f = 0; same && f < a.fields.size(); ++f) same = a.fields[f].values == b.fields[f].values;
  return same;
}

PointFilter full_filter() {
  PointFilter filter;
  filter.classes = {1, 2};
  filter.returns = Returns::Last;
  filter.bounds = Bounds{Vec3(1, 1, -10), Vec3(50, 50, 10)};
  return filter;
}

TEST(ScanCancel, WhatChangesAScanLeavesItWhole) {
  const Scan scan = full_scan();
  std::vector<char> half(scan.points.size());
  std::vector<Index> some;
  for (Index i = 0; i < half.size(); ++i) half[i] = i % 2;
  for (Index i = 0; i < half.size(); i += 3) some.push_back(i);
  using test::change_in_place;
  test::expect_cancellable({
      change_in_place("keep_points", scan, equal, [=](Scan& s, const Execution& run) { keep_points(s, some, run); }),
      change_in_place("leave_out", scan, equal, [=](Scan& s, const Execution& run) { leave_out(s, half, run); }),
      change_in_place("select_points", scan, equal,
                      [](Scan& s, const Execution& run) { select_points(s, full_filter(), "a.las", run); }),
      change_in_place("thin", scan, equal, [](Scan& s, const Execution& run) { thin(s, Vec3(2, 2, 2), "a.las", run); }),
      change_in_place("HeightUnit::apply", scan, equal,
                      [](Scan& s, const Execution& run) { HeightUnit(0.3048).apply(s, run); }),
  });
}

TEST(ScanCancel, AGridIsLeftWhole) {
  Scan scan = full_scan();
  scan.width = 60;
  scan.height = 50;
  test::expect_cancellable(
      {test::change_in_place("select_points of a grid", scan, equal,
                             [](Scan& s, const Execution& run) { select_points(s, full_filter(), "a.pcd", run); })});
}

TEST(ScanCancel, RestoredHeightsAreAllOrNone) {
  HeightUnit unit(0.3048);
  Scan scaled = full_scan();
  unit.apply(scaled);
  test::expect_cancellable({test::change_in_place("HeightUnit::restore", scaled, equal,
                                                  [=](Scan& s, const Execution& run) { unit.restore(s, run); })});
  unit.restore(scaled);
  EXPECT_EQ(scaled.points, full_scan().points);
}

TEST(ScanCancel, WhatReadsAScanStops) {
  const Scan scan = full_scan();
  Scan mesh = scan;
  mesh.faces.add(0, 1, 2);
  const std::vector<double>& values = scan.fields.front().values;
  test::expect_cancellable({
      {"mesh_of", [&](const Execution& run) { mesh_of(mesh, run); }},
      {"compare_values", [&](const Execution& run) { compare_values(values, values, run); }},
      {"compare_scans", [&](const Execution& run) { compare_scans(scan, scan, "", 0, run); }},
      {"find_ground", [&](const Execution& run) { find_ground(scan.points, {}, run); }},
  });
}

}  // namespace
}  // namespace kappa
