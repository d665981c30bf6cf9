// SPDX-License-Identifier: BSD-3-Clause
// Selection of points on reading, and the frame in which they are measured.
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>

#include "io/las_files.hpp"
#include "io/support.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"
#include "support/expect_names.hpp"

namespace kappa {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Field field(const std::string& name, std::vector<double> values) {
  return {name, Field::Type::UInt8, std::move(values)};
}

/// Points on a line far from 0 along x.
Scan line(std::size_t count) {
  Scan scan;
  scan.origin = Vec3(500000, 5400000, 0);
  for (std::size_t i = 0; i < count; ++i) scan.points.emplace_back(0.01 * static_cast<double>(i), 0.0, 1.0);
  scan.width = count;
  return scan;
}

std::vector<double> numbers(const Scan& scan) {
  const Field* number = scan.field("number");
  return number ? number->values : std::vector<double>();
}

Scan numbered(Scan scan) {
  Field number{"number", Field::Type::Float64, {}};
  for (std::size_t i = 0; i < scan.points.size(); ++i) number.values.push_back(static_cast<double>(i));
  scan.fields.push_back(number);
  return scan;
}

PointFilter of_classes(std::vector<int> classes) {
  PointFilter filter;
  filter.classes = std::move(classes);
  return filter;
}

PointFilter of_returns(Returns returns) {
  PointFilter filter;
  filter.returns = returns;
  return filter;
}

PointFilter of_bounds(const Vec3& min, const Vec3& max) {
  PointFilter filter;
  filter.bounds = Bounds{min, max};
  return filter;
}

TEST(Returns, HaveTheWordsOfTheCommandLine) {
  test::expect_names<Returns>({"all", "first", "last"});
}

TEST(SelectPoints, NothingAskedForChangesNothing) {
  Scan scan = numbered(line(4));
  scan.points[2].setConstant(kNaN);
  const FilterCounts counts = select_points(scan, {}, "a.pcd");
  EXPECT_EQ(scan.points.size(), 4u);
  EXPECT_EQ(counts.unplaced + counts.by_class + counts.by_returns + counts.by_bounds, 0u);
}

TEST(SelectPoints, ClassesStayInTheirOrderWithAllTheyHave) {
  Scan scan = numbered(line(6));
  scan.fields.push_back(field("Classification", {2, 1, 6, 2, 9, 2}));
  for (int i = 0; i < 6; ++i) scan.normals.emplace_back(i, 0, 1);
  const FilterCounts counts = select_points(scan, of_classes({2, 9}), "a.pcd");
  EXPECT_EQ(numbers(scan), (std::vector<double>{0, 3, 4, 5}));
  EXPECT_EQ(scan.points[1].x(), 0.01 * 3);
  EXPECT_EQ(scan.normals[2].x(), 4);
  EXPECT_EQ(counts.by_class, 2u);
  EXPECT_EQ(scan.width, 4u);
}

TEST(SelectPoints, ReturnsByNumber) {
  const Scan all = [] {
    Scan scan = numbered(line(6));
    scan.fields.push_back(field("ReturnNumber", {1, 1, 2, 1, 2, 3}));
    scan.fields.push_back(field("number_of_returns", {1, 2, 2, 3, 3, 3}));
    return scan;
  }();
  Scan first = all, last = all;
  EXPECT_EQ(select_points(first, of_returns(Returns::First), "a.pcd").by_returns, 3u);
  EXPECT_EQ(numbers(first), (std::vector<double>{0, 1, 3}));
  EXPECT_EQ(select_points(last, of_returns(Returns::Last), "a.pcd").by_returns, 3u);
  EXPECT_EQ(numbers(last), (std::vector<double>{0, 2, 5}));
}

TEST(SelectPoints, BoundsAreThoseOfTheFileAndIncludeTheirBorders) {
  Scan scan = numbered(line(100));
  const FilterCounts counts =
      select_points(scan, of_bounds({500000.07, 5399999, -kInfinity}, {500000.29, 5400001, kInfinity}), "a.pcd");
  ASSERT_EQ(scan.points.size(), 23u);
  EXPECT_EQ(numbers(scan).front(), 7);
  EXPECT_EQ(numbers(scan).back(), 29);
  EXPECT_EQ(counts.by_bounds, 77u);
  Scan below = line(3);
  test::expect_error(
      [&] {
        select_points(below, of_bounds({0, 0, 0}, {1, 1, 1}), "a.pcd");
      },
      ErrorCode::InvalidData, "'a.pcd': no point is left within the bounds: its points are between 500000.0");
  test::expect_error(
      [&] {
        select_points(below, of_bounds({1, 0, 0}, {0, 1, 1}), "a.pcd");
      },
      ErrorCode::InvalidArgument, "swap");
}

TEST(SelectPoints, EachPointCountsOnce) {
  Scan scan = line(5);
  scan.points[4].setConstant(kNaN);
  scan.fields = {field("classification", {1, 2, 2, 2, 1}), field("return_number", {2, 2, 1, 1, 1})};
  PointFilter filter = of_classes({2});
  filter.returns = Returns::First;
  filter.bounds = Bounds{{0, 0, 0}, {500000.025, 1e9, 9}};
  const FilterCounts counts = select_points(scan, filter, "a.pcd");
  EXPECT_EQ(counts.unplaced, 1u);
  EXPECT_EQ(counts.by_class, 1u);
  EXPECT_EQ(counts.by_returns, 1u);
  EXPECT_EQ(counts.by_bounds, 1u);
  EXPECT_EQ(scan.points.size(), 1u);
}

TEST(SelectPoints, AnOrganisedCloudStaysOne) {
  Scan scan = line(6);
  scan.width = 3;
  scan.height = 2;
  scan.fields = {field("classification", {2, 2, 1, 1, 2, 2})};
  EXPECT_EQ(select_points(scan, of_classes({2}), "a.pcd").by_class, 2u);
  EXPECT_EQ(scan.points.size(), 6u);
  EXPECT_EQ(scan.width * scan.height, 6u);
  EXPECT_FALSE(is_finite(scan.points[2]) || is_finite(scan.points[3]));
  EXPECT_TRUE(is_finite(scan.points[1]) && is_finite(scan.points[4]));
}

TEST(SelectPoints, WhatCannotBeSelectedIsSaid) {
  Scan scan = line(3);
  scan.fields = {field("classification", {2, 2, 1}), field("return_number", {0, 0, 0}), field("ring", {1, 2, 3})};
  const auto refused = [&](const PointFilter& filter, const std::string& part) {
    test::expect_error([&] { select_points(scan, filter, "scans/a.pcd"); }, ErrorCode::InvalidData, part);
  };
  refused(of_classes({6}), "'scans/a.pcd': no point is left by the selection of classes: it has 1 (1 points), 2 (2 ");
  refused(of_returns(Returns::First), "return numbers are all 0");
  scan.fields[1].values = {1, 1, 0};
  refused(of_returns(Returns::Last), "'scans/a.pcd': its points have no number of returns");
  scan.fields.clear();
  refused(of_classes({2}), "no classification to be selected by (fields: none)");
  EXPECT_EQ(scan.points.size(), 3u) << "a refused selection changes nothing";
  scan.faces.add(0, 1, 2);
  scan.fields = {field("classification", {2, 2, 1})};
  test::expect_error([&] { select_points(scan, of_classes({2}), "a.ply"); }, ErrorCode::InvalidArgument, "mesh");
}

TEST(SelectPoints, LasRecordsOfTheKeptPointsAreKeptBitForBit) {
  for (test::LasSpec spec : test::las_matrix()) {
    spec.points = 64;
    SCOPED_TRACE("LAS 1." + std::to_string(spec.minor) + " format " + std::to_string(spec.format));
    const Scan before = test::scan_of("a.las", test::las_file(spec));
    const Field* of = before.field("classification");
    ASSERT_TRUE(of);
    const int wanted = static_cast<int>(of->values[10]);
    Scan after = before;
    select_points(after, of_classes({wanted}), "a.las");
    const test::TemporaryFolder folder;
    write_scan(folder.file("out.las"), after);
    const Scan again = read_scan(folder.file("out.las"));
    std::size_t row = 0;
    for (std::size_t i = 0; i < spec.points; ++i) {
      if (of->values[i] != wanted) continue;
      const std::size_t length = las_of(before)->record_length;
      EXPECT_EQ(las_of(again)->points.substr(row++ * length, length), las_of(before)->points.substr(i * length, length))
          << i;
    }
    EXPECT_EQ(row, again.points.size());
    EXPECT_GT(row, 0u);
  }
}

TEST(NoReturns, ManyZerosAreNoReturns) {
  Scan scan = line(2000);
  scan.origin.setZero();
  const auto put_zeros = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) scan.points[7 * i] = Vec3(0.0, i % 2 ? -0.0 : 0.0, 0.0);
  };
  put_zeros(9);
  EXPECT_EQ(find_no_returns(scan).size(), 0u) << "fewer than ten";
  put_zeros(10);
  EXPECT_EQ(find_no_returns(scan).size(), 10u);
  EXPECT_EQ(find_no_returns(scan)[3], 21u);
  scan.origin.x() = 1e-3;
  EXPECT_EQ(find_no_returns(scan).size(), 0u) << "zeros are those of the file";
  for (std::size_t i = 0; i < 10; ++i) scan.points[7 * i] = Vec3(-1e-3, 0, 0);
  EXPECT_EQ(find_no_returns(scan).size(), 10u);
  scan.points.resize(10000, Vec3(1, 2, 3));
  EXPECT_EQ(find_no_returns(scan).size(), 0u) << "1 in 1000 at most";
  scan.points.resize(2000);
  scan.faces.add(0, 1, 2);
  EXPECT_EQ(find_no_returns(scan).size(), 0u) << "a mesh has corners, not returns";
}

TEST(NoReturns, OfASpinningScanner) {
  const std::string file = std::string(KAPPA_SHARED_DATA) + "/lidar/spinning/251370668.pcd";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data";
  EXPECT_EQ(find_no_returns(read_scan(file)).size(), 5032u);
  const Scan kinect = read_scan(std::string(KAPPA_SHARED_DATA) + "/clouds/table_scene_mug_stereo_textured.pcd");
  EXPECT_EQ(find_no_returns(kinect).size(), 0u);
}

Scan tilted() {
  Scan scan;
  scan.origin = Vec3(1000, 2000, 300);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-5, 5);
  for (int i = 0; i < 50; ++i) {
    scan.points.emplace_back(any(random), any(random), any(random));
    scan.normals.push_back(Vec3(any(random), any(random), any(random)));
  }
  scan.viewpoint = Vec3(1, 2, 3);
  return scan;
}

TEST(HeightUnit, ScalesHeightsAndIsUndoneToTheBit) {
  const Scan before = tilted();
  Scan scan = before;
  HeightUnit unit(0.3048);
  unit.apply(scan);
  EXPECT_EQ(scan.points[7].z(), 0.3048 * before.points[7].z());
  EXPECT_EQ(scan.points[7].head<2>().eval(), before.points[7].head<2>().eval());
  EXPECT_EQ(scan.origin, Vec3(1000, 2000, 300 * 0.3048));
  EXPECT_EQ(scan.viewpoint->z(), 3 * 0.3048);
  EXPECT_LT((unit.point_of_file(scan.points[7]) - before.points[7]).norm(), 1e-12);
  unit.restore(scan);
  EXPECT_EQ(scan.points, before.points);
  EXPECT_EQ(scan.normals, before.normals);
  EXPECT_EQ(scan.origin, before.origin);
  EXPECT_EQ(*scan.viewpoint, *before.viewpoint);
}

TEST(HeightUnit, NormalsStayPerpendicularToTheSurface) {
  const Scan before = tilted();
  Scan scan = before;
  HeightUnit unit(3.28);
  unit.apply(scan);
  for (std::size_t i = 0; i < scan.normals.size(); ++i) {
    const Vec3& u = before.normals[i];
    const Vec3 a = u.unitOrthogonal(), b = u.cross(a);
    for (const Vec3& tangent : {a, b}) {
      const Vec3 scaled(tangent.x(), tangent.y(), tangent.z() * 3.28);
      EXPECT_NEAR(scan.normals[i].dot(scaled), 0, 1e-12 * u.norm() * scaled.norm());
      EXPECT_LT((unit.direction_of_file(scaled.normalized()) - tangent.normalized()).norm(), 1e-12);
    }
    EXPECT_NEAR(scan.normals[i].norm(), u.norm(), 1e-12 * u.norm());
    EXPECT_LT((unit.normal_of_file(scan.normals[i]) - u).norm(), 1e-12 * u.norm());
  }
  EXPECT_EQ(unit.normal_of_file(Vec3::Zero()), Vec3::Zero());
}

TEST(HeightUnit, OneChangesNothing) {
  const Scan before = tilted();
  Scan scan = before;
  HeightUnit unit;
  unit.apply(scan);
  EXPECT_EQ(scan.points, before.points);
  EXPECT_EQ(scan.normals, before.normals);
  EXPECT_EQ(unit.direction_of_file(before.normals[0]), before.normals[0]);
}

TEST(HeightUnit, RefusesAScaleThatIsNone) {
  for (const double z_scale : {0.0, -1.0, kNaN, kInfinity})
    test::expect_error([&] { HeightUnit unit(z_scale); }, ErrorCode::InvalidArgument, "give a positive number");
}

TEST(NoReturns, LoseTheirPositionUntilRestored) {
  Scan scan = line(100);
  scan.origin = Vec3(0, 0, 1);
  for (std::size_t i = 0; i < 20; ++i) scan.points[5 * i] = Vec3(0, i % 2 ? -0.0 : 0.0, -1);
  const Scan before = scan;
  const SetAside none(scan, find_no_returns(scan));
  EXPECT_EQ(none.size(), 20u);
  EXPECT_FALSE(is_finite(scan.points[15]));
  EXPECT_TRUE(is_finite(scan.points[16]));
  none.restore(scan);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_TRUE(test::same_bits(scan.points[i].y(), before.points[i].y()));
  EXPECT_EQ(scan.points, before.points);
}

TEST(Withheld, AreFoundByTheirFlag) {
  Scan scan = line(10);
  EXPECT_TRUE(find_withheld(scan).empty());
  scan.fields = {{"Withheld", Field::Type::UInt8, {0, 1, 0, 0, 1, 0, 0, 0, 0, 1}}};
  scan.points[4].setConstant(kNaN);
  EXPECT_EQ(find_withheld(scan), (std::vector<Index>{1, 9}));
  scan.faces.add(0, 1, 2);
  EXPECT_TRUE(find_withheld(scan).empty()) << "a mesh needs its corners";
}

TEST(SetAside, RefusesWhatIsNoPoint) {
  Scan scan = line(10);
  test::expect_error([&] { SetAside(scan, {10}); }, ErrorCode::InvalidArgument, "point 10 of 10");
}

TEST(NoReturns, AreNotRestoredAmongOtherPoints) {
  Scan scan = line(100);
  scan.origin = Vec3(0, 0, 1);
  for (std::size_t i = 0; i < 20; ++i) scan.points[5 * i] = Vec3(0, 0, -1);
  const SetAside none(scan, find_no_returns(scan));
  EXPECT_EQ(select_points(scan, of_bounds({-9, -9, 0}, {9, 9, 9}), "a.pcd").unplaced, 20u);
  const std::vector<Vec3> selected = scan.points;
  none.restore(scan);
  EXPECT_EQ(scan.points, selected);
}

}  // namespace
}  // namespace kappa
