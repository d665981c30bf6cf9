// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/measure_tree.hpp"

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
using test::places;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};

void expect_brute_force(const Triangles& t, const std::vector<Vec3>& centres, const std::vector<double>& radii,
                        const std::string& name, double tolerance = 1e-12) {
  const MeasureTree tree(t);
  for (const BallDefinition ball : kBalls) {
    const auto got = test::sums(tree, centres, radii, ball);
    const auto expected = test::brute_force(t, centres, radii, ball);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const std::string what = name + ", query " + std::to_string(i / radii.size()) + ", radius " +
                               std::to_string(radii[i % radii.size()]) + ", definition " +
                               std::to_string(static_cast<int>(ball));
      EXPECT_EQ(got[i].face_count, expected[i].ball.face_count) << what;
      EXPECT_LE(test::relative_error(got[i].sum, expected[i]), tolerance) << what;
    }
  }
}

TEST(MeasureTree, EqualsBruteForceOnTheZoo) {
  for (const shapes::Specimen& s : shapes::zoo()) {
    const Triangles t = triangles_of(s.mesh, s.normals);
    expect_brute_force(t, places(s.mesh, 60, 0.4), {0.053, 0.41, 1.13, 4.0, 2e4}, s.name);
  }
}

TEST(MeasureTree, EqualsBruteForceOnTorusAtVerticesWithFiveToFortyFaces) {
  const Shape s = shapes::torus(3, 1, 40, 24);
  const Triangles t = triangles_of(s.mesh, s.normals);
  expect_brute_force(t, s.mesh.vertices, {0.05, 0.31, 0.45, 0.71, 0.93}, "torus");
}

TEST(MeasureTree, EqualsBruteForceFromTinyToLargerThanEverything) {
  const Shape s = shapes::torus(3, 1, 70, 50);
  const Triangles t = triangles_of(s.mesh, s.normals);
  expect_brute_force(t, places(s.mesh, 60, 0.5), {1e-9, 1e-4, 0.02, 1.0, 2.0, 3.7, 7.9, 8.5, 1e6}, "torus");
}

TEST(MeasureTree, EqualsBruteForceOnASoupOfAllSizes) {
  const Shape s = shapes::sphere_soup(1, 3000, 5);
  const Triangles t = triangles_of(s.mesh, s.normals);
  expect_brute_force(t, places(s.mesh, 60, 0.3), {0.01, 0.1, 0.5, 1.2, 2.5}, "soup");
}

TEST(MeasureTree, EqualsBruteForceWithFacesOfEverySize) {
  // Pareto-distributed sizes and one face 10^4 times the others, over a sphere.
  Shape s = shapes::sphere(1, 4);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto add = [&](Vec3 x, Vec3 u, double size) {
    const Vec3 a = u.unitOrthogonal(), b = u.cross(a);
    const auto first = static_cast<Index>(s.mesh.vertices.size());
    for (const Vec3& corner : {Vec3(x + size * a), Vec3(x + size * (b - a)), Vec3(x - size * (a + b))}) {
      s.mesh.vertices.push_back(corner);
      s.normals.push_back((u + 0.1 * Vec3(uniform(random), uniform(random), uniform(random))).normalized());
    }
    s.mesh.faces.add(first, first + 1, first + 2);
  };
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t v = random() % 1000;
    add(s.mesh.vertices[v], s.normals[v], 0.05 * std::pow(1 - uniform(random), -1 / 1.2));
  }
  add(Vec3(0, 0, 0.5), Vec3::UnitZ(), 500);
  const Triangles t = triangles_of(s.mesh, s.normals);
  // Corners 25,000 radii away are themselves rounded to 5e-12 radii.
  constexpr double kFarCorners = 1e-10;
  expect_brute_force(t, places(s.mesh, 100, 0.2), {0.02, 0.12, 0.4, 1.4}, "all sizes", kFarCorners);
}

TEST(MeasureTree, EqualsBruteForceOnBilinearQuads) {
  const Shape s = shapes::wavy_quads();
  expect_brute_force(triangles_of(s.mesh, s.normals, QuadMeasures::Bilinear), places(s.mesh, 81, 0.3), {0.3, 1.1, 2.7},
                     "quads");
}

TEST(MeasureTree, SmallestAndDegenerateInputs) {
  const MeasureTree nothing((Triangles()));
  EXPECT_EQ(test::sums(nothing, {Vec3::Zero()}, {1.0}, BallDefinition::ExactDensity)[0].face_count, 0U);

  Mesh one;
  one.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 1, 0)};
  one.faces.add(0, 1, 2);
  const Normals up(3, Vec3::UnitZ());
  expect_brute_force(triangles_of(one, up), places(one, 20, 0.5), {0.1, 0.6, 3}, "one triangle");

  for (int copy = 0; copy < 4999; ++copy) one.faces.add(0, 1, 2);
  const Triangles all_at_one_place = triangles_of(one, up);
  expect_brute_force(all_at_one_place, places(one, 10, 0.5), {0.1, 0.6, 3}, "5000 triangles at one place");

  Mesh point;
  point.vertices.assign(3, Vec3(2, 3, 4));
  for (int copy = 0; copy < 100; ++copy) point.faces.add(0, 1, 2);
  const MeasureTree at_a_point(triangles_of(point, up));
  const auto got =
      test::sums(at_a_point, {Vec3(2, 3, 4), Vec3(2, 3, 5), Vec3(2, 3, 5.1)}, {1}, BallDefinition::ExactDensity);
  EXPECT_EQ(got[0].face_count, 100U);
  EXPECT_EQ(got[1].face_count, 100U) << "the ball is closed";
  EXPECT_EQ(got[2].face_count, 0U);
}

TEST(MeasureTree, TouchingFacesCount) {
  // Every distance is exact, so that engines can only agree by deciding alike.
  const Shape s = shapes::square(9);
  const Triangles t = triangles_of(s.mesh, s.normals);
  expect_brute_force(t, s.mesh.vertices, {0.125, 0.25, 0.375, 0.625, 1.0}, "square");
  std::vector<Vec3> above;
  for (const Vec3& x : s.mesh.vertices) above.push_back(x + Vec3(0, 0, 0.25));
  expect_brute_force(t, above, {0.25, 0.5}, "square from above");
}

TEST(MeasureTree, RadiiTogetherEqualRadiiAlone) {
  const Shape s = shapes::torus(3, 1, 50, 30);
  const Triangles t = triangles_of(s.mesh, s.normals);
  const MeasureTree tree(t);
  const std::vector<double> radii = {0.8, 0.2, 0.8 * std::sqrt(0.5), 0.4, 5, 0.2};
  for (const BallDefinition ball : kBalls) {
    const auto together = test::sums(tree, s.mesh.vertices, radii, ball);
    for (std::size_t r = 0; r < radii.size(); ++r) {
      const auto alone = test::sums(tree, s.mesh.vertices, {radii[r]}, ball);
      for (std::size_t i = 0; i < alone.size(); ++i) {
        const BallMeasures &a = together[i * radii.size() + r], &b = alone[i];
        EXPECT_EQ(a.face_count, b.face_count);
        EXPECT_NEAR(a.sum.mu0, b.sum.mu0, 1e-13 * b.sum.area);
        EXPECT_NEAR((a.sum.tensor() - b.sum.tensor()).norm(), 0, 1e-12 * b.sum.area);
      }
    }
  }
}

TEST(MeasureTree, ThreadsGiveTheSameBits) {
  const Shape s = shapes::torus(3, 1, 90, 60);
  for (const Precision precision : {Precision::Double, Precision::Fast}) {
    const MeasureTree tree(triangles_of(s.mesh, s.normals), precision);
    std::vector<std::vector<BallMeasures>> results;
    for (const int threads : {1, 2, 3}) {
      Execution run;
      run.threads = threads;
      results.push_back(test::sums(tree, s.mesh.vertices, {0.2, 0.7}, BallDefinition::ExactDensity, run));
    }
    for (std::size_t i = 0; i < results[0].size(); ++i) {
      for (std::size_t other = 1; other < results.size(); ++other) {
        EXPECT_EQ(std::memcmp(&results[0][i].sum, &results[other][i].sum, sizeof(MeasureSum)), 0) << i;
        EXPECT_EQ(results[0][i].face_count, results[other][i].face_count);
      }
    }
  }
}

/// Alone, a query starts from where it alone would; in company from what holds the balls of its neighbours too.
void expect_no_bit_changed_by_company(const MeasureTree& tree, const std::vector<Vec3>& centres,
                                      const std::vector<double>& radii) {
  const auto all = test::sums(tree, centres, radii, BallDefinition::ExactDensity);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto alone = test::sums(tree, {centres[i]}, radii, BallDefinition::ExactDensity);
    for (std::size_t r = 0; r < radii.size(); ++r) {
      const BallMeasures &a = all[i * radii.size() + r], &b = alone[r];
      EXPECT_EQ(std::memcmp(&a.sum, &b.sum, sizeof(MeasureSum)), 0) << i << ", radius " << radii[r];
      EXPECT_EQ(a.face_count, b.face_count) << i << ", radius " << radii[r];
    }
  }
}

TEST(MeasureTree, OrderOfQueriesAndCompanyChangeNoBit) {
  const Shape s = shapes::torus(3, 1, 160, 120);
  std::vector<Vec3> shuffled = s.mesh.vertices;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937_64(4));
  shuffled.resize(200);
  // Near each other, and a few far away.
  std::vector<Vec3> near(s.mesh.vertices.begin(), s.mesh.vertices.begin() + 150);
  for (const double distance : {3.0, 10.0, 1e4}) near.push_back(Vec3(distance, 1, 0));
  for (const Precision precision : {Precision::Double, Precision::Fast}) {
    const MeasureTree tree(triangles_of(s.mesh, s.normals), precision);
    for (const double radius : {0.05, 0.3, 1.0, 20.0}) {
      expect_no_bit_changed_by_company(tree, shuffled, {radius});
      expect_no_bit_changed_by_company(tree, near, {radius});
    }
    expect_no_bit_changed_by_company(tree, near, {0.1, 0.8, 0.4});
  }
}

TEST(MeasureTree, RefusesRadiiThatAreNoBallsAndSurvivesCentresThatAreNoPoints) {
  const Shape s = shapes::sphere(1, 2);
  const MeasureTree tree(triangles_of(s.mesh, s.normals));
  for (const double radius : {0.0, -1.0, kNaN, HUGE_VAL})
    EXPECT_THROW(test::sums(tree, {Vec3::Zero()}, {radius}, BallDefinition::ExactDensity), Error) << radius;
  const auto got = test::sums(tree, {Vec3(kNaN, 0, 0), Vec3(0, HUGE_VAL, 0), Vec3(1, 0, 0)}, {0.5, 9.0},
                              BallDefinition::ExactDensity);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(got[i].face_count, 0U);
    EXPECT_EQ(got[i].sum.mu0, 0.0);
  }
  EXPECT_GT(got[4].face_count, 0U);
  EXPECT_EQ(got[5].face_count, tree.triangles().size());
  EXPECT_TRUE(test::sums(tree, {Vec3::Zero()}, {}, BallDefinition::ExactDensity).empty());
}

TEST(MeasureTree, CanBeCancelled) {
  const Shape s = shapes::torus(3, 1, 60, 40);
  const MeasureTree tree(triangles_of(s.mesh, s.normals));
  std::atomic<bool> stop{false};
  Execution run;
  run.cancel = &stop;
  std::size_t answered = 0;
  const auto sink = [&](std::size_t, const BallMeasures*) {
    if (++answered == 10) stop = true;
  };
  EXPECT_THROW(tree.sum(s.mesh.vertices, {0.5}, BallDefinition::ExactDensity, run, sink), Cancelled);
  EXPECT_LT(answered, s.mesh.vertices.size());
}

TEST(MeasureTree, IsTheSameMadeByAnyNumberOfThreads) {
  const Shape s = shapes::torus(3, 1, 200, 90);  // several parts for every thread
  const std::vector<Vec3> centres = places(s.mesh, 50, 0.4);
  const MeasureTree expected(triangles_of(s.mesh, s.normals));
  const auto sums = test::sums(expected, centres, {0.3}, BallDefinition::ExactDensity);
  for (int threads = 1; threads <= 3; ++threads) {
    Execution run;
    run.threads = threads;
    const MeasureTree tree(triangles_of(s.mesh, s.normals), Precision::Double, run);
    EXPECT_EQ(tree.triangles().corners, expected.triangles().corners) << threads;
    EXPECT_EQ(tree.triangles().faces, expected.triangles().faces) << threads;
    const auto got = test::sums(tree, centres, {0.3}, BallDefinition::ExactDensity);
    for (std::size_t i = 0; i < got.size(); ++i)
      EXPECT_EQ(std::memcmp(&got[i].sum, &sums[i].sum, sizeof got[i].sum), 0) << i << ", threads " << threads;
  }
}

TEST(MeasureTree, CanBeCancelledWhileItIsMade) {
  const Shape s = shapes::torus(3, 1, 60, 40);
  const std::atomic<bool> stop{true};
  Execution run;
  run.cancel = &stop;
  EXPECT_THROW(MeasureTree(triangles_of(s.mesh, s.normals), Precision::Double, run), Cancelled);
}

TEST(MeasureTree, ExactDensityIsUnchangedWhenFacesAreSplitInFour) {
  const Shape coarse = shapes::torus(3, 1, 40, 24), fine = shapes::subdivided(coarse);
  const MeasureTree coarse_tree(triangles_of(coarse.mesh, coarse.normals));
  const MeasureTree fine_tree(triangles_of(fine.mesh, fine.normals));
  const std::vector<double> radii = {0.2, 0.9, 2.3};
  double fraction_change = 0;
  for (const BallDefinition ball : kBalls) {
    const auto a = test::sums(coarse_tree, coarse.mesh.vertices, radii, ball);
    const auto b = test::sums(fine_tree, coarse.mesh.vertices, radii, ball);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double change = (a[i].sum.tensor() - b[i].sum.tensor()).norm() + std::abs(a[i].sum.mu0 - b[i].sum.mu0);
      if (ball == BallDefinition::ExactDensity) {
        EXPECT_LE(change, 1e-12 * a[i].sum.area) << i;
      } else {
        fraction_change = std::max(fraction_change, change / a[i].sum.area);
      }
    }
  }
  EXPECT_GT(fraction_change, 1e-6) << "the area fraction does depend on the faces: this test could not fail";
}

TEST(MeasureTree, EqualsBruteForceOnTinyTrianglesOnTheRimOfALargeBall) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vec3(normal(random), normal(random), normal(random)).normalized(); };
  for (const double size : {1e-2, 1e-3, 1e-4, 3e-5}) {
    Mesh mesh;
    Normals u;
    for (Index t = 0; t < 400; ++t) {
      const Vec3 at = (1 + 0.5 * size * normal(random)) * direction();
      for (int corner = 0; corner < 3; ++corner) {
        mesh.vertices.push_back(at + size * direction());
        u.push_back(direction());
      }
      mesh.faces.add(3 * t, 3 * t + 1, 3 * t + 2);
    }
    expect_brute_force(triangles_of(mesh, u), {Vec3::Zero()}, {1 - size, 1.0, 1 + size}, std::to_string(size));
  }
}

TEST(MeasureTree, ScalesWithoutLossFarFromUnity) {
  const Shape s = shapes::torus(3, 1, 50, 30);
  const MeasureTree unit(triangles_of(s.mesh, s.normals));
  const auto expected = test::sums(unit, s.mesh.vertices, {0.7}, BallDefinition::ExactDensity);
  for (const double scale : {1e-6, 1e-3, 0.3, 1e3, 1e6}) {
    Mesh mesh = s.mesh;
    for (Vec3& x : mesh.vertices) x *= scale;
    const MeasureTree tree(triangles_of(mesh, s.normals));
    const auto got = test::sums(tree, mesh.vertices, {0.7 * scale}, BallDefinition::ExactDensity);
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_EQ(got[i].face_count, expected[i].face_count);
      EXPECT_NEAR(got[i].sum.mu0 / (scale * scale), expected[i].sum.mu0, 1e-11 * expected[i].sum.area);
      EXPECT_NEAR(got[i].sum.mu1() / scale, expected[i].sum.mu1(), 1e-11 * expected[i].sum.area);
    }
  }
}

TEST(MeasureTree, RelativeErrorsAreTheSameOverTwelveOrdersOfScale) {
  const Shape s = shapes::torus(3, 1, 60, 40);
  // Errors of the mean curvature at the vertices, over its truth; x and u are exact points and normals of the torus.
  const auto errors = [&](double scale) {
    Mesh mesh = s.mesh;
    for (Vec3& x : mesh.vertices) x *= scale;
    CurvatureOptions options;
    options.radii = {0.6 * scale};
    const auto field = estimate_curvatures(mesh, s.normals, options)[0];
    std::vector<double> out;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const double from_axis = s.mesh.vertices[v].head<2>().norm();
      const double truth = 0.5 * (1 + (from_axis - 3) / from_axis) / scale;
      out.push_back((field.samples[v].k.mean - truth) * scale);
    }
    return out;
  };
  const std::vector<double> unit = errors(1);
  EXPECT_GT(*std::max_element(unit.begin(), unit.end()), 1e-4) << "no error: this test could not fail";
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const std::vector<double> got = errors(scale);
    for (std::size_t v = 0; v < got.size(); ++v) EXPECT_NEAR(got[v], unit[v], 1e-9) << scale << " vertex " << v;
  }
}

TEST(MeasureTree, BytesPerTriangle) {
  const Shape s = shapes::torus(3, 1, 200, 150);
  const Triangles t = triangles_of(s.mesh, s.normals);
  const auto per_triangle = [&](Precision p) {
    return static_cast<double>(MeasureTree(t, p).bytes()) / static_cast<double>(t.size());
  };
  EXPECT_LE(per_triangle(Precision::Double), 130);
  EXPECT_LE(per_triangle(Precision::Fast), 90) << "with the measures of the triangles";
}

}  // namespace
}  // namespace kappa
