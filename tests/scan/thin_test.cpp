// SPDX-License-Identifier: BSD-3-Clause
// One point a cell.
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "io/support.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/thin.hpp"

namespace kappa {
namespace {

Scan random_cloud(std::size_t count, const Vec3& origin = Vec3::Zero()) {
  Scan scan;
  scan.origin = origin;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-3, 4);
  Field number{"number", Field::Type::Float64, {}};
  for (std::size_t i = 0; i < count; ++i) {
    scan.points.emplace_back(any(random), 2 * any(random), 0.2 * any(random));
    number.values.push_back(static_cast<double>(i));
  }
  scan.fields.push_back(number);
  scan.width = count;
  return scan;
}

/// The same by the definition, cell by cell, in a map.
std::vector<double> thinned_slowly(const Scan& scan, double size) {
  const Vec3 least = bounds(scan.points).min;
  std::map<std::array<long, 3>, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    std::array<long, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          std::lround(std::floor((scan.points[i][axis] - least[axis]) / size + 1e-6));
    cells[cell].push_back(i);
  }
  std::vector<double> kept;
  for (const auto& [cell, points] : cells) {
    Vec3 mean = Vec3::Zero();
    for (const std::size_t i : points) mean += scan.points[i] / static_cast<double>(points.size());
    std::size_t nearest = points.front();
    for (const std::size_t i : points) {
      if ((scan.points[i] - mean).norm() < (scan.points[nearest] - mean).norm() - 1e-12) nearest = i;
    }
    kept.push_back(static_cast<double>(nearest));
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

TEST(Thin, KeepsThePointNearestToTheMeanOfEachCell) {
  for (const double size : {0.3, 1.0, 50.0}) {
    const Scan before = random_cloud(5000);
    Scan scan = before;
    const std::size_t gone = thin(scan, Vec3::Constant(size), "a.pcd");
    EXPECT_EQ(gone, before.points.size() - scan.points.size());
    EXPECT_EQ(scan.field("number")->values, thinned_slowly(before, size)) << size;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      EXPECT_EQ(scan.points[i], before.points[static_cast<std::size_t>(scan.field("number")->values[i])]);
    }
  }
}

TEST(Thin, DoesNotDependOnTheLocalOrigin) {
  Scan near = random_cloud(2000), far = near;
  for (Vec3& p : far.points) p += Vec3(1024, -4096, 64);
  thin(near, Vec3::Constant(0.5), "a.pcd");
  thin(far, Vec3::Constant(0.5), "a.pcd");
  EXPECT_EQ(near.field("number")->values, far.field("number")->values);
}

TEST(Thin, ARegularGridGivesEqualCellsHoweverItIsRounded) {
  Scan scan;
  for (int i = 0; i < 400; ++i) scan.points.emplace_back(0.1 * (i % 20), 0.1 * (i / 20), 0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> rounding(-1e-9, 1e-9);
  for (Vec3& p : scan.points) p += Vec3(rounding(random), rounding(random), rounding(random));
  scan.width = scan.points.size();
  thin(scan, Vec3::Constant(0.2), "a.pcd");
  EXPECT_EQ(scan.points.size(), 100u);
}

TEST(Thin, CellsMayBeOfUnequalEdges) {
  Scan scan;
  for (int i = 0; i < 100; ++i) scan.points.emplace_back(0, 0, i);
  scan.width = scan.points.size();
  Scan flat = scan;
  thin(scan, Vec3(1, 1, 10), "a.pcd");
  EXPECT_EQ(scan.points.size(), 10u);
  thin(flat, Vec3(1, 1, 1e3), "a.pcd");
  ASSERT_EQ(flat.points.size(), 1u);
  EXPECT_EQ(flat.points[0].z(), 49) << "of two equally near the mean the first";
}

TEST(Thin, ManySmallCellsOverALargeExtent) {
  Scan scan;
  for (int i = 0; i < 1000; ++i) {
    const double t = 1e3 * i;
    scan.points.emplace_back(t, t, 0);
    scan.points.emplace_back(t + 1e-4, t, 0);
  }
  scan.width = scan.points.size();
  thin(scan, Vec3(1e-3, 1e-3, 1), "a.pcd");
  EXPECT_EQ(scan.points.size(), 1000u) << "1e18 cells, of which 32 bits would hold 4e9";
}

TEST(Thin, AnOrganisedCloudBecomesAList) {
  Scan scan = random_cloud(100);
  scan.width = 10;
  scan.height = 10;
  scan.points[4].setConstant(kNaN);
  scan.points[5].x() = kNaN;
  EXPECT_EQ(thin(scan, Vec3::Constant(1e-3), "a.pcd"), 2u);
  EXPECT_EQ(scan.width, 98u);
  EXPECT_EQ(scan.height, 1u);
}

TEST(Thin, RefusesCellsThatAreNone) {
  for (const double size : {0.0, -1.0, kNaN}) {
    Scan scan = random_cloud(10);
    test::expect_error([&] { thin(scan, Vec3::Constant(size), "a.pcd"); }, ErrorCode::InvalidArgument, "positive");
  }
  Scan scan = random_cloud(10);
  test::expect_error([&] { thin(scan, Vec3::Constant(1e-9), "a.pcd"); }, ErrorCode::InvalidArgument, "give larger");
}

}  // namespace
}  // namespace kappa
