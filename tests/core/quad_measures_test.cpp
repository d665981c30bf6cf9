// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/quad_measures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "kappa/core/measures.hpp"
#include "support/oracles.hpp"

namespace kappa {
namespace {

using Quad = std::array<Vec3, 4>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}
  Vec3 vector() { return Vec3(normal_(random_), normal_(random_), normal_(random_)); }
  Vec3 unit() { return vector().normalized(); }
  Quad units() { return {unit(), unit(), unit(), unit()}; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

void expect_forms(const Measures& m, const oracle::Forms& f, double length) {
  const double tolerance = 2e-14;
  EXPECT_NEAR(m.mu0, static_cast<double>(f.mu0), tolerance * length * length);
  EXPECT_NEAR(m.mu1, static_cast<double>(f.mu1), tolerance * length);
  EXPECT_NEAR(m.mu2, static_cast<double>(f.mu2), tolerance);
  EXPECT_NEAR((m.mu_xy - f.mu_xy.cast<double>()).cwiseAbs().maxCoeff(), 0, tolerance * length);
  EXPECT_NEAR(m.mu_xy.trace(), -m.mu1, tolerance * length);
}

double size_of(const Quad& x) {
  double size = 0;
  for (const Vec3& a : x) size = std::max(size, (a - x[0]).norm());
  return size;
}

TEST(BilinearMeasures, AnyQuadAgreesWithQuadrature) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Quad x = {random.vector(), random.vector(), random.vector(), random.vector()}, u = random.units();
    expect_forms(bilinear_measures(x, u), oracle::bilinear_forms(x, u), size_of(x));
  }
}

TEST(BilinearMeasures, PlanarTrapeziumsAndParallelograms) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random.vector(), e = random.vector(), f = random.vector();
    for (const double lean : {1.0, 0.4}) {
      const Quad x = {a, a + e, a + f, a + f + lean * e}, u = random.units();
      expect_forms(bilinear_measures(x, u), oracle::bilinear_forms(x, u), size_of(x));
    }
  }
}

TEST(BilinearMeasures, TriangleWithADoubledCorner) {
  Random random(3);
  const Vec3 a = random.vector(), b = random.vector(), c = random.vector();
  const Quad x = {a, b, c, c}, u = random.units();
  expect_forms(bilinear_measures(x, u), oracle::bilinear_forms(x, u), size_of(x));
}

TEST(BilinearMeasures, TurnedCornersAndRigidMotion) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Quad x = {random.vector(), random.vector(), random.vector(), random.vector()}, u = random.units();
    const Measures m = bilinear_measures(x, u);
    // A quarter turn of the parameters: (00, 10, 01, 11) -> (10, 11, 00, 01).
    const Measures turned = bilinear_measures({x[1], x[3], x[0], x[2]}, {u[1], u[3], u[0], u[2]});
    EXPECT_NEAR(turned.mu0, m.mu0, 1e-13);
    EXPECT_NEAR(turned.mu1, m.mu1, 1e-13);
    EXPECT_NEAR(turned.mu2, m.mu2, 1e-13);
    EXPECT_NEAR((turned.mu_xy - m.mu_xy).norm(), 0, 1e-13);
    const Mat3 r = Eigen::AngleAxisd(1.0 + i, random.unit()).toRotationMatrix();
    const Measures moved =
        bilinear_measures({r * x[0], r * x[1], r * x[2], r * x[3]}, {r * u[0], r * u[1], r * u[2], r * u[3]});
    EXPECT_NEAR((moved.mu_xy - r * m.mu_xy * r.transpose()).norm(), 0, 1e-13);
    EXPECT_NEAR(moved.mu0, m.mu0, 1e-13);
  }
}

TEST(BilinearMeasures, NothingChangesAtGeoreferencedCoordinates) {
  Random random(5);
  const Vec3 utm(500000, 5400000, 100);
  for (int i = 0; i < 100; ++i) {
    Quad x = {random.vector(), random.vector(), random.vector(), random.vector()}, far;
    for (int c = 0; c < 4; ++c) {
      x[c] = (1024 * x[c]).array().round() / 1024;
      far[c] = x[c] + utm;
    }
    const Quad u = random.units();
    const Measures a = bilinear_measures(x, u), b = bilinear_measures(far, u);
    EXPECT_NEAR(a.mu0, b.mu0, 1e-13);
    EXPECT_NEAR(a.mu1, b.mu1, 1e-13);
    EXPECT_NEAR((a.mu_xy - b.mu_xy).norm(), 0, 1e-13);
  }
}

TEST(BilinearMeasures, AreaIsThatOfTheSplit) {
  Random random(6);
  const Quad x = {random.vector(), random.vector(), random.vector(), random.vector()}, u = random.units();
  const Quad cycle = {x[0], x[1], x[3], x[2]}, normals = {u[0], u[1], u[3], u[2]};
  EXPECT_NEAR(bilinear_measures(x, u).area, polygon_measures(cycle.data(), normals.data(), 4).area, 1e-14);
}

TEST(SurfelMeasures, AgreesWithTheBilinearPatch) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 ax = random.unit(), ay = ax.cross(random.unit()).normalized();
    const Quad u = random.units();
    for (const double h : {1e-3, 1.0, 50.0}) {
      const Quad x = {Vec3::Zero(), h * ax, h * ay, h * (ax + ay)};
      const Measures m = surfel_measures(ax, ay, h, u);
      expect_forms(m, oracle::bilinear_forms(x, u), 2 * h);
      EXPECT_NEAR(m.area, h * h, 1e-14 * h * h);
    }
  }
}

TEST(PolygonMeasures, SumOfItsParts) {
  Random random(8);
  for (const std::size_t n : {4, 5, 9}) {
    std::vector<Vec3> x, u;
    Vec3 centre = Vec3::Zero(), mean = Vec3::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(random.vector());
      u.push_back(random.unit());
      centre += x.back() / static_cast<double>(n);
      mean += u.back() / static_cast<double>(n);
    }
    EXPECT_NEAR((polygon_barycentre(x.data(), n) - centre).norm(), 0, 1e-15);
    EXPECT_NEAR((barycentre_normal(u.data(), n) - mean.normalized()).norm(), 0, 1e-15);
    Measures sum;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      sum += triangle_measures({x[i], x[j], centre}, {u[i], u[j], mean.normalized()});
    }
    const Measures m = polygon_measures(x.data(), u.data(), n);
    EXPECT_NEAR(m.area, sum.area, 1e-13);
    EXPECT_NEAR(m.mu0, sum.mu0, 1e-13);
    EXPECT_NEAR(m.mu1, sum.mu1, 1e-13);
    EXPECT_NEAR(m.mu2, sum.mu2, 1e-13);
    EXPECT_NEAR((m.mu_xy - sum.mu_xy).norm(), 0, 1e-13);
  }
}

TEST(PolygonMeasures, TriangleIsNotSplit) {
  Random random(9);
  const std::array<Vec3, 3> x = {random.vector(), random.vector(), random.vector()};
  const std::array<Vec3, 3> u = {random.unit(), random.unit(), random.unit()};
  const Measures a = triangle_measures(x, u), b = polygon_measures(x.data(), u.data(), 3);
  EXPECT_EQ(a.mu0, b.mu0);
  EXPECT_EQ(a.mu1, b.mu1);
  EXPECT_EQ(a.mu2, b.mu2);
  EXPECT_EQ(a.mu_xy, b.mu_xy);
}

TEST(PolygonMeasures, NormalsThatCancelGiveTheZeroVector) {
  const std::array<Vec3, 4> u = {Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()};
  EXPECT_EQ(barycentre_normal(u.data(), 4), Vec3::Zero().eval());
  const std::array<Vec3, 4> tiny = {Vec3::UnitX(), -Vec3::UnitX() + Vec3(0, 0, 1e-13), Vec3::UnitY(), -Vec3::UnitY()};
  EXPECT_EQ(barycentre_normal(tiny.data(), 4), Vec3::Zero().eval());
}

}  // namespace
}  // namespace kappa
