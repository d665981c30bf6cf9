// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/orders.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/error.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

CurvatureRatios ratios(double mean, double gaussian, std::array<double, 3> form) {
  return {mean, gaussian, form, PointStatus::Valid};
}

/// Ratios with a bias in rho^2 and rho^4 of its own for each.
CurvatureRatios biased(double radius) {
  const auto q = [&](double c) { return c + 3 * c * c * radius * radius - (c + 1) * std::pow(radius, 4); };
  return ratios(q(0.7), q(-0.2), {q(1.5), q(0.1), q(-2)});
}

std::vector<CurvatureRatios> biased_balls(double radius, int order) {
  std::vector<CurvatureRatios> balls;
  for (const double r : order_radii(radius, order)) balls.push_back(biased(r));
  return balls;
}

TEST(Extrapolate, OrderThreeCancelsBothPowers) {
  const OrderedRatios e = extrapolate(biased_balls(0.8, 3).data(), 3);
  EXPECT_NEAR(e.ratios.mean, 0.7, 1e-13);
  EXPECT_NEAR(e.ratios.gaussian, -0.2, 1e-13);
  EXPECT_NEAR(e.ratios.form[0], 1.5, 1e-13);
  EXPECT_NEAR(e.ratios.form[1], 0.1, 1e-13);
  EXPECT_NEAR(e.ratios.form[2], -2, 1e-13);
}

TEST(Extrapolate, OrderTwoLeavesTheFourthPower) {
  const OrderedRatios e = extrapolate(biased_balls(0.8, 2).data(), 2);
  const double left = std::pow(0.8, 4) / 2;  // 2 (1/4) - 1 of -(c + 1) rho^4, turned round
  EXPECT_NEAR(e.ratios.mean, 0.7 + 1.7 * left, 1e-13);
  EXPECT_NEAR(e.ratios.form[0], 1.5 + 2.5 * left, 1e-13);
}

TEST(Extrapolate, OrderOneIsTheBall) {
  const CurvatureRatios ball = biased(0.8);
  const OrderedRatios e = extrapolate(&ball, 1);
  EXPECT_EQ(e.ratios.mean, ball.mean);
  EXPECT_EQ(e.ratios.form, ball.form);
  EXPECT_TRUE(std::isnan(e.std_error));
}

TEST(Extrapolate, SpreadIsThatOfThePrincipalCurvatures) {
  // Order 2 minus order 1 is 2 (Q(rho / sqrt 2) - Q(rho)); here 0.2 in both principal curvatures.
  const std::vector<CurvatureRatios> balls = {ratios(1, 1, {1, 0, 2}), ratios(1, 1, {1.1, 0, 2.1})};
  EXPECT_NEAR(extrapolate(balls.data(), 2).std_error, 0.2, 1e-13);
  const std::vector<CurvatureRatios> turned = {ratios(1, 1, {1, 0, 1}), ratios(1, 1, {1, 0.1, 1})};
  EXPECT_NEAR(extrapolate(turned.data(), 2).std_error, 0.2, 1e-13) << "k_min - 0.2, k_max + 0.2";
}

TEST(Extrapolate, AnyBallWithoutAnswerGivesItsStatus) {
  for (const PointStatus status : {PointStatus::Empty, PointStatus::Degenerate, PointStatus::Invalid}) {
    for (std::size_t broken = 0; broken < 3; ++broken) {
      std::vector<CurvatureRatios> balls = biased_balls(0.8, 3);
      balls[broken] = {};
      balls[broken].status = status;
      const OrderedRatios e = extrapolate(balls.data(), 3);
      EXPECT_EQ(e.ratios.status, status);
      EXPECT_TRUE(std::isnan(e.ratios.mean) && std::isnan(e.ratios.form[0]) && std::isnan(e.std_error));
      EXPECT_TRUE(std::isnan(curvatures(e.ratios, Vec3::UnitZ()).k_max));
    }
  }
}

TEST(OrderRadii, Refuses) {
  EXPECT_EQ(order_radii(2, 1), std::vector<double>({2}));
  EXPECT_EQ(order_radii(2, 3).size(), 3U);
  EXPECT_DOUBLE_EQ(order_radii(2, 3)[1], std::sqrt(2.0));
  EXPECT_EQ(order_radii(2, 3)[2], 1);
  for (const int order : {-1, 0, 4}) EXPECT_THROW(order_radii(1, order), Error);
}

/// Root mean square errors over the vertices of one slice of a torus; the others are turned copies of it.
struct Errors {
  double mean = 0, gaussian = 0, k_min = 0, k_max = 0;
};

Errors slice_errors(const Shape& s, std::size_t rings, double radius, int order) {
  const auto first = [&](const auto& all) { return std::vector<Vec3>(all.begin(), all.begin() + rings); };
  const MeasureTree balls(triangles_of(s.mesh, s.normals));
  const auto f = curvatures_in_balls(balls, first(s.mesh.vertices), first(s.normals), {{radius}, order});
  Errors e;
  for (std::size_t i = 0; i < rings; ++i) {
    const Curvatures& k = f[0].samples[i].k;
    e.mean += std::pow(k.mean - s.mean[i], 2);
    e.gaussian += std::pow(k.gaussian - s.gaussian[i], 2);
    e.k_min += std::pow(k.k_min - s.k_min[i], 2);
    e.k_max += std::pow(k.k_max - s.k_max[i], 2);
  }
  for (double* sum : {&e.mean, &e.gaussian, &e.k_min, &e.k_max}) *sum = std::sqrt(*sum / static_cast<double>(rings));
  return e;
}

/// The errors of a trial with area-fraction balls on the same mesh, given to two digits.
TEST(Orders, TorusReachesTheTrial) {
  const Shape s = shapes::torus(3, 1, 100, 100);
  const auto expect = [&](double radius, int order, const Errors& most) {
    const Errors e = slice_errors(s, 100, radius, order);
    EXPECT_LE(e.mean, most.mean) << radius << ' ' << order;
    EXPECT_LE(e.gaussian, most.gaussian) << radius << ' ' << order;
    EXPECT_LE(e.k_min, most.k_min) << radius << ' ' << order;
    EXPECT_LE(e.k_max, most.k_max) << radius << ' ' << order;
  };
  expect(0.5, 1, {5.25e-3, 1.15e-2, 1.55e-2, 6.55e-2});
  expect(0.5, 2, {1.35e-4, 2.65e-4, 3.6e-4, 1.3e-3});
  expect(0.5, 3, {1.35e-4, 2.75e-4, 3.55e-4, 3.5e-4});
  expect(1.0, 2, {5.75e-4, 1.15e-3, 1.15e-3, 1.45e-2});
  expect(1.0, 3, {1.35e-4, 2.75e-4, 3.35e-4, 2.75e-4});
}

/// On a mesh so fine that its own error is small the error falls with rho^2 and rho^4.
TEST(Orders, ErrorFallsWithThePowersOfTheRadius) {
  const Shape s = shapes::torus(3, 1, 400, 200);
  for (const int order : {1, 2}) {
    const Errors wide = slice_errors(s, 200, 1.2, order), narrow = slice_errors(s, 200, 0.85, order);
    const double power = std::log(wide.k_max / narrow.k_max) / std::log(1.2 / 0.85);
    EXPECT_NEAR(power, 2 * order, 0.35);
  }
}

/// Passes on to another engine and counts.
class CountingBallSum final : public BallSum {
 public:
  explicit CountingBallSum(const BallSum& from) : from_(from) {}
  const Triangles& triangles() const override { return from_.triangles(); }
  MeasureSum measures_of(std::size_t triangle) const override { return from_.measures_of(triangle); }
  mutable std::vector<std::size_t> asked;  ///< numbers of radii

 private:
  void do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
              const Sink& sink) const override {
    EXPECT_TRUE(radii.are_common());
    asked.push_back(radii.count());
    from_.sum(centres, radii, ball, run, sink);
  }
  const BallSum& from_;
};

TEST(Orders, OneWalkServesAllRadiiAndEachBallOnce) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  const MeasureTree tree(triangles_of(s.mesh, s.normals));
  const CountingBallSum balls(tree);
  CurvatureOptions options;
  options.radii = {1, 0.5};
  options.order = 3;
  const auto f = estimate_curvatures(balls, s.normals, options);
  ASSERT_EQ(balls.asked.size(), 1U);
  EXPECT_EQ(balls.asked[0], 5U) << "1, 0.71, 0.5 and 0.5, 0.35, 0.25 share one";
  ASSERT_EQ(f.size(), 2U);
  for (std::size_t r = 0; r < 2; ++r) {
    options.radii = {r == 0 ? 1.0 : 0.5};
    const auto alone = estimate_curvatures(tree, s.normals, options);
    for (std::size_t i = 0; i < f[r].samples.size(); ++i)
      EXPECT_NEAR(f[r].samples[i].k.k_max, alone[0].samples[i].k.k_max, 1e-12);
  }
}

/// The combination by hand, from the fields of single balls: scalars directly, the tensor from its eigenpairs.
TEST(Orders, CombineTheBallsOfTheirRadii) {
  const Shape s = shapes::torus(3, 1, 40, 24);
  const MeasureTree balls(triangles_of(s.mesh, s.normals));
  CurvatureOptions options;
  options.radii = {0.9};
  options.order = 2;
  const CurvatureField f = estimate_curvatures(balls, s.normals, options)[0];
  const auto of = curvatures_in_balls(balls, s.mesh.vertices, s.normals, {{0.9, 0.9 / std::sqrt(2.0)}});
  const auto tensor = [](const Curvatures& k) -> Mat3 {
    return k.k_min * k.dir_min * k.dir_min.transpose() + k.k_max * k.dir_max * k.dir_max.transpose();
  };
  for (std::size_t i = 0; i < f.samples.size(); i += 7) {
    const CurvatureSample& got = f.samples[i];
    const Curvatures &wide = of[0].samples[i].k, &narrow = of[1].samples[i].k;
    EXPECT_NEAR(got.k.mean, 2 * narrow.mean - wide.mean, 1e-12);
    EXPECT_NEAR(got.k.gaussian, 2 * narrow.gaussian - wide.gaussian, 1e-12);
    const Mat3 form = 2 * tensor(narrow) - tensor(wide);
    EXPECT_NEAR((form - tensor(got.k)).norm(), 0, 1e-12);
    EXPECT_NEAR(got.std_error, (form - tensor(wide)).norm() / std::sqrt(2.0), 1e-12);
    EXPECT_EQ(got.mu0, of[0].samples[i].mu0) << "measures are those of the ball of the radius";
    EXPECT_EQ(got.radius, 0.9);
    EXPECT_EQ(got.order, 2);
  }
}

TEST(Orders, EmptyInnerBallHasNoAnswer) {
  const Shape s = shapes::square(5);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const int order : {1, 2, 3}) {
    const auto at = [&](double z) {
      return curvatures_in_balls(balls, {Vec3(0.5, 0.5, z)}, {Vec3::UnitZ()}, {{0.5}, order})[0].samples[0];
    };
    EXPECT_EQ(at(0.45).k.status, order == 1 ? PointStatus::Valid : PointStatus::Empty);
    EXPECT_EQ(std::isnan(at(0.45).k.mean), order > 1);
    EXPECT_EQ(at(0.3).k.status, order == 3 ? PointStatus::Empty : PointStatus::Valid);
    EXPECT_EQ(at(0.1).k.status, PointStatus::Valid);
  }
}

TEST(Orders, ScaleChangesNoRelativeError) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  for (const int order : {1, 2, 3}) {
    CurvatureOptions options;
    options.order = order;
    options.radii = {1};
    const auto expected = estimate_curvatures(s.mesh, s.normals, options);
    for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
      Mesh scaled = s.mesh;
      for (Vec3& x : scaled.vertices) x *= unit;
      options.radii = {unit};
      const auto got = estimate_curvatures(scaled, s.normals, options);
      for (std::size_t i = 0; i < s.normals.size(); ++i) {
        const CurvatureSample &a = expected[0].samples[i], &b = got[0].samples[i];
        const auto error = [&](double value, double truth) { return (value - truth) / std::abs(s.k_max[i]); };
        EXPECT_NEAR(error(a.k.mean, s.mean[i]), error(b.k.mean * unit, s.mean[i]), 1e-9);
        EXPECT_NEAR(error(a.k.k_min, s.k_min[i]), error(b.k.k_min * unit, s.k_min[i]), 1e-9);
        EXPECT_NEAR(error(a.k.k_max, s.k_max[i]), error(b.k.k_max * unit, s.k_max[i]), 1e-9);
        EXPECT_NEAR(error(a.k.gaussian, s.gaussian[i]), error(b.k.gaussian * unit * unit, s.gaussian[i]), 1e-9);
        if (order > 1) {
          EXPECT_NEAR(a.std_error, b.std_error * unit, 1e-9);
        }
      }
    }
  }
}

TEST(Orders, RefusesRadiusZeroAndOtherOrders) {
  CurvatureOptions options;
  options.radii = {0, 1};
  EXPECT_NO_THROW(validate(options));
  options.order = 2;
  EXPECT_THROW(validate(options), Error);
  options.radii = {1};
  EXPECT_NO_THROW(validate(options));
  const Shape s = shapes::sphere(1, 1);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const int order : {0, 4}) {
    options.order = order;
    EXPECT_THROW(validate(options), Error);
    EXPECT_THROW(estimate_curvatures(balls, s.normals, options), Error);
    EXPECT_THROW(curvatures_in_balls(balls, s.mesh.vertices, s.normals, {{1}, order}), Error);
  }
  options.order = 1;
  EXPECT_THROW(estimate_curvatures(balls, Normals(3, Vec3::UnitX()), options), Error);
}

}  // namespace
}  // namespace kappa
