// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "balls/kernels/views.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "support/ball_sums.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;
using test::places;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};

/// Largest differences of measures, relative, and of the mean curvature over its largest.
void expect_fast_close(const Shape& s, double radius, BallDefinition ball,
                       const kernels::Table& kernels = kernels::best_table()) {
  const Triangles t = triangles_of(s.mesh, s.normals);
  const MeasureTree in_double(t), fast(t, Precision::Fast, kernels);
  const auto exact = test::sums(in_double, s.mesh.vertices, {radius}, ball),
             got = test::sums(fast, s.mesh.vertices, {radius}, ball);
  double largest = 0, measures = 0, mean = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const MeasureSum &a = exact[i].sum, &b = got[i].sum;
    largest = std::max(largest, std::abs(a.mu1() / (2 * a.mu0)));
    measures = std::max({measures, std::abs(b.mu0 / a.mu0 - 1), std::abs(b.area / a.area - 1)});
    mean = std::max(mean, std::abs(a.mu1() / (2 * a.mu0) - b.mu1() / (2 * b.mu0)));
  }
  EXPECT_LE(measures, 1e-6) << "radius " << radius << " definition " << static_cast<int>(ball);
  EXPECT_LE(mean, 5e-6 * largest) << "radius " << radius << " definition " << static_cast<int>(ball);
  EXPECT_GT(measures, 0) << "the same numbers: nothing was computed in floats";
}

TEST(FastMeasureTree, StaysWithinItsBounds) {
  Shape s = shapes::torus(3, 1, 160, 100);
  for (const double radius : {0.12, 0.3, 1.0}) {
    for (const BallDefinition ball : kBalls) expect_fast_close(s, radius, ball);
  }
  for (const BallDefinition ball : kBalls) {
    for (const kernels::Table* const table : kernels::usable_tables()) expect_fast_close(s, 0.3, ball, *table);
  }
  // Far from the origin, as georeferenced coordinates are.
  for (Vec3& x : s.mesh.vertices) x += Vec3(4e3, -6e3, 1e3);
  expect_fast_close(s, 0.3, BallDefinition::ExactDensity);
}

TEST(FastMeasureTree, ItsTrianglesHaveTheirMeasuresWithoutStoringThem) {
  for (const shapes::Specimen& z : shapes::zoo()) {
    const Triangles t = triangles_of(z.mesh, z.normals, QuadMeasures::Bilinear);
    const MeasureTree in_double(t), fast(t, Precision::Fast);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const MeasureSum a = in_double.measures_of(i), b = fast.measures_of(i);
      const auto& c = in_double.triangles().corners[i];
      const auto& x = in_double.triangles().x;
      const double size = (x[c[1]] - x[c[0]]).norm() + (x[c[2]] - x[c[0]]).norm();
      EXPECT_NEAR(a.area, b.area, 1e-14 * size * size) << z.name << i;
      EXPECT_NEAR(a.mu1(), b.mu1(), 1e-13 * size) << z.name << i;
      EXPECT_NEAR(a.mu2, b.mu2, 1e-13) << z.name << i;
    }
  }
}

TEST(FastMeasureTree, StaysWithinItsBoundsOnBilinearQuads) {
  const Shape s = shapes::wavy_quads();
  const Triangles t = triangles_of(s.mesh, s.normals, QuadMeasures::Bilinear);
  const MeasureTree in_double(t), fast(t, Precision::Fast);
  const std::vector<Vec3> centres = places(s.mesh, 81, 0.3);
  for (const double radius : {0.3, 1.1, 2.7}) {
    const auto a = test::sums(in_double, centres, {radius}, BallDefinition::ExactDensity);
    const auto b = test::sums(fast, centres, {radius}, BallDefinition::ExactDensity);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const double size = 1e-6 * radius * radius;
      EXPECT_NEAR(a[i].sum.area, b[i].sum.area, 4 * size) << radius << " " << i;
      EXPECT_NEAR(a[i].sum.mu0, b[i].sum.mu0, 4 * size) << radius << " " << i;
      EXPECT_NEAR(a[i].sum.mu1(), b[i].sum.mu1(), 4 * size) << radius << " " << i;
      EXPECT_NEAR(a[i].sum.mu2, b[i].sum.mu2, 4 * size) << radius << " " << i;
    }
  }
}

/// Largest difference of the area in unit balls around `centres`, over radius^2; every face is to be met by both.
double largest_error_of_fast(const Mesh& mesh, const Normals& normals, const std::vector<Vec3>& centres,
                             const kernels::Table& kernels) {
  const Triangles t = triangles_of(mesh, normals);
  const MeasureTree in_double(t), fast(t, Precision::Fast, kernels);
  const auto a = test::sums(in_double, centres, {1.0}, BallDefinition::ExactDensity);
  const auto b = test::sums(fast, centres, {1.0}, BallDefinition::ExactDensity);
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    EXPECT_EQ(a[i].face_count, b[i].face_count) << i;
    error = std::max(error, std::abs(a[i].sum.area - b[i].sum.area));
    largest = std::max(largest, a[i].sum.area);
  }
  EXPECT_GT(largest, 0.5) << "no ball met much: this test could not fail";
  return error;
}

TEST(FastMeasureTree, MissesNothingOfTrianglesMuchLargerThanTheBall) {
  const Normals normals = {Vec3(-0.1, 0.2, 1).normalized(), Vec3(0.3, 0.2, 1).normalized(), Vec3(0.1, -0.2, 1)};
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> along(0, 1);
  std::normal_distribution<double> off(0, 0.3);
  for (const double size : {3.0, 10.0, 15.0, 30.0, 100.0, 900.0, 4e3, 1e5}) {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {size, 0.3 * size, 0.2 * size}, {0.1 * size, size, 0.4 * size}};
    mesh.faces.add({0, 1, 2});
    std::vector<Vec3> centres;
    for (int i = 0; i < 300; ++i) {
      const double a = along(random), b = i % 2 ? 0 : (1 - a) * along(random);  // along an edge, and within
      centres.push_back(a * mesh.vertices[1] + b * mesh.vertices[2] + Vec3(off(random), off(random), off(random)));
    }
    // And where the ball hardly reaches over an edge, next to the centroid's foot on it.
    const Vec3 edge = mesh.vertices[1].normalized(), centroid = (mesh.vertices[1] + mesh.vertices[2]) / 3;
    const Vec3 foot = edge.dot(centroid) * edge, outward = (foot - centroid).normalized();
    for (int i = 0; i < 300; ++i)
      centres.push_back(foot + (along(random) - 0.5) * edge + (1 - 0.03 * along(random)) * outward);
    for (const auto* table : kernels::usable_tables())
      EXPECT_LE(largest_error_of_fast(mesh, normals, centres, *table), 2e-5) << size;
  }
}

/// Centres of unit balls that reach over the edges of a triangle by up to 0.02.
std::vector<Vec3> beside_edges(const std::vector<Vec3>& corners, std::mt19937_64& random) {
  std::uniform_real_distribution<double> along(0, 1);
  const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3;
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % 3], edge = (b - a).normalized();
    const double to_foot = edge.dot(centroid - a);
    if (to_foot < 0 || to_foot > (b - a).norm()) continue;
    const Vec3 foot = a + to_foot * edge, outward = (foot - centroid).normalized();
    for (int k = 0; k < 20; ++k)
      centres.emplace_back(foot + (along(random) - 0.5) * edge + (1 - 0.02 * along(random)) * outward);
  }
  return centres;
}

/// What floats, and squares of doubles, lose over such ways is more than the ball has of the triangle.
TEST(MeasureTrees, FindTrianglesTenMillionTimesTheBallThatItHardlyReaches) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> within(-1, 1);
  for (const double size : {1e3, 1e5, 1e6, 1e7}) {
    for (int i = 0; i < 40; ++i) {
      Mesh mesh;
      for (int k = 0; k < 3; ++k)
        mesh.vertices.emplace_back(size * Vec3(within(random), within(random), within(random)));
      mesh.faces.add({0, 1, 2});
      const std::vector<Vec3> centres = beside_edges(mesh.vertices, random);
      const Triangles t = triangles_of(mesh, Normals(3, Vec3(0, 0, 1)));
      const auto truth = test::brute_force(t, centres, {1.0}, BallDefinition::ExactDensity);
      for (const kernels::Table* const table : kernels::usable_tables()) {
        for (const Precision precision : {Precision::Double, Precision::Fast}) {
          const auto found =
              test::sums(MeasureTree(t, precision, *table), centres, {1.0}, BallDefinition::ExactDensity);
          for (std::size_t k = 0; k < centres.size(); ++k)
            EXPECT_NEAR(found[k].sum.area, truth[k].ball.sum.area, 2e-5)
                << table->name << (precision == Precision::Fast ? " fast " : " double ") << size;
        }
      }
    }
  }
}

/// The normal of a needle has few digits in floats.
TEST(FastMeasureTree, MissesNothingOfNeedlesMuchLongerThanTheBall) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto direction = [&] { return Vec3(within(random), within(random), within(random)).normalized(); };
  for (const double flatness : {1e-1, 1e-2, 1e-3, 1e-4}) {
    for (int i = 0; i < 60; ++i) {
      const Vec3 along = direction(), across = along.cross(direction()).normalized(), up = along.cross(across);
      const double size = 40 + 50 * std::abs(within(random));
      Mesh mesh;
      mesh.vertices = {-size * along, size * along, (within(random) * along + 2 * flatness * across) * size};
      for (Vec3& x : mesh.vertices) x += direction();
      mesh.faces.add({0, 1, 2});
      const Vec3 centroid = (mesh.vertices[0] + mesh.vertices[1] + mesh.vertices[2]) / 3;
      std::vector<Vec3> centres;
      for (int k = 0; k < 60; ++k)
        centres.emplace_back(centroid + 0.6 * size * within(random) * along + (0.995 + 0.005 * within(random)) * up);
      const Normals normals(3, up);
      const Triangles t = triangles_of(mesh, normals);
      const auto truth = test::brute_force(t, centres, {1.0}, BallDefinition::ExactDensity);
      for (const kernels::Table* const table : kernels::usable_tables()) {
        const auto found =
            test::sums(MeasureTree(t, Precision::Fast, *table), centres, {1.0}, BallDefinition::ExactDensity);
        for (std::size_t k = 0; k < centres.size(); ++k)
          EXPECT_NEAR(found[k].sum.area, truth[k].ball.sum.area, 2e-5) << table->name << " " << flatness;
      }
    }
  }
}

TEST(FastMeasureTree, MissesNothingOfScatteredTriangles) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto place = [&](double scale) { return Vec3(scale * Vec3(within(random), within(random), within(random))); };
  for (const double apart : {1.0, 10.0, 40.0, 300.0, 3e3, 1e5}) {
    Mesh mesh;
    for (Index i = 0; i < 200; ++i) {
      const Vec3 middle = place(3 * apart);
      for (int k = 0; k < 3; ++k) mesh.vertices.emplace_back(middle + place(1));
      mesh.faces.add({3 * i, 3 * i + 1, 3 * i + 2});
    }
    std::vector<Vec3> centres;
    for (const Vec3& x : mesh.vertices) centres.emplace_back(x + place(0.3));
    const Normals normals(mesh.vertices.size(), Vec3(0, 0, 1));
    for (const auto* table : kernels::usable_tables())
      EXPECT_LE(largest_error_of_fast(mesh, normals, centres, *table), 2e-5) << apart;
  }
}

}  // namespace
}  // namespace kappa
