// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/measures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "support/oracles.hpp"

namespace kappa {
namespace {

constexpr double kRounding = 1e-14;

struct Patch {
  std::array<Vec3, 3> x, u;
};

class Random {
 public:
  Vec3 vector() { return Vec3(normal_(random_), normal_(random_), normal_(random_)); }
  Vec3 unit() { return vector().normalized(); }
  Patch patch() { return {{vector(), vector(), vector()}, {unit(), unit(), unit()}}; }
  Mat3 rotation() { return Eigen::AngleAxisd(3 * normal_(random_), unit()).toRotationMatrix(); }

 private:
  std::mt19937_64 random_{42};
  std::normal_distribution<double> normal_;
};

/// Size of the products each measure is a sum of: what rounding is relative to.
struct Scales {
  double mu0, mu1, mu2;
};
Scales scales(const Patch& p) {
  double e = 0, d = 0;
  for (int i = 0; i < 3; ++i) {
    e = std::max(e, (p.x[(i + 1) % 3] - p.x[i]).norm());
    d = std::max(d, (p.u[(i + 1) % 3] - p.u[i]).norm());
  }
  return {e * e, e * d, d * d};
}

void expect_same(const Measures& a, const Measures& b, const Scales& s, double tolerance) {
  EXPECT_NEAR(a.area, b.area, tolerance * s.mu0);
  EXPECT_NEAR(a.mu0, b.mu0, tolerance * s.mu0);
  EXPECT_NEAR(a.mu1, b.mu1, tolerance * s.mu1);
  EXPECT_NEAR(a.mu2, b.mu2, tolerance * s.mu2);
  EXPECT_NEAR((a.mu_xy - b.mu_xy).cwiseAbs().maxCoeff(), 0, tolerance * s.mu1);
}

template <int Count>
class Many {
 public:
  template <class Body>
  void each(Body body) {
    for (int i = 0; i < Count; ++i) body(random_);
  }

 private:
  Random random_;
};

TEST(TriangleMeasures, AgreesWithQuadratureOfTheForms) {
  Many<500>().each([](Random& random) {
    const Patch p = random.patch();
    const Measures m = triangle_measures(p.x, p.u);
    const oracle::Forms f = oracle::triangle_forms(p.x, p.u);
    const Scales s = scales(p);
    EXPECT_NEAR(m.mu0, static_cast<double>(f.mu0), kRounding * s.mu0);
    EXPECT_NEAR(m.mu1, static_cast<double>(f.mu1), kRounding * s.mu1);
    EXPECT_NEAR(m.mu2, static_cast<double>(f.mu2), kRounding * s.mu2);
    EXPECT_NEAR((m.mu_xy - f.mu_xy.cast<double>()).cwiseAbs().maxCoeff(), 0, kRounding * s.mu1);
    EXPECT_NEAR(m.area, (p.x[1] - p.x[0]).cross(p.x[2] - p.x[0]).norm() / 2, kRounding * s.mu0);
  });
}

TEST(TriangleMeasures, TraceAndMeanNormal) {
  Many<500>().each([](Random& random) {
    const Patch p = random.patch();
    const Measures m = triangle_measures(p.x, p.u);
    const Vec3 mean = (p.u[0] + p.u[1] + p.u[2]) / 3;
    EXPECT_NEAR(m.mu_xy.trace(), -m.mu1, kRounding * scales(p).mu1);
    EXPECT_NEAR((mean.transpose() * m.mu_xy).cwiseAbs().maxCoeff(), 0, kRounding * scales(p).mu1);
    EXPECT_NEAR(m.mu2, p.u[0].dot(p.u[1].cross(p.u[2])) / 2, kRounding * scales(p).mu2);
  });
}

TEST(TriangleMeasures, SameForAnyFirstCorner) {
  Many<300>().each([](Random& random) {
    const Patch p = random.patch();
    const Measures m = triangle_measures(p.x, p.u);
    expect_same(triangle_measures({p.x[1], p.x[2], p.x[0]}, {p.u[1], p.u[2], p.u[0]}), m, scales(p), kRounding);
    expect_same(triangle_measures({p.x[2], p.x[0], p.x[1]}, {p.u[2], p.u[0], p.u[1]}), m, scales(p), kRounding);
  });
}

TEST(TriangleMeasures, ReversedFaceFlipsAllButTheArea) {
  Many<100>().each([](Random& random) {
    const Patch p = random.patch();
    Measures m = triangle_measures({p.x[0], p.x[2], p.x[1]}, {p.u[0], p.u[2], p.u[1]});
    m.mu0 = -m.mu0;
    m.mu1 = -m.mu1;
    m.mu2 = -m.mu2;
    m.mu_xy = -m.mu_xy;
    expect_same(m, triangle_measures(p.x, p.u), scales(p), kRounding);
  });
}

TEST(TriangleMeasures, FlippedNormalsFlipOddPowers) {
  Many<100>().each([](Random& random) {
    const Patch p = random.patch();
    Measures m = triangle_measures(p.x, {-p.u[0], -p.u[1], -p.u[2]});
    m.mu0 = -m.mu0;
    m.mu2 = -m.mu2;
    expect_same(m, triangle_measures(p.x, p.u), scales(p), 0);
  });
}

TEST(TriangleMeasures, RigidMotion) {
  Many<300>().each([](Random& random) {
    const Patch p = random.patch();
    const Mat3 r = random.rotation();
    const Vec3 t = random.vector();
    Patch moved;
    for (int i = 0; i < 3; ++i) {
      moved.x[i] = r * p.x[i] + t;
      moved.u[i] = r * p.u[i];
    }
    Measures m = triangle_measures(p.x, p.u);
    m.mu_xy = r * m.mu_xy * r.transpose();
    expect_same(triangle_measures(moved.x, moved.u), m, scales(p), 1e-13);
  });
}

TEST(TriangleMeasures, ScalingLaws) {
  for (const double s : {1e-6, 1e6}) {
    Many<100>().each([s](Random& random) {
      const Patch p = random.patch();
      Measures m = triangle_measures({s * p.x[0], s * p.x[1], s * p.x[2]}, p.u);
      m.area /= s * s;
      m.mu0 /= s * s;
      m.mu1 /= s;
      m.mu_xy /= s;
      expect_same(m, triangle_measures(p.x, p.u), scales(p), kRounding);
    });
  }
}

/// Corners on a grid of 1/1024 are exact at UTM magnitudes, so nothing at all may change.
TEST(TriangleMeasures, NothingChangesAtGeoreferencedCoordinates) {
  const Vec3 utm(500000, 5400000, 100);
  Many<100>().each([&utm](Random& random) {
    Patch p = random.patch();
    for (Vec3& x : p.x) x = (1024 * x).array().round() / 1024;
    const Measures far = triangle_measures({p.x[0] + utm, p.x[1] + utm, p.x[2] + utm}, p.u);
    expect_same(far, triangle_measures(p.x, p.u), scales(p), 0);
  });
}

/// On a unit sphere with u = x the measures are mu0 = det/2, mu1 = 2 mu0 and mu2 = mu0.
TEST(TriangleMeasures, UnitSphere) {
  Many<100>().each([](Random& random) {
    const std::array<Vec3, 3> x = {random.unit(), random.unit(), random.unit()};
    const Measures m = triangle_measures(x, x);
    const double det = x[0].dot(x[1].cross(x[2]));
    EXPECT_NEAR(m.mu0, det / 2, 1e-15);
    EXPECT_NEAR(m.mu1, det, 4e-15);
    EXPECT_NEAR(m.mu2, det / 2, 1e-15);
  });
}

TEST(TriangleMeasures, ZeroAreaMayCarryCurvature) {
  const std::array<Vec3, 3> x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
  const std::array<Vec3, 3> u = {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 0, 0)};
  const Measures m = triangle_measures(x, u);
  const oracle::Forms f = oracle::triangle_forms(x, u);
  EXPECT_EQ(m.area, 0);
  EXPECT_EQ(m.mu0, 0);
  EXPECT_NEAR(m.mu1, static_cast<double>(f.mu1), 1e-15);
  EXPECT_NEAR(m.mu2, static_cast<double>(f.mu2), 1e-15);
  EXPECT_GT(std::abs(m.mu1), 0.1);
  EXPECT_GT(std::abs(m.mu2), 0.1);
  EXPECT_NEAR((m.mu_xy - f.mu_xy.cast<double>()).norm(), 0, 1e-15);
}

TEST(TriangleDensity, IsLinearInTheNormal) {
  Many<100>().each([](Random& random) {
    const Patch p = random.patch();
    const Vec3 e1 = p.x[1] - p.x[0], e2 = p.x[2] - p.x[0], d1 = p.u[1] - p.u[0], d2 = p.u[2] - p.u[0];
    const Vec3 mean = (p.u[0] + p.u[1] + p.u[2]) / 3;
    expect_same(triangle_density(e1, e2, d1, d2, mean), triangle_measures(p.x, p.u), scales(p), kRounding);
    const Vec3 u = p.u[0] + 0.2 * d1 + 0.7 * d2;
    const Measures m = triangle_density(e1, e2, d1, d2, u);
    const oracle::Forms f = oracle::triangle_forms_at(p.x, p.u, 0.2L, 0.7L);
    EXPECT_NEAR(m.mu0, static_cast<double>(f.mu0), kRounding * scales(p).mu0);
    EXPECT_NEAR(m.mu1, static_cast<double>(f.mu1), kRounding * scales(p).mu1);
    EXPECT_NEAR(m.mu2, static_cast<double>(f.mu2), kRounding * scales(p).mu2);
    EXPECT_NEAR((m.mu_xy - f.mu_xy.cast<double>()).cwiseAbs().maxCoeff(), 0, kRounding * scales(p).mu1);
  });
}

void expect_compact(const MeasureSum& c, const Measures& m, const Scales& s) {
  EXPECT_NEAR(c.area, m.area, kRounding * s.mu0);
  EXPECT_NEAR(c.mu0, m.mu0, kRounding * s.mu0);
  EXPECT_NEAR(c.mu1(), m.mu1, kRounding * s.mu1);
  EXPECT_NEAR(c.mu2, m.mu2, kRounding * s.mu2);
  const Mat3 sym = (m.mu_xy + m.mu_xy.transpose()) / 2;
  EXPECT_NEAR((c.tensor() - sym).cwiseAbs().maxCoeff(), 0, kRounding * s.mu1);
  EXPECT_EQ(c.tensor(), c.tensor().transpose());
  EXPECT_NEAR(c.mu_sym[3], sym(0, 1), kRounding * s.mu1);
  EXPECT_NEAR(c.mu_sym[4], sym(0, 2), kRounding * s.mu1);
  EXPECT_NEAR(c.mu_sym[5], sym(1, 2), kRounding * s.mu1);
}

TEST(MeasureSum, KeepsWhatABallNeeds) {
  Many<100>().each([](Random& random) {
    const Patch p = random.patch();
    const Measures m = triangle_measures(p.x, p.u);
    expect_compact(compact(m), m, scales(p));
    const Vec3 u = p.u[0] + 0.3 * (p.u[1] - p.u[0]);
    const Vec3 e1 = p.x[1] - p.x[0], e2 = p.x[2] - p.x[0], d1 = p.u[1] - p.u[0], d2 = p.u[2] - p.u[0];
    expect_compact(triangle_density_sum(e1, e2, d1, d2, u), triangle_density(e1, e2, d1, d2, u), scales(p));
  });
}

TEST(MeasureSum, AddsAndScales) {
  Random random;
  const Patch p = random.patch(), q = random.patch();
  Measures both = triangle_measures(p.x, p.u);
  MeasureSum sum = compact(both);
  both += triangle_measures(q.x, q.u);
  sum += compact(triangle_measures(q.x, q.u));
  expect_compact(sum, both, {10, 10, 10});
  MeasureSum third = sum;
  third *= 1.0 / 3;
  EXPECT_NEAR(3 * third.area, sum.area, 1e-14);
  EXPECT_NEAR(3 * third.mu0, sum.mu0, 1e-14);
  EXPECT_NEAR(3 * third.mu2, sum.mu2, 1e-14);
  EXPECT_NEAR((3 * third.tensor() - sum.tensor()).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace kappa
