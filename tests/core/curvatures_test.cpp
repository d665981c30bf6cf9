// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/curvatures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace kappa {
namespace {

/// A surface element of area mu0 with principal curvatures k1 along a, k2 along b and normal u = a x b. SPEC section 3:
/// the tensor is minus the second form, integrated. Entries along u are noise that the restriction must ignore.
Measures element(const Mat3& frame, double mu0, double k1, double k2) {
  Measures m;
  m.area = std::abs(mu0);
  m.mu0 = mu0;
  m.mu1 = (k1 + k2) * mu0;
  m.mu2 = k1 * k2 * mu0;
  m.mu_xy = -mu0 * (k1 * frame.col(0) * frame.col(0).transpose() + k2 * frame.col(1) * frame.col(1).transpose());
  return m;
}

Mat3 frame(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Vec3 axis(normal(random), normal(random), normal(random));
  return Eigen::AngleAxisd(5 * normal(random), axis.normalized()).toRotationMatrix();
}

void expect_along(const Vec3& direction, const Vec3& expected) {
  EXPECT_NEAR(direction.norm(), 1, 1e-14);
  EXPECT_NEAR(std::abs(direction.dot(expected)), 1, 1e-12);
}

TEST(Curvatures, OfAKnownTensor) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Mat3 f = frame(seed);
    const Curvatures k = curvatures(element(f, 0.7, 3, -2), f.col(2));
    ASSERT_EQ(k.status, PointStatus::Valid);
    EXPECT_NEAR(k.mean, 0.5, 1e-14);
    EXPECT_NEAR(k.gaussian, -6, 1e-13);
    EXPECT_NEAR(k.k_min, -2, 1e-13);
    EXPECT_NEAR(k.k_max, 3, 1e-13);
    expect_along(k.dir_min, f.col(1));
    expect_along(k.dir_max, f.col(0));
    EXPECT_NEAR(k.dir_min.dot(f.col(2)), 0, 1e-14);
    EXPECT_NEAR(k.dir_max.dot(f.col(2)), 0, 1e-14);
    EXPECT_NEAR(k.dir_max.dot(k.dir_min), 0, 1e-14);
  }
}

TEST(Curvatures, SortedAfterDividing) {
  // On reversed faces mu0 is negative and so is the tensor: the curvatures are the same.
  const Mat3 f = frame(3);
  const Curvatures k = curvatures(element(f, -0.7, 3, -2), f.col(2));
  ASSERT_EQ(k.status, PointStatus::Valid);
  EXPECT_NEAR(k.k_min, -2, 1e-13);
  EXPECT_NEAR(k.k_max, 3, 1e-13);
  expect_along(k.dir_max, f.col(0));
  // mu0 alone negative: everything changes sign, and the order with it.
  Measures m = element(f, 0.7, 3, -2);
  m.mu0 = -0.7;
  const Curvatures n = curvatures(m, f.col(2));
  EXPECT_NEAR(n.k_min, -3, 1e-13);
  EXPECT_NEAR(n.k_max, 2, 1e-13);
  expect_along(n.dir_min, f.col(0));
  EXPECT_NEAR(n.mean, -0.5, 1e-14);
}

TEST(Curvatures, OnlyTheTangentBlockAndTheSymmetricPartCount) {
  const Mat3 f = frame(4);
  Measures m = element(f, 2, 5, 1);
  const Vec3 u = f.col(2), a = f.col(0), b = f.col(1);
  m.mu_xy += 7 * u * u.transpose() + 3 * u * a.transpose() - 4 * a * u.transpose();
  m.mu_xy += 2 * (a * b.transpose() - b * a.transpose());
  m.mu1 = -m.mu_xy.trace();
  const Curvatures k = curvatures(m, u);
  EXPECT_NEAR(k.k_min, 1, 1e-13);
  EXPECT_NEAR(k.k_max, 5, 1e-13);
  EXPECT_NEAR(k.mean, (2 * (5 + 1) - 7) / (2.0 * 2), 1e-13) << "mean comes from mu1, not from the tangent block";
}

TEST(Curvatures, CompactFormGivesTheSame) {
  const Mat3 f = frame(5);
  const Measures m = element(f, 0.3, 4, -1);
  const Curvatures a = curvatures(m, f.col(2)), b = curvatures(compact(m), f.col(2));
  EXPECT_NEAR(a.mean, b.mean, 1e-13);
  EXPECT_NEAR(a.gaussian, b.gaussian, 1e-13);
  EXPECT_NEAR(a.k_min, b.k_min, 1e-13);
  EXPECT_NEAR(a.k_max, b.k_max, 1e-13);
  EXPECT_EQ(b.status, PointStatus::Valid);
}

TEST(Curvatures, LengthAndSignOfTheNormalDoNotMatter) {
  const Mat3 f = frame(6);
  const Measures m = element(f, 0.3, 4, -1);
  for (const double length : {1e-9, -1.0, 1e9}) {
    const Curvatures k = curvatures(m, length * f.col(2));
    ASSERT_EQ(k.status, PointStatus::Valid) << length;
    EXPECT_NEAR(k.k_min, -1, 1e-13);
    EXPECT_NEAR(k.k_max, 4, 1e-13);
  }
}

TEST(Curvatures, SameRelativeErrorInAnyUnit) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mat3 f = frame(seed);
    for (const double s : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
      const Curvatures k = curvatures(element(f, 0.7 * s * s, 3 / s, -0.01 / s), f.col(2));
      ASSERT_EQ(k.status, PointStatus::Valid);
      EXPECT_NEAR(s * k.k_max, 3, 1e-13) << s;
      EXPECT_NEAR(s * k.k_min, -0.01, 1e-13) << s;
      EXPECT_NEAR(s * s * k.gaussian, -0.03, 1e-14) << s;
    }
  }
}

TEST(Curvatures, UmbilicHasTwoOrthogonalTangents) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mat3 f = frame(seed);
    for (const double k0 : {0.0, 2.0}) {
      const Curvatures k = curvatures(element(f, 1, k0, k0), f.col(2));
      ASSERT_EQ(k.status, PointStatus::Valid);
      EXPECT_NEAR(k.k_min, k0, 1e-14);
      EXPECT_NEAR(k.k_max, k0, 1e-14);
      EXPECT_LE(k.k_min, k.k_max);
      EXPECT_NEAR(k.dir_min.norm(), 1, 1e-14);
      EXPECT_NEAR(k.dir_max.norm(), 1, 1e-14);
      EXPECT_NEAR(k.dir_min.dot(k.dir_max), 0, 1e-14);
      EXPECT_NEAR(k.dir_min.dot(f.col(2)), 0, 1e-14);
    }
  }
}

void expect_all_nan(const Curvatures& k, PointStatus status) {
  EXPECT_EQ(k.status, status);
  for (const double v : {k.mean, k.gaussian, k.k_min, k.k_max, k.dir_min.x(), k.dir_min.y(), k.dir_min.z(),
                         k.dir_max.x(), k.dir_max.y(), k.dir_max.z()}) {
    EXPECT_TRUE(std::isnan(v));
  }
}

TEST(Curvatures, NoAnswerIsNaN) {
  const Mat3 f = frame(7);
  const Measures good = element(f, 1, 2, 1);
  expect_all_nan(curvatures(good, Vec3::Zero()), PointStatus::Invalid);
  expect_all_nan(curvatures(good, Vec3(kNaN, 0, 1)), PointStatus::Invalid);
  expect_all_nan(curvatures(good, Vec3(HUGE_VAL, 0, 1)), PointStatus::Invalid);
  Measures bad = good;
  bad.mu0 = kNaN;
  expect_all_nan(curvatures(bad, f.col(2)), PointStatus::Invalid);
  bad = good;
  bad.mu_xy(1, 2) = HUGE_VAL;
  expect_all_nan(curvatures(bad, f.col(2)), PointStatus::Invalid);
  Measures flat = good;
  flat.mu0 = 0.99e-12 * flat.area;
  expect_all_nan(curvatures(flat, f.col(2)), PointStatus::Degenerate);
  flat.mu0 = -flat.mu0;
  expect_all_nan(curvatures(flat, f.col(2)), PointStatus::Degenerate);
  expect_all_nan(curvatures(Measures{}, f.col(2)), PointStatus::Degenerate);
  expect_all_nan(curvatures(MeasureSum{}, f.col(2)), PointStatus::Degenerate);
  expect_all_nan(Curvatures{}, PointStatus::Invalid);
  for (const double area : {kNaN, HUGE_VAL}) {
    Measures unmeasured = good;
    unmeasured.area = area;
    expect_all_nan(curvatures(unmeasured, f.col(2)), PointStatus::Invalid);
  }
  flat.mu0 = 1.01e-12 * flat.area;
  EXPECT_EQ(curvatures(flat, f.col(2)).status, PointStatus::Valid);
}

TEST(TangentBasis, IsOrthonormalAndRightHanded) {
  std::vector<Vec3> all = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitY(), -Vec3::UnitZ()};
  for (std::uint64_t seed = 0; seed < 200; ++seed) all.push_back(frame(seed).col(2));
  for (const double tiny : {1e-300, 1e-17, 1e-9}) {
    all.push_back(Vec3(tiny, -tiny, -1).normalized());
    all.push_back(Vec3(-1, tiny, tiny).normalized());
  }
  for (const Vec3& u : all) {
    Vec3 t1, t2;
    tangent_basis(u, t1, t2);
    Mat3 q;
    q << t1, t2, u;
    EXPECT_NEAR((q.transpose() * q - Mat3::Identity()).norm(), 0, 1e-14) << u.transpose();
    EXPECT_NEAR(q.determinant(), 1, 1e-14) << u.transpose();
  }
}

}  // namespace
}  // namespace kappa
