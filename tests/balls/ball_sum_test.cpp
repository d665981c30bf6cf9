// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/ball_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kappa/core/error.hpp"
#include "kappa/core/spatial_order.hpp"
#include "support/ball_sums.hpp"
#include "support/oracles.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;
using shapes::Specimen;
using test::sums;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};

/// Vertices and random places near the mesh.
std::vector<Vec3> places(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 0.3);
  std::vector<Vec3> out;
  while (out.size() < count) {
    const Vec3& x = mesh.vertices[random() % mesh.vertices.size()];
    if (!x.allFinite() || x.norm() > 100) continue;
    out.push_back(out.size() % 2 ? x : Vec3(x + Vec3(normal(random), normal(random), normal(random))));
  }
  return out;
}

void expect_oracle(const Mesh& mesh, const Normals& normals, const std::string& name) {
  const std::vector<double> radii = {0.053, 0.41, 1.13, 30};  // no multiple of a spacing: contact would be a tie
  const std::vector<Vec3> centres = places(mesh, 12, 5);
  const BruteForceBallSum balls(triangles_of(mesh, normals));
  for (const BallDefinition ball : kBalls) {
    const std::vector<BallMeasures> got = sums(balls, centres, radii, ball);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const Vec3& centre = centres[i / radii.size()];
      const double radius = radii[i % radii.size()];
      const oracle::BallForms expected = oracle::ball_forms(mesh, normals, centre, radius, ball);
      EXPECT_LE(oracle::relative_error(got[i].sum, expected), 1e-12)
          << name << " centre " << centre.transpose() << " radius " << radius << " definition "
          << static_cast<int>(ball);
      EXPECT_EQ(got[i].face_count, expected.face_count) << name << " centre " << centre.transpose() << ' ' << radius;
    }
  }
}

TEST(BruteForceBallSum, EqualsTheOracleOnShapes) {
  const Shape torus = shapes::torus(3, 1, 24, 16), sphere = shapes::sphere(1, 2), soup = shapes::sphere_soup(1, 100, 3);
  expect_oracle(torus.mesh, torus.normals, "torus");
  expect_oracle(sphere.mesh, sphere.normals, "sphere");
  expect_oracle(soup.mesh, soup.normals, "soup");
  const Shape lantern = shapes::cylinder(1, 1, 8, 30, 0.5);
  expect_oracle(lantern.mesh, lantern.normals, "lantern");
}

TEST(BruteForceBallSum, EqualsTheOracleOnTheZoo) {
  for (const Specimen& s : shapes::zoo()) expect_oracle(s.mesh, s.normals, s.name);
}

/// Largest difference of two sums in units of the sums of absolute values.
double difference(const MeasureSum& a, const MeasureSum& b, const oracle::BallForms& scale) {
  oracle::BallForms expected = scale;
  expected.sum.mu0 = b.mu0;
  expected.sum.mu1 = b.mu1();
  expected.sum.mu2 = b.mu2;
  expected.sum.mu_xy = b.tensor().cast<long double>();
  expected.area = b.area;
  return oracle::relative_error(a, expected);
}

/// A ball, for the oracle.
struct Ball {
  Vec3 centre;
  double radius;
  BallDefinition definition;
};

/// Part of the area in a ball that moving its sphere by the rounding of the midpoints adds or takes: 16 units of
/// roundoff of the farthest coordinate. It exceeds 1e-12 only where the ball all but misses the surface.
double uncertainty(const Shape& s, const Ball& b, double area) {
  double farthest = b.radius;
  for (const Vec3& x : s.mesh.vertices) farthest = std::max(farthest, x.norm());
  const double shift = 16 * 0x1p-53 * farthest, step = 8 * shift;  // wide enough for the difference to be seen
  const auto area_at = [&](double radius) {
    return oracle::ball_forms(s.mesh, s.normals, b.centre, radius, b.definition).area;
  };
  return static_cast<double>((area_at(b.radius + step) - area_at(b.radius - step)) / area) * shift / (2 * step);
}

void expect_unchanged_by_subdivision(const Shape& s, const std::vector<double>& radii) {
  const Shape fine = shapes::subdivided(s);
  const BruteForceBallSum coarse_balls(triangles_of(s.mesh, s.normals));
  const BruteForceBallSum fine_balls(triangles_of(fine.mesh, fine.normals));
  const std::vector<Vec3> centres = places(s.mesh, 100, 6);
  double fraction_change = 0;
  std::size_t uncertain = 0;
  for (const BallDefinition definition : kBalls) {
    const auto coarse = sums(coarse_balls, centres, radii, definition),
               split = sums(fine_balls, centres, radii, definition);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const Ball ball{centres[i / radii.size()], radii[i % radii.size()], definition};
      const oracle::BallForms scale = oracle::ball_forms(s.mesh, s.normals, ball.centre, ball.radius, definition);
      const double change = difference(split[i].sum, coarse[i].sum, scale);
      if (definition == BallDefinition::AreaFraction) {
        fraction_change = std::max(fraction_change, change);
      } else if (change > 1e-12) {
        ++uncertain;
        EXPECT_LE(change, 1e-12 + uncertainty(s, ball, static_cast<double>(scale.area)))
            << ball.centre.transpose() << ' ' << ball.radius;
      }
    }
  }
  EXPECT_LE(uncertain, 1U) << "of " << centres.size() * radii.size() << " balls";
  EXPECT_GT(fraction_change, 1e-6) << "the area fraction does depend on the faces: this test could not fail";
}

TEST(ExactDensity, SubdivisionChangesNothing) {
  expect_unchanged_by_subdivision(shapes::torus(3, 1, 24, 12), {0.1, 0.5, 1.3});
  const Shape fan = [] {
    Shape s;
    s.mesh = shapes::fan(9, 2);
    for (const Vec3& x : s.mesh.vertices) s.normals.push_back((x + Vec3(0, 0, 1)).normalized());
    return s;
  }();
  expect_unchanged_by_subdivision(fan, {0.05, 0.3, 0.8});
  expect_unchanged_by_subdivision(shapes::cylinder(1, 0.5, 9, 3, 0.5), {0.1, 0.4, 0.9});
}

TEST(BallSum, WholeMeshInOneBall) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  const Triangles t = triangles_of(s.mesh, s.normals);
  MeasureSum all;
  for (const MeasureSum& m : measure_triangles(t)) all += m;
  const BruteForceBallSum balls(t);
  for (const BallDefinition ball : kBalls) {
    const BallMeasures got = sums(balls, {Vec3(0.2, 0, 0)}, {50}, ball)[0];
    EXPECT_EQ(got.face_count, t.size());
    EXPECT_NEAR(got.sum.mu0, all.mu0, 1e-12 * all.area);
    EXPECT_NEAR(got.sum.area, all.area, 1e-12 * all.area);
  }
}

TEST(BallSum, MissedBallsAreExactlyEmpty) {
  const Specimen giant = shapes::zoo()[5];
  ASSERT_EQ(giant.name, "giant triangle");
  const BruteForceBallSum balls(triangles_of(giant.mesh, giant.normals));
  for (const BallDefinition ball : kBalls) {
    for (const BallMeasures& b : sums(balls, {Vec3(0.5, 0.5, 3), Vec3(kNaN, 0, 0)}, {0.1, 2.9}, ball)) {
      EXPECT_EQ(b.face_count, 0U);
      EXPECT_EQ(b.sum.area, 0.0);
      EXPECT_EQ(b.sum.mu0, 0.0);
      EXPECT_EQ(b.sum.mu2, 0.0);
      EXPECT_EQ(b.sum.mu1(), 0.0);
    }
  }
}

TEST(BallSum, WeightsScaleAndSplitFaces) {
  const Shape s = shapes::torus(3, 1, 12, 8);
  Mesh tripled = s.mesh;
  tripled.weights.assign(tripled.faces.size(), 1.0 / 3);
  for (int copy = 0; copy < 2; ++copy) {
    for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
      tripled.faces.add(s.mesh.faces[f].first, 3);
      tripled.weights.push_back(1.0 / 3);
    }
  }
  const BruteForceBallSum one(triangles_of(s.mesh, s.normals)), three(triangles_of(tripled, s.normals));
  for (const BallDefinition ball : kBalls) {
    const BallMeasures a = sums(one, {s.mesh.vertices[5]}, {0.9}, ball)[0];
    const BallMeasures b = sums(three, {s.mesh.vertices[5]}, {0.9}, ball)[0];
    EXPECT_EQ(b.face_count, 3 * a.face_count);
    EXPECT_NEAR(a.sum.mu0, b.sum.mu0, 1e-13 * a.sum.area);
    EXPECT_NEAR((a.sum.tensor() - b.sum.tensor()).norm(), 0, 1e-13 * a.sum.area);
  }
}

TEST(BallSum, SameBitsForAnyThreads) {
  const Shape s = shapes::torus(3, 1, 30, 20);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const auto expected = sums(balls, s.mesh.vertices, {0.3, 0.7}, BallDefinition::ExactDensity);
  for (const int threads : {2, 3, 7}) {
    Execution run;
    run.threads = threads;
    const auto got = sums(balls, s.mesh.vertices, {0.3, 0.7}, BallDefinition::ExactDensity, run);
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_EQ(got[i].sum.mu0, expected[i].sum.mu0);
      ASSERT_EQ(got[i].sum.mu2, expected[i].sum.mu2);
      ASSERT_EQ(got[i].sum.mu_sym, expected[i].sum.mu_sym);
      ASSERT_EQ(got[i].face_count, expected[i].face_count);
    }
  }
}

TEST(BallSum, RadiiInTheOrderGiven) {
  const Shape s = shapes::sphere(1, 2);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const auto together = sums(balls, {s.mesh.vertices[3]}, {0.7, 0.2, 1.5, 0.2}, BallDefinition::ExactDensity);
  const std::array<double, 4> radii = {0.7, 0.2, 1.5, 0.2};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto alone = sums(balls, {s.mesh.vertices[3]}, {radii[i]}, BallDefinition::ExactDensity);
    EXPECT_EQ(together[i].sum.mu0, alone[0].sum.mu0);
    EXPECT_EQ(together[i].face_count, alone[0].face_count);
  }
}

TEST(BallSum, RefusesBadRadiiAndCancels) {
  const Shape s = shapes::sphere(1, 1);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const double radius : {0.0, -1.0, kNaN, HUGE_VAL}) {
    EXPECT_THROW(sums(balls, {Vec3::Zero()}, {1.0, radius}, BallDefinition::ExactDensity), Error) << radius;
  }
  std::atomic<bool> cancel{true};
  Execution run;
  run.cancel = &cancel;
  EXPECT_THROW(sums(balls, s.mesh.vertices, {1.0}, BallDefinition::ExactDensity, run), Cancelled);
}

TEST(MeasureTriangles, CountsAndDrops) {
  for (const Specimen& s : shapes::zoo()) {
    const Triangles t = triangles_of(s.mesh, s.normals);
    std::size_t expected = 0, dropped = 0;
    for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
      const Faces::View v = s.mesh.faces[f];
      const bool finite = std::all_of(v.begin(), v.end(), [&](Index i) { return s.mesh.vertices[i].allFinite(); });
      finite ? expected += v.size() == 3 ? 1 : v.size() : ++dropped;
    }
    EXPECT_EQ(t.size(), expected) << s.name;
    EXPECT_EQ(t.dropped_faces, dropped) << s.name;
    EXPECT_EQ(measure_triangles(t).size(), t.size());
    EXPECT_EQ(t.weights.size(), s.mesh.weights.empty() ? 0 : t.size());
    EXPECT_TRUE(std::is_sorted(t.faces.begin(), t.faces.end()));
  }
  const Shape s = shapes::sphere(1, 1);
  Normals u = s.normals;
  u[0].x() = kNaN;
  EXPECT_EQ(triangles_of(s.mesh, u).dropped_faces, 4U) << "a normal that is not finite drops its faces";
  u.pop_back();
  EXPECT_THROW(triangles_of(s.mesh, u), Error);
  Mesh bad = s.mesh;
  bad.faces.add(0, 1, 4000);
  EXPECT_THROW(triangles_of(bad, s.normals), Error);
}

TEST(SpatialOrder, IsAPermutationWithTheLostLast) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> some(-5, 5);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.emplace_back(some(random), some(random), some(random));
  points[17].y() = kNaN;
  points[900].x() = HUGE_VAL;
  std::vector<Index> order = spatial_order(points);
  ASSERT_EQ(order.size(), points.size());
  EXPECT_EQ((std::vector<Index>{std::min(order[1998], order[1999]), std::max(order[1998], order[1999])}),
            (std::vector<Index>{17, 900}));
  Execution run;
  run.threads = 3;
  EXPECT_EQ(spatial_order(points, run), order);
  double walk = 0, given = 0;
  for (std::size_t i = 1; i < 1998; ++i) walk += (points[order[i]] - points[order[i - 1]]).norm();
  for (std::size_t i = 902; i < 2000; ++i) given += (points[i] - points[i - 1]).norm();
  EXPECT_LT(walk / 1997, 0.4 * given / 1098) << "neighbours along the curve are near";
  std::sort(order.begin(), order.end());
  for (Index i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
  EXPECT_TRUE(spatial_order({}).empty());
  EXPECT_EQ(spatial_order(std::vector<Vec3>(5, Vec3(1, 1, 1))).size(), 5U);
}

}  // namespace
}  // namespace kappa
