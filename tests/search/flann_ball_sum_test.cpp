// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/flann_ball_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "kappa/core/error.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/ball_sums.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;
using test::sums;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};

void expect_equal(const BallMeasures& a, const test::ScaledSum& b, const std::string& what) {
  EXPECT_EQ(a.face_count, b.ball.face_count) << what;
  EXPECT_LE(test::relative_error(a.sum, b), 1e-12) << what;
}

/// Every vertex and places between, so that balls of every size meet every part.
std::vector<Vec3> places(const Mesh& mesh, std::size_t random_places) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, 0.5);
  std::vector<Vec3> out;
  for (const Vec3& x : mesh.vertices) out.push_back(x);
  for (std::size_t i = 0; i < random_places; ++i)
    out.push_back(mesh.vertices[random() % mesh.vertices.size()] +
                  Vec3(normal(random), normal(random), normal(random)));
  return out;
}

TEST(FlannBallSum, EqualsBruteForceOnTheZoo) {
  const std::vector<double> radii = {0.05, 0.3, 1.0, 4.0, 2e4};
  for (const shapes::Specimen& specimen : shapes::zoo()) {
    const Triangles triangles = triangles_of(specimen.mesh, specimen.normals);
    const FlannBallSum flann(triangles);
    const std::vector<Vec3> centres = places(specimen.mesh, 40);
    for (const BallDefinition ball : kBalls) {
      const auto fast = sums(flann, centres, radii, ball);
      const auto slow = test::brute_force(triangles, centres, radii, ball);
      for (std::size_t i = 0; i < fast.size(); ++i)
        expect_equal(fast[i], slow[i], specimen.name + " query " + std::to_string(i));
    }
  }
}

TEST(FlannBallSum, EqualsBruteForceOnTorusAtEveryVertexAndSmallBalls) {
  const Shape torus = shapes::torus(3, 1, 40, 24);
  const Triangles triangles = triangles_of(torus.mesh, torus.normals);
  const std::vector<double> radii = {0.1, 0.45, 0.9, 2.5, 9.0};
  const FlannBallSum flann(triangles);
  for (const BallDefinition ball : kBalls) {
    const auto fast = sums(flann, torus.mesh.vertices, radii, ball);
    const auto slow = test::brute_force(triangles, torus.mesh.vertices, radii, ball);
    for (std::size_t i = 0; i < fast.size(); ++i) expect_equal(fast[i], slow[i], std::to_string(i));
  }
}

TEST(FlannBallSum, RadiiTogetherEqualRadiiAlone) {
  const Shape sphere = shapes::sphere(1, 4);
  const FlannBallSum flann(triangles_of(sphere.mesh, sphere.normals));
  const std::vector<double> radii = {0.8, 0.1, 0.3};
  const auto together = sums(flann, sphere.mesh.vertices, radii, BallDefinition::ExactDensity);
  for (std::size_t r = 0; r < radii.size(); ++r) {
    const auto alone = sums(flann, sphere.mesh.vertices, {radii[r]}, BallDefinition::ExactDensity);
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const BallMeasures &a = together[i * radii.size() + r], &b = alone[i];
      EXPECT_EQ(a.face_count, b.face_count) << radii[r];
      EXPECT_NEAR(a.sum.mu0, b.sum.mu0, 1e-12 * b.sum.area) << radii[r];
      EXPECT_NEAR((a.sum.tensor() - b.sum.tensor()).norm(), 0, 1e-12 * b.sum.area) << radii[r];
    }
  }
}

TEST(FlannBallSum, ThreadsGiveTheSameBits) {
  const Shape torus = shapes::torus(3, 1, 60, 40);
  const FlannBallSum flann(triangles_of(torus.mesh, torus.normals));
  std::vector<std::vector<BallMeasures>> results;
  for (const int threads : {1, 2, 3}) {
    Execution run;
    run.threads = threads;
    results.push_back(sums(flann, torus.mesh.vertices, {0.2, 0.7}, BallDefinition::ExactDensity, run));
  }
  for (std::size_t i = 0; i < results[0].size(); ++i) {
    for (std::size_t other = 1; other < results.size(); ++other) {
      const BallMeasures &a = results[0][i], &b = results[other][i];
      EXPECT_EQ(std::memcmp(&a.sum, &b.sum, sizeof(MeasureSum)), 0) << i;
      EXPECT_EQ(a.face_count, b.face_count);
    }
  }
}

TEST(FlannBallSum, RefusesRadiiThatAreNoBallsAndSurvivesCentresThatAreNoPoints) {
  const Shape sphere = shapes::sphere(1, 2);
  const FlannBallSum flann(triangles_of(sphere.mesh, sphere.normals));
  for (const double radius : {0.0, -1.0, kNaN, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(sums(flann, {Vec3::Zero()}, {radius}, BallDefinition::ExactDensity), Error) << radius;
  const auto nothing = sums(flann, {Vec3(kNaN, 0, 0)}, {1.0}, BallDefinition::ExactDensity);
  EXPECT_EQ(nothing[0].face_count, 0u);
}

TEST(FlannBallSum, CanBeCancelled) {
  const Shape torus = shapes::torus(3, 1, 60, 40);
  const FlannBallSum flann(triangles_of(torus.mesh, torus.normals));
  std::atomic<bool> stop{false};
  Execution run;
  run.cancel = &stop;
  std::size_t answered = 0;
  const auto sink = [&](std::size_t, const BallMeasures*) {
    if (++answered == 10) stop = true;
  };
  EXPECT_THROW(flann.sum(torus.mesh.vertices, {0.5}, BallDefinition::ExactDensity, run, sink), Cancelled);
  EXPECT_LT(answered, torus.mesh.vertices.size());
}

TEST(EstimateCurvatures, GivesOneFieldARadiusInTheOrderAsked) {
  const double radius = 2;
  const Shape sphere = shapes::sphere(radius, 4);
  CurvatureOptions options;
  options.radii = {0.5, 0.0, 0.3};
  const auto fields = estimate_curvatures(sphere.mesh, sphere.normals, options);
  ASSERT_EQ(fields.size(), 3u);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_EQ(fields[r].radius, options.radii[r]);
    for (const CurvatureSample& s : fields[r].samples) {
      EXPECT_NEAR(s.k.mean, 1 / radius, 1e-12);
      EXPECT_NEAR(s.k.gaussian, 1 / (radius * radius), 1e-12);
      EXPECT_EQ(s.k.status, PointStatus::Valid);
    }
  }
  // The bias of the principal curvatures that SPEC section 3 documents: k = (1 - rho^2 / (4 R^2)) / R.
  const double expected = (1 - 0.25 / (4 * radius * radius)) / radius;
  for (const CurvatureSample& s : fields[0].samples) EXPECT_NEAR(s.k.k_min, expected, 1e-3);
}

TEST(EstimateCurvatures, RefusesBadOptions) {
  const Shape sphere = shapes::sphere(1, 1);
  CurvatureOptions options;
  options.radii = {};
  EXPECT_THROW(estimate_curvatures(sphere.mesh, sphere.normals, options), Error);
  options.radii = {-0.1};
  EXPECT_THROW(estimate_curvatures(sphere.mesh, sphere.normals, options), Error);
  options.radii = {0.1};
  EXPECT_THROW(estimate_curvatures(sphere.mesh, Normals(3), options), Error);
}

}  // namespace
}  // namespace kappa
