// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "checks.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/implicit.hpp"

namespace kappa {
namespace {

/// Share of the points of a cloud for which `test` holds.
template <class Test>
double share(const Scan& scan, const Test& test) {
  std::size_t count = 0;
  for (const auto& x : scan.points) count += test(x) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(scan.points.size());
}

constexpr std::size_t kPoints = 40000;
constexpr double kSpread = 0.01;  // four standard deviations of a share of kPoints

TEST(Sampling, SphereIsEvenByHeight) {
  const Scan scan = sample_sphere(2, {kPoints, 1});
  test::expect_complete(scan);
  EXPECT_TRUE(scan.faces.empty());
  for (const auto& x : scan.points) ASSERT_NEAR(x.norm(), 2, 1e-14);
  EXPECT_NEAR(share(scan, [](const Vec3& x) { return x.z() > 1; }), 0.25, kSpread);
}

TEST(Sampling, TorusIsEvenByArea) {
  const Scan scan = sample_torus(3, 1, {kPoints, 2});
  test::expect_complete(scan);
  for (const auto& x : scan.points) ASSERT_NEAR(std::hypot(x.head<2>().norm() - 3, x.z()), 1, 1e-13);
  EXPECT_NEAR(share(scan, [](const Vec3& x) { return x.head<2>().norm() > 3; }), 0.5 + 1 / (3 * kPi), kSpread);
  EXPECT_NEAR(share(scan, [](const Vec3& x) { return x.x() > 0; }), 0.5, kSpread);
}

TEST(Sampling, CylinderIsEven) {
  const Scan scan = sample_cylinder(2, 5, {kPoints, 3});
  test::expect_complete(scan);
  EXPECT_NEAR(share(scan, [](const Vec3& x) { return x.z() < 1; }), 0.2, kSpread);
  EXPECT_NEAR(share(scan, [](const Vec3& x) { return x.y() > 0; }), 0.5, kSpread);
}

TEST(Sampling, QuadricIsEvenByArea) {
  const Scan scan = sample_quadric(2, -2, 2, {kPoints, 4});
  test::expect_complete(scan);
  const auto inner = [](double x, double y) { return std::abs(x) < 0.5 && std::abs(y) < 0.5; };
  double all = 0, middle = 0;  // midpoint rule for the two areas
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j) {
      const double x = (i + 0.5) / 200 - 1, y = (j + 0.5) / 200 - 1;
      const double area = std::sqrt(1 + 4 * x * x + 4 * y * y);
      all += area;
      middle += inner(x, y) ? area : 0;
    }
  }
  EXPECT_NEAR(share(scan, [&](const Vec3& x) { return inner(x.x(), x.y()); }), middle / all, kSpread);
}

TEST(Sampling, GoursatIsNearlyEven) {
  const Scan scan = sample_goursat({kPoints, 5});
  test::expect_complete(scan);
  for (const auto& x : scan.points) {
    const ImplicitJet jet = goursat_function(x);
    ASSERT_NEAR(jet.value / jet.gradient.norm(), 0, 1e-13);
  }
  // Where it is most curved, against a mesh finer than the one drawn on.
  const auto edge = [](const Vec3& x) { return x.norm() > 11.5; };
  const Scan fine = goursat({0.125, Extraction::SurfaceNets});
  double all = 0, outer = 0;
  for (std::size_t f = 0; f < fine.faces.size(); ++f) {
    const double area = test::vector_area(fine, f).norm();
    all += area;
    outer += edge(fine.points[fine.faces[f][0]]) ? area : 0;
  }
  ASSERT_GT(outer / all, 0.1);
  EXPECT_NEAR(share(scan, edge) / (outer / all), 1, 0.04);
}

TEST(Sampling, DependsOnTheSeedAlone) {
  const Scan a = sample_torus(3, 1, {100, 7}), b = sample_torus(3, 1, {100, 7}), c = sample_torus(3, 1, {100, 8});
  EXPECT_EQ(a.points, b.points);
  EXPECT_NE(a.points, c.points);
  // A shorter cloud is the start of a longer one.
  const Scan shorter = sample_torus(3, 1, {50, 7});
  EXPECT_TRUE(std::equal(shorter.points.begin(), shorter.points.end(), a.points.begin()));
}

}  // namespace
}  // namespace kappa
