// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

/// Random points of the unit square on z = sin(3x) / 3, some of them twice and one without a position.
Scan random_cloud() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  Scan scan;
  for (int i = 0; i < 3000; ++i) {
    const double x = uniform(random), y = uniform(random);
    scan.points.emplace_back(x, y, std::sin(3 * x) / 3);
  }
  for (std::size_t i = 0; i < 20; ++i) scan.points[2900 + i] = scan.points[100 * i];
  scan.points[50] = Vec3::Constant(kNaN);
  scan.width = scan.points.size();
  return scan;
}

Scan reversed(Scan scan) {
  std::reverse(scan.points.begin(), scan.points.end());
  return scan;
}

/// Equal, or both NaN.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// Values of a field, those without an answer as 1e9.
std::vector<double> values_of(const Scan& scan, const std::string& field) {
  if (!scan.field(field)) return {};
  std::vector<double> values = scan.field(field)->values;
  std::replace_if(
      values.begin(), values.end(), [](double v) { return std::isnan(v); }, 1e9);
  return values;
}

/// What the command makes of a scan.
Scan result_of(const std::string& command, const Scan& scan) {
  const Folder f;
  write_scan(f.file("in.ply"), scan);
  const Outcome done = run({command, f.file("in.ply"), f.file("out.ply")});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  return read_scan(f.file("out.ply"));
}

void expect_points_of(const Scan& scan, const Scan& result) {
  ASSERT_EQ(result.points.size(), scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_TRUE(same(result.origin[axis] + result.points[i][axis], scan.points[i][axis])) << i;
  }
}

TEST(PointOrder, CurvaturesAndLabelsStandInTheOrderOfTheFileAndDoNotDependOnIt) {
  const Scan scan = random_cloud();
  const Scan forward = result_of("segment", scan), backward = result_of("segment", reversed(scan));
  expect_points_of(scan, forward);
  expect_points_of(reversed(scan), backward);
  for (const char* field : {"mean_curvature", "k_min", "dir_max_x", "face_count", "status", "label", "region"}) {
    std::vector<double> turned = values_of(backward, field);
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(turned.size(), scan.points.size()) << field;
    EXPECT_EQ(values_of(forward, field), turned) << field;
  }
  EXPECT_EQ(forward.field("status")->values[50], static_cast<double>(PointStatus::Invalid));
  const Scan alone = result_of("curvature", scan);
  for (const char* field : {"mean_curvature", "dir_max_x", "face_count"})
    EXPECT_EQ(values_of(alone, field), values_of(forward, field)) << field;
  ASSERT_EQ(alone.normals.size(), forward.normals.size());
  for (std::size_t i = 0; i < alone.normals.size(); ++i)
    EXPECT_TRUE(same(alone.normals[i].z(), forward.normals[i].z())) << i;
}

TEST(PointOrder, CurvatureIsThatOfThePlaceOfItsPoint) {
  const Scan result = result_of("curvature", random_cloud());
  std::size_t wrong = 0, inside = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const Vec3 x = result.points[i] + result.origin;
    if (!(x.x() > 0.25 && x.x() < 0.75 && x.y() > 0.25 && x.y() < 0.75)) continue;
    const double slope = std::cos(3 * x.x());
    const double truth = 1.5 * std::sin(3 * x.x()) / std::pow(1 + slope * slope, 1.5);
    wrong += !(std::abs(result.field("mean_curvature")->values[i] - truth) < 0.2);
    ++inside;
  }
  EXPECT_GT(inside, 500u);
  EXPECT_EQ(wrong, 0u);
}

TEST(PointOrder, FacesNameThePointsOfTheFile) {
  const Scan scan = random_cloud();
  const Scan mesh = result_of("mesh", scan);
  expect_points_of(scan, mesh);
  ASSERT_GT(mesh.faces.size(), 5000u);
  double longest = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh.points[face[i]] - mesh.points[face[(i + 1) % 3]]).norm());
  }
  EXPECT_LT(longest, 0.2);  // eleven times the spacing
}

}  // namespace
}  // namespace kappa::apps
