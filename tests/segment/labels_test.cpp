// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/segment/labels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kappa/core/error.hpp"
#include "kappa/curvature/in_balls.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

struct Estimate {
  CurvatureField field;
  double threshold;
  std::vector<Label> labels;
};

Estimate estimate(const Mesh& mesh, const Normals& u, double radius) {
  const BruteForceBallSum balls(triangles_of(mesh, u));
  Estimate e;
  e.field = curvatures_in_balls(balls, mesh.vertices, u, {{radius}}).front();
  e.threshold =
      estimate_threshold(balls, mesh.vertices, u, e.field, BallDefinition::ExactDensity, median_edge_length(mesh));
  e.labels = classify(e.field, e.threshold);
  return e;
}

double share(const std::vector<Label>& labels, Label label) {
  return static_cast<double>(std::count(labels.begin(), labels.end(), label)) / static_cast<double>(labels.size());
}

TEST(Threshold, LeavesTheOuterHalfOfACleanTorusConvex) {
  const shapes::Shape torus = shapes::torus(3, 1, 60, 40);
  const Estimate e = estimate(torus.mesh, torus.normals, 0.4);
  EXPECT_GT(e.threshold, 0);
  std::size_t outer = 0, convex = 0, inner = 0, saddle = 0;
  for (std::size_t i = 0; i < e.labels.size(); ++i) {
    outer += torus.k_min[i] > 0.05;
    inner += torus.k_min[i] < -0.05;
    convex += torus.k_min[i] > 0.05 && e.labels[i] == Label::Convex;
    saddle += torus.k_min[i] < -0.05 && e.labels[i] == Label::Saddle;
  }
  ASSERT_GT(outer, 1000u);
  EXPECT_EQ(convex, outer);
  EXPECT_EQ(saddle, inner);
}

TEST(Threshold, IsThatOfRoundingOnAPlane) {
  const shapes::Shape square = shapes::square(20);
  const Estimate e = estimate(square.mesh, square.normals, 0.2);
  EXPECT_NEAR(e.threshold, 1e-6 / 0.2, 1e-12);
  EXPECT_EQ(share(e.labels, Label::Flat), 1.0);
}

TEST(Threshold, CoversTheNoiseOfARoughPlane) {
  shapes::Shape square = shapes::square(40);
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0, 0.002);
  for (Vec3& v : square.mesh.vertices) v.z() += noise(random);
  const Normals u = average_normals(square.mesh, vertex_normals(square.mesh, NormalWeights::Uniform), 4);
  const Estimate e = estimate(square.mesh, u, 0.12);
  EXPECT_GT(share(e.labels, Label::Flat), 0.7);
  EXPECT_LT(e.threshold, 5.0);
}

TEST(Threshold, ScalesWithTheUnits) {
  shapes::Shape torus = shapes::torus(3, 1, 30, 20);
  const double threshold = estimate(torus.mesh, torus.normals, 0.6).threshold;
  for (Vec3& v : torus.mesh.vertices) v *= 1e6;
  EXPECT_NEAR(estimate(torus.mesh, torus.normals, 0.6e6).threshold * 1e6, threshold, 1e-9 * threshold);
}

TEST(Threshold, WorksAtRadiusZero) {
  const shapes::Shape torus = shapes::torus(3, 1, 40, 30);
  const BruteForceBallSum balls(triangles_of(torus.mesh, torus.normals));
  const CurvatureField field = curvatures_at_vertices(balls, torus.normals, VertexLimit::Star);
  const double threshold = estimate_threshold(balls, torus.mesh.vertices, torus.normals, field,
                                              BallDefinition::ExactDensity, median_edge_length(torus.mesh));
  EXPECT_GT(threshold, 0);
  const std::vector<Label> labels = classify(field, threshold);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (torus.k_min[i] > 0.1) {
      EXPECT_EQ(labels[i], Label::Convex) << i;
    } else if (torus.k_min[i] < -0.1) {
      EXPECT_EQ(labels[i], Label::Saddle) << i;
    }
  }
}

TEST(Threshold, IsNaNWithoutAValidPointAndRefusesNonsense) {
  CurvatureField nothing;
  nothing.samples.resize(3);
  EXPECT_TRUE(std::isnan(curvature_threshold(nothing, nothing, 1.0)));
  EXPECT_TRUE(std::isnan(curvature_percentile(nothing, 98)));
  CurvatureField other;
  EXPECT_THROW(curvature_threshold(nothing, other, 1.0), Error);
  EXPECT_THROW(curvature_threshold(nothing, nothing, 0.0), Error);
  EXPECT_THROW(classify(nothing, -1.0), Error);
}

TEST(Percentile, IsThatOfTheLargerPrincipalCurvature) {
  CurvatureField field;
  for (int i = 0; i <= 100; ++i) {
    CurvatureSample s;
    s.k.status = PointStatus::Valid;
    s.k.k_min = i % 2 ? -i : 0.1;
    s.k.k_max = i % 2 ? 0.1 : i;
    field.samples.push_back(s);
  }
  EXPECT_EQ(curvature_percentile(field, 98), 98);
  EXPECT_EQ(curvature_percentile(field, 100), 100);
}

}  // namespace
}  // namespace kappa
