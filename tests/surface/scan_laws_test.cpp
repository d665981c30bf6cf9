// SPDX-License-Identifier: BSD-3-Clause
// What must not change the curvature of a scan: the offset of its file, and the format it is in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "io/support.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa {
namespace {

constexpr std::size_t kScale = 131, kOffset = 155;  // of the header of LAS

/// Rolling terrain in whole millimetres, some points a metre apart.
Scan terrain() {
  Scan scan;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(0, 50);
  const auto millimetres = [](double x) { return std::round(1000 * x) / 1000; };
  for (int i = 0; i < 2500; ++i) {
    const double x = millimetres(place(random)), y = millimetres(place(random));
    scan.points.emplace_back(x, y, millimetres(3 * std::sin(0.2 * x) * std::cos(0.15 * y)));
  }
  scan.width = scan.points.size();
  return scan;
}

std::string las_bytes(const Scan& scan) {
  const test::TemporaryFolder folder;
  write_scan(folder.file("a.las"), scan);
  return test::content_of(folder.file("a.las"));
}

std::string with_offset(std::string bytes, const Vec3& offset) {
  std::memcpy(bytes.data() + kOffset, offset.data(), 3 * sizeof(double));
  return bytes;
}

CurvatureField curvature(const Scan& scan) {
  const Surface s = make_surface(scan, {});
  const MeasureTree tree(triangles_of(s.mesh, s.u, QuadMeasures::Split));
  return curvatures_in_balls(tree, s.mesh.vertices, s.u, {{4.0}}).front();
}

/// To 1e-6 of the largest value, and the same points without one.
void expect_equal(const CurvatureField& a, const CurvatureField& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (double Curvatures::*value : {&Curvatures::mean, &Curvatures::gaussian, &Curvatures::k_min, &Curvatures::k_max}) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
      const double x = a.samples[i].k.*value, y = b.samples[i].k.*value;
      ASSERT_EQ(std::isnan(x), std::isnan(y)) << i;
      if (std::isnan(x)) continue;
      largest = std::max(largest, std::abs(x));
      difference = std::max(difference, std::abs(x - y));
    }
    EXPECT_GT(largest, 1e-3);
    EXPECT_LT(difference, 1e-6 * largest);
  }
}

TEST(ScanLaws, TheOffsetOfALasFileChangesNothing) {
  const std::string bytes = las_bytes(terrain());
  const CurvatureField near = curvature(test::scan_of("a.las", bytes));
  for (const Vec3& offset :
       {Vec3(5e6, 5.4e6, 300), Vec3(-3123456.789, 9876543.21, -1e5), Vec3(1e9 / 3, -1e9 / 7, 4e6 / 3)}) {
    const Scan far = test::scan_of("a.las", with_offset(bytes, offset));
    EXPECT_GT(far.origin.norm(), 1e6) << "the points are far away";
    expect_equal(curvature(far), near);
  }
}

TEST(ScanLaws, AScaleThatIsNoDecimalChangesNothingButTheSize) {
  std::string bytes = las_bytes(terrain());
  const CurvatureField metres = curvature(test::scan_of("a.las", bytes));
  const Vec3 feet = Vec3::Constant(1e-3 * 0.3048);
  std::memcpy(bytes.data() + kScale, feet.data(), 3 * sizeof(double));
  const Scan scaled = test::scan_of("a.las", with_offset(bytes, Vec3(4e6, 5e6, 100)));
  const Surface s = make_surface(scaled, {});
  const MeasureTree tree(triangles_of(s.mesh, s.u, QuadMeasures::Split));
  CurvatureField field = curvatures_in_balls(tree, s.mesh.vertices, s.u, {{4 * 0.3048}}).front();
  for (CurvatureSample& sample : field.samples) {
    sample.k.mean *= 0.3048;
    sample.k.gaussian *= 0.3048 * 0.3048;
    sample.k.k_min *= 0.3048;
    sample.k.k_max *= 0.3048;
  }
  expect_equal(field, metres);
}

TEST(ScanLaws, EveryFormatGivesTheSameCurvature) {
  Scan scan = terrain();
  scan.origin = Vec3(512000, 5403000, 300);
  const test::TemporaryFolder folder;
  for (const char* extension : {"las", "pcd", "ply", "csv"})
    write_scan(folder.file(std::string("a.") + extension), scan);
  const CurvatureField las = curvature(read_scan(folder.file("a.las")));
  for (const char* extension : {"pcd", "ply", "csv"}) {
    SCOPED_TRACE(extension);
    expect_equal(curvature(read_scan(folder.file(std::string("a.") + extension))), las);
  }
}

/// Coordinates in whole centimetres have ties, among neighbours as far away as each other and corners on one circle,
/// which the last digit decides: LAS stores (integer * 0.01), PCD the rounded sum with the offset. So a normal or a
/// star differs here and there, and with it the curvature of the points around.
TEST(ScanLaws, ARealScanGivesTheSameAsLasAndPcdButForTies) {
  const std::string file = std::string(KAPPA_SHARED_DATA) + "/lidar/airborne-las/warsaw_small.las";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const Scan las = read_scan(file);
  const test::TemporaryFolder folder;
  write_scan(folder.file("a.pcd"), las);
  const Scan pcd = read_scan(folder.file("a.pcd"));
  const Normals u = make_surface(las, {}).u, v = make_surface(pcd, {}).u;
  const CurvatureField a = curvature(las), b = curvature(pcd);
  double largest = 0;
  for (const CurvatureSample& s : a.samples) largest = std::max(largest, std::abs(s.k.mean));
  std::size_t ties = 0, unequal = 0, far = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const double difference = std::abs(a.samples[i].k.mean - b.samples[i].k.mean);
    ties += (u[i] - v[i]).norm() > 1e-7;
    unequal += difference > 1e-6 * largest;
    far += difference > 1e-3 * largest;
  }
  EXPECT_LE(ties, 3u);
  EXPECT_LT(unequal, las.points.size() / 20);
  EXPECT_EQ(far, 0u);
}

}  // namespace
}  // namespace kappa
