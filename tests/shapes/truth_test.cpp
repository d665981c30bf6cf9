// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/truth.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

Vec3 random_vector(Random& random) {
  return 2 * random.in_ball();
}

ParametricJet random_jet(Random& random) {
  ParametricJet jet;
  for (Vec3* v : {&jet.x, &jet.du, &jet.dv, &jet.duu, &jet.duv, &jet.dvv}) *v = random_vector(random);
  return jet;
}

// Mean and Gaussian curvature by the classical quotients of the two fundamental forms.
TEST(Truth, ParametrisationAgreesWithFundamentalForms) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const ParametricJet jet = random_jet(random);
    const Vec3 n = jet.du.cross(jet.dv).normalized();
    if (jet.du.cross(jet.dv).norm() < 0.1) continue;
    const double e = jet.du.dot(jet.du), f = jet.du.dot(jet.dv), g = jet.dv.dot(jet.dv);
    const double l = -jet.duu.dot(n), m = -jet.duv.dot(n), p = -jet.dvv.dot(n);
    const SurfacePoint point = surface_point(jet);
    const double scale = std::max(std::abs(point.curvature.k_min), std::abs(point.curvature.k_max));
    ASSERT_NEAR(point.curvature.mean, (e * p - 2 * f * m + g * l) / (2 * (e * g - f * f)), 1e-10 * scale);
    ASSERT_NEAR(point.curvature.gaussian, (l * p - m * m) / (e * g - f * f), 1e-10 * scale * scale);
    ASSERT_NEAR(point.curvature.k_min + point.curvature.k_max, 2 * point.curvature.mean, 1e-12 * scale);
    // Euler's theorem: the normal curvature along du.
    const double along = jet.du.normalized().dot(point.curvature.dir_max);
    const double euler = point.curvature.k_max * along * along + point.curvature.k_min * (1 - along * along);
    ASSERT_NEAR(l / e, euler, 1e-9 * scale);
  }
}

TEST(Truth, ReversingParametersFlipsTheSign) {
  Random random(2);
  ParametricJet jet = random_jet(random);
  const SurfacePoint one = surface_point(jet);
  std::swap(jet.du, jet.dv);
  std::swap(jet.duu, jet.dvv);
  const SurfacePoint other = surface_point(jet);
  EXPECT_NEAR((one.normal + other.normal).norm(), 0, 1e-13);
  EXPECT_NEAR(one.curvature.k_min, -other.curvature.k_max, 1e-10);
  EXPECT_NEAR(one.curvature.gaussian, other.curvature.gaussian, 1e-10);
  EXPECT_NEAR(std::abs(one.curvature.dir_min.dot(other.curvature.dir_max)), 1, 1e-10);
}

TEST(Truth, ImplicitAgreesWithHeight) {
  Random random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    HeightJet height;
    for (double* value : {&height.z, &height.zx, &height.zy, &height.zxx, &height.zxy, &height.zyy}) {
      *value = random.uniform(-1, 1);
    }
    ImplicitJet implicit;  // z - height(x, y), positive above
    implicit.gradient = {-height.zx, -height.zy, 1};
    implicit.hessian << -height.zxx, -height.zxy, 0, -height.zxy, -height.zyy, 0, 0, 0, 0;
    const SurfacePoint a = surface_point(0.3, 0.4, height), b = surface_point(a.x, implicit);
    ASSERT_NEAR((a.normal - b.normal).norm(), 0, 1e-14);
    ASSERT_GT(a.normal.z(), 0);
    ASSERT_NEAR(a.curvature.k_min, b.curvature.k_min, 1e-13);
    ASSERT_NEAR(a.curvature.k_max, b.curvature.k_max, 1e-13);
    ASSERT_NEAR(std::abs(a.curvature.dir_min.dot(b.curvature.dir_min)), 1, 1e-9);
    ASSERT_NEAR(std::abs(a.curvature.dir_max.dot(b.curvature.dir_max)), 1, 1e-9);
  }
}

TEST(Truth, ConvexIsPositiveAndUmbilicsHaveNoDirections) {
  ImplicitJet sphere;  // |x|^2 - 4 at (0, 0, 2)
  sphere.gradient = {0, 0, 4};
  sphere.hessian = 2 * Mat3::Identity();
  const TrueCurvature k = surface_point({0, 0, 2}, sphere).curvature;
  EXPECT_DOUBLE_EQ(k.k_min, 0.5);
  EXPECT_DOUBLE_EQ(k.k_max, 0.5);
  EXPECT_TRUE(std::isnan(k.dir_min.sum()) && std::isnan(k.dir_max.sum()));

  const TrueCurvature flat = surface_point(1, 2, HeightJet()).curvature;
  EXPECT_EQ(flat.mean, 0);
  EXPECT_FALSE(std::signbit(flat.mean));
  EXPECT_TRUE(std::isnan(flat.dir_min.sum()));
}

TEST(Truth, DegeneratePointsAreNaN) {
  ParametricJet pole;
  pole.du = {1, 0, 0};
  const SurfacePoint point = surface_point(pole);
  EXPECT_TRUE(std::isnan(point.normal.x()));
  EXPECT_TRUE(std::isnan(point.curvature.mean) && std::isnan(point.curvature.k_max));
  EXPECT_TRUE(std::isnan(surface_point(Vec3::Zero(), ImplicitJet()).curvature.gaussian));
}

}  // namespace
}  // namespace kappa
