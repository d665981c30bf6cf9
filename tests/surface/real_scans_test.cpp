// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "kappa/io/read.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/surface/delaunay.hpp"
#include "kappa/surface/grid.hpp"
#include "kappa/surface/orientation.hpp"
#include "kappa/surface/spinning.hpp"

namespace kappa {
namespace {

std::string shared(const std::string& file) {
  return std::string(KAPPA_SHARED_DATA) + "/" + file;
}

TEST(RealScans, DepthImageOfATable) {
  const std::string path = shared("clouds/table_scene_mug_stereo_textured.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const Scan scan = read_scan(path);
  const GridSurface s = grid_surface(scan.origin, scan.points, scan.width, scan.height, -scan.origin, {});
  EXPECT_EQ(s.surface.invalid_points, 97920u);
  EXPECT_GT(s.surface.mesh.faces.size(), 400000u);
  EXPECT_LT(s.surface.starless_points, 300u);
  EXPECT_LT(s.cuts.depth_jumps + s.cuts.grazing + s.cuts.degenerate, 2000u);
}

TEST(RealScans, SweepOfASpinningScanner) {
  const std::string path = shared("lidar/spinning/251370668.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const Scan scan = read_scan(path);
  const SpinningSurface s = spinning_surface(scan.origin, scan.points, -scan.origin, {});
  EXPECT_EQ(s.sweep.rings, 32u);
  EXPECT_EQ(s.sweep.columns, 2160u);
  EXPECT_EQ(s.sweep.at_sensor, 5032u);
  EXPECT_LT(s.sweep.extra_returns, 20u);
  // The file stores the lasers of each shot in one fixed order, which is not used: 32 points a shot.
  for (std::size_t r = 0; r < s.sweep.rings; ++r) {
    Index laser = kNoIndex;
    for (std::size_t c = 0; c < s.sweep.columns; ++c) {
      const Index i = s.sweep.cells[r * s.sweep.columns + c];
      if (i == kNoIndex) continue;
      if (laser == kNoIndex) laser = i % 32;
      EXPECT_EQ(i % 32, laser);
    }
  }
  EXPECT_GT(s.grid.surface.mesh.faces.size(), 100000u);
}

TEST(RealScans, AirborneTileHasOneHeightAtEachPlace) {
  const std::string path = shared("lidar/airborne-pcd/samp11-utm.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const Scan scan = read_scan(path);
  const PlanSurface s = delaunay_surface(scan.origin, scan.points, {});
  const std::size_t sites = scan.points.size() - s.surface.duplicate_points;
  EXPECT_LE(s.surface.mesh.faces.size() + s.cut_faces, 2 * sites);
  EXPECT_GT(s.surface.mesh.faces.size(), 1.9 * static_cast<double>(sites));
  for (Index i = 0; i < scan.points.size(); ++i)
    EXPECT_GE(scan.points[s.surface.representative[i]].z(), scan.points[i].z());
}

TEST(RealScans, FittedNormalsOfTerrainAgree) {
  const std::string path = shared("lidar/airborne-pcd/samp53-utm-ground.pcd");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const Scan scan = read_scan(path);
  Normals u = fitted_normals(scan.points, {});
  for (std::size_t i = 0; i < u.size(); i += 3) u[i] = -u[i];  // their sign is arbitrary
  EXPECT_GT(normal_agreement(scan.points, u).opposed_share(), kSuspiciousDisagreement);
  EXPECT_LT(orient_consistently(scan.points, u).agreement.opposed_share(), 0.001);
  // A few points of its cliffs, whose planes lean over backwards, may look down.
  const auto down = std::count_if(u.begin(), u.end(), [](const Vec3& v) { return v.z() < 0; });
  EXPECT_LT(down, 0.001 * static_cast<double>(u.size()));
}

}  // namespace
}  // namespace kappa
