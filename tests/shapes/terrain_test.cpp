// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/terrain.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

Terrain mixed_terrain() {
  Terrain terrain;
  terrain.base = 3;
  terrain.slope = {0.1, -0.2};
  terrain.waves = {{1.5, 7, 9, 0.4, 1.2}, {-0.5, 3, 20, 0, 0}};
  terrain.bumps = {{{5, 6}, 4, 12, 3, 0.7}, {{-2, 8}, -3, std::numeric_limits<double>::infinity(), 4, -0.3}};
  return terrain;
}

// The same sum written out from the contract of the header.
double height(double x, double y) {
  const auto bump = [&](double cx, double cy, double height, double p, double q, double heading) {
    const double s = (x - cx) * std::cos(heading) + (y - cy) * std::sin(heading);
    const double t = (y - cy) * std::cos(heading) - (x - cx) * std::sin(heading);
    return height * std::exp(-0.5 * (s * s * p * p + t * t * q * q));
  };
  return 3 + 0.1 * x - 0.2 * y + 1.5 * std::sin(x / 7 + 0.4) * std::sin(y / 9 + 1.2) -
         0.5 * std::sin(x / 3) * std::sin(y / 20) + bump(5, 6, 4, 1 / 12.0, 1 / 3.0, 0.7) +
         bump(-2, 8, -3, 0, 1 / 4.0, -0.3);
}

TEST(Terrain, JetIsTheDerivativeOfTheHeight) {
  const Terrain terrain = mixed_terrain();
  Random random(1);
  constexpr double h = 1e-3;
  for (int trial = 0; trial < 500; ++trial) {
    const double x = random.uniform(-20, 20), y = random.uniform(-20, 20);
    const HeightJet jet = height_at(terrain, x, y);
    ASSERT_NEAR(jet.z, height(x, y), 1e-13);
    ASSERT_NEAR(jet.zx, (height(x + h, y) - height(x - h, y)) / (2 * h), 1e-6);
    ASSERT_NEAR(jet.zy, (height(x, y + h) - height(x, y - h)) / (2 * h), 1e-6);
    ASSERT_NEAR(jet.zxx, (height(x + h, y) - 2 * height(x, y) + height(x - h, y)) / (h * h), 1e-6);
    ASSERT_NEAR(jet.zyy, (height(x, y + h) - 2 * height(x, y) + height(x, y - h)) / (h * h), 1e-6);
    ASSERT_NEAR(
        jet.zxy,
        (height(x + h, y + h) - height(x + h, y - h) - height(x - h, y + h) + height(x - h, y - h)) / (4 * h * h),
        1e-6);
  }
}

Scene one_house(RoofKind roof) {
  Scene scene;
  scene.terrain.base = 100;
  scene.buildings = {{{10, 20}, 16, 10, 0.5, 4, 0.5, roof}};
  return scene;
}

/// Plan position of (along, across) of the house.
Vec2 at_house(double along, double across) {
  return {10 + along * std::cos(0.5) - across * std::sin(0.5), 20 + along * std::sin(0.5) + across * std::cos(0.5)};
}

SceneSample sample_house(const Scene& scene, double along, double across) {
  const Vec2 p = at_house(along, across);
  return sample_scene(scene, p.x(), p.y());
}

TEST(Roof, GabledHasTwoPlanes) {
  const Scene scene = one_house(RoofKind::Gabled);
  EXPECT_NEAR(sample_house(scene, 3, 0).height.z, 104 + 2.5, 1e-12);  // the ridge
  EXPECT_NEAR(sample_house(scene, 7.9, -2).height.z, 104 + 1.5, 1e-12);
  EXPECT_NEAR(sample_house(scene, -7.9, 4).height.z, 104 + 0.5, 1e-12);
  EXPECT_EQ(sample_house(scene, 8.1, 0).height.z, 100);
  EXPECT_EQ(sample_house(scene, 8.1, 0).building, -1);
  EXPECT_EQ(sample_house(scene, 7.9, 0).building, 0);
}

TEST(Roof, HippedHasFourPlanes) {
  const Scene scene = one_house(RoofKind::Hipped);
  EXPECT_NEAR(sample_house(scene, 2, 0).height.z, 104 + 2.5, 1e-12);
  EXPECT_NEAR(sample_house(scene, 7, 1).height.z, 104 + 0.5, 1e-12);  // an end
  EXPECT_NEAR(sample_house(scene, -6, -2).height.z, 104 + 1, 1e-12);
  EXPECT_NEAR(sample_house(scene, 2, 3).height.z, 104 + 1, 1e-12);
}

TEST(Roof, GradientIsThatOfTheHeight) {
  Random random(2);
  constexpr double h = 1e-5;
  for (const RoofKind roof : {RoofKind::Gabled, RoofKind::Hipped}) {
    const Scene scene = one_house(roof);
    for (int trial = 0; trial < 500; ++trial) {
      const Vec2 p = at_house(random.uniform(-9, 9), random.uniform(-6, 6));
      const SceneSample sample = sample_scene(scene, p.x(), p.y());
      if (sample.crease_distance < 2 * h) continue;
      const auto z = [&](double dx, double dy) { return sample_scene(scene, p.x() + dx, p.y() + dy).height.z; };
      ASSERT_NEAR(sample.height.zx, (z(h, 0) - z(-h, 0)) / (2 * h), 1e-8);
      ASSERT_NEAR(sample.height.zy, (z(0, h) - z(0, -h)) / (2 * h), 1e-8);
      ASSERT_EQ(sample.height.zxx, 0);
    }
  }
}

// Within the distance given the height is smooth; just beyond, in some direction, it is not.
TEST(Roof, CreaseDistanceReachesTheNearestEdge) {
  Random random(3);
  for (const RoofKind roof : {RoofKind::Gabled, RoofKind::Hipped}) {
    const Scene scene = one_house(roof);
    for (int trial = 0; trial < 200; ++trial) {
      const Vec2 p = at_house(random.uniform(-12, 12), random.uniform(-9, 9));
      const SceneSample centre = sample_scene(scene, p.x(), p.y());
      const auto leaves_its_plane = [&](double radius) {
        for (int a = 0; a < 720; ++a) {
          const Vec2 q = p + radius * Vec2(std::cos(a * kPi / 360), std::sin(a * kPi / 360));
          const double plane =
              centre.height.z + centre.height.zx * (q.x() - p.x()) + centre.height.zy * (q.y() - p.y());
          if (std::abs(sample_scene(scene, q.x(), q.y()).height.z - plane) > 1e-9) return true;
        }
        return false;
      };
      ASSERT_FALSE(leaves_its_plane(0.999 * centre.crease_distance)) << trial;
      ASSERT_TRUE(leaves_its_plane(1.01 * centre.crease_distance + 1e-6)) << trial;
    }
  }
}

TEST(Scene, DefaultHasEveryKindOfSurface) {
  const Scene scene = default_scene();
  EXPECT_NO_THROW(validate(scene));
  int convex = 0, concave = 0, saddle = 0, ridge = 0, valley = 0;
  double sharpest = 0;
  for (int i = 0; i < 160; ++i) {
    for (int j = 0; j < 160; ++j) {
      const TrueCurvature k = surface_point(i, j, height_at(scene.terrain, i, j)).curvature;
      constexpr double t = 1 / 60.0;
      convex += k.k_min > t ? 1 : 0;
      concave += k.k_max < -t ? 1 : 0;
      saddle += k.k_min < -t && k.k_max > t ? 1 : 0;
      ridge += std::abs(k.k_min) < t && k.k_max > t ? 1 : 0;
      valley += std::abs(k.k_max) < t && k.k_min < -t ? 1 : 0;
      sharpest = std::max({sharpest, k.k_max, -k.k_min});
    }
  }
  for (const int count : {convex, concave, saddle, ridge, valley}) EXPECT_GT(count, 80) << "m^2";
  EXPECT_LT(sharpest, 1 / 14.0);
  EXPECT_GT(sharpest, 1 / 20.0);
}

}  // namespace
}  // namespace kappa
