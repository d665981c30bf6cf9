// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kappa/core/bounds.hpp"
#include "support/expect_error.hpp"
#include "support/utm_points.hpp"

namespace kappa {
namespace {

using test::expect_error;
using test::utm_points;

TEST(MoveToLocalOrigin, KeepsPositionsAndIsIdempotent) {
  Scan scan;
  scan.points = utm_points(Vec3(500000, 5400000, 100), 100, 9);
  scan.points.emplace_back(kNaN, kNaN, kNaN);
  const std::vector<Vec3> before = scan.points;
  move_to_local_origin(scan);
  EXPECT_LT(bounds(scan.points).max.norm(), 2000);
  for (std::size_t i = 0; i + 1 < before.size(); ++i) ASSERT_EQ((scan.points[i] + scan.origin).eval(), before[i]);
  const std::vector<Vec3> local = scan.points;
  const Vec3 origin = scan.origin;
  move_to_local_origin(scan);
  EXPECT_EQ(scan.origin, origin);
  for (std::size_t i = 0; i + 1 < local.size(); ++i) ASSERT_EQ(scan.points[i], local[i]);
  EXPECT_TRUE(std::isnan(scan.points.back().x()));
}

TEST(MeshOf, NeedsFaces) {
  Scan scan;
  scan.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  expect_error(ErrorCode::InvalidData, [&] { mesh_of(scan); }, {"faces"});
  scan.faces.add(0, 1, 2);
  scan.origin = Vec3(7, 8, 9);
  const Mesh mesh = mesh_of(scan);
  EXPECT_EQ(mesh.origin, scan.origin);
  EXPECT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.faces.size(), 1U);
}

TEST(Scan, FindsFieldsByName) {
  Scan scan;
  scan.fields.push_back({"intensity", Field::Type::UInt16, {1, 2}});
  ASSERT_NE(scan.field("intensity"), nullptr);
  EXPECT_EQ(scan.field("intensity")->values[1], 2);
  EXPECT_EQ(scan.field("none"), nullptr);
}

}  // namespace
}  // namespace kappa
