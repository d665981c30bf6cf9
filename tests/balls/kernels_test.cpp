// SPDX-License-Identifier: BSD-3-Clause
#include "balls/kernels/views.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "balls/whole_measures.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "support/ball_sums.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;
using test::brute_force;
using test::places;
using test::relative_error;
using test::ScaledSum;
using test::sums;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};

struct Balls {
  std::vector<Vec3> centres;
  std::vector<double> radii;
};

/// The tables that are not the baseline's.
std::vector<const kernels::Table*> other_tables() {
  const kernels::Tables tables = kernels::usable_tables();
  return {tables.begin() + 1, tables.end()};
}

/// Up to what fused products round once: a few roundings of the sum of absolute values.
void expect_same_sums(const Triangles& t, const Balls& balls, const kernels::Table& table, const std::string& name) {
  const MeasureTree best(t, Precision::Double, table), baseline(t, Precision::Double, kernels::baseline_table());
  for (const BallDefinition ball : kBalls) {
    const auto a = sums(best, balls.centres, balls.radii, ball), b = sums(baseline, balls.centres, balls.radii, ball);
    std::vector<ScaledSum> scaled = brute_force(t, balls.centres, balls.radii, ball);
    for (std::size_t i = 0; i < a.size(); ++i) {
      scaled[i].ball = b[i];
      EXPECT_LE(relative_error(a[i].sum, scaled[i]), 1e-13) << name << ", ball " << i;
      EXPECT_EQ(a[i].face_count, b[i].face_count) << name << ", ball " << i;
    }
  }
}

double longest_edge(const Triangles& t) {
  double longest = 0;
  for (const auto& c : t.corners) {
    for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, (t.x[c[(i + 1) % 3]] - t.x[c[i]]).norm());
  }
  return longest;
}

/// In floats, to what their digits are worth: areas of parts are off by roundings of radius * edge.
void expect_same_fast_sums(const Triangles& t, const Balls& balls, const kernels::Table& table,
                           const std::string& name) {
  const MeasureTree best(t, Precision::Fast, table), baseline(t, Precision::Fast, kernels::baseline_table());
  const double longest = longest_edge(t);
  for (const BallDefinition ball : kBalls) {
    const auto a = sums(best, balls.centres, balls.radii, ball), b = sums(baseline, balls.centres, balls.radii, ball);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double radius = balls.radii[i % balls.radii.size()], size = 4e-6 * radius * std::max(radius, longest);
      EXPECT_NEAR(a[i].sum.area, b[i].sum.area, size) << name << ", ball " << i;
      EXPECT_NEAR(a[i].sum.mu0, b[i].sum.mu0, size) << name << ", ball " << i;
      EXPECT_NEAR(a[i].sum.mu1(), b[i].sum.mu1(), 1e-6 * std::max(radius, longest)) << name << ", ball " << i;
      EXPECT_NEAR(a[i].sum.mu2, b[i].sum.mu2, 1e-6) << name << ", ball " << i;
      EXPECT_EQ(a[i].face_count, b[i].face_count) << name << ", ball " << i;
    }
  }
}

TEST(Kernels, EveryInstructionSetGivesTheSameSums) {
  if (other_tables().empty()) GTEST_SKIP() << "this processor has the baseline alone";
  const auto expect_same = [](const Mesh& mesh, const Normals& normals, const Balls& balls, const std::string& name) {
    const Triangles t = triangles_of(mesh, normals);
    for (const kernels::Table* const table : other_tables()) {
      expect_same_sums(t, balls, *table, name + ", " + table->name);
      expect_same_fast_sums(t, balls, *table, name + ", " + table->name);
    }
  };
  const Shape s = shapes::torus(3, 1, 60, 41);
  expect_same(s.mesh, s.normals, {places(s.mesh, 50, 0.3), {0.05, 0.3, 1.2, 5}}, "torus");
  for (const shapes::Specimen& z : shapes::zoo())
    expect_same(z.mesh, z.normals, {places(z.mesh, 40, 0.3), {0.053, 0.41, 4.0}}, z.name);
}

TEST(Kernels, EveryInstructionSetMeasuresFacesToTheSameBits) {
  const Shape s = shapes::torus(3, 1, 31, 23);
  Triangles t = triangles_of(s.mesh, s.normals);
  t.weights.assign(t.size(), 1.0);
  t.weights.back() = 3;
  const std::vector<MeasureSum> unweighted = measure_triangles(triangles_of(s.mesh, s.normals));
  const kernels::TriangleView view = view_of(t, {});
  for (const std::size_t count : {t.size(), std::size_t{1}, std::size_t{6}}) {
    std::vector<MeasureSum> baseline(t.size());
    kernels::baseline_table().measure(view, t.size() - count, t.size(), &baseline[0].area);
    EXPECT_EQ(baseline[t.size() - count].area == 0, false);
    EXPECT_EQ(baseline.back().mu0, 3 * unweighted.back().mu0);
    for (const kernels::Table* const table : other_tables()) {
      std::vector<MeasureSum> found(t.size());
      table->measure(view, t.size() - count, t.size(), &found[0].area);
      EXPECT_EQ(std::memcmp(found.data(), baseline.data(), t.size() * sizeof(MeasureSum)), 0) << table->name << count;
    }
  }
}

TEST(Triangles, AreThoseOfEveryTriangleAlone) {
  for (const shapes::Specimen& z : shapes::zoo()) {
    Mesh mesh = z.mesh;
    mesh.weights.clear();
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) mesh.weights.push_back(1 + static_cast<double>(f % 3));
    const Triangles t = triangles_of(mesh, z.normals);
    const std::vector<MeasureSum> measures = measure_triangles(t);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto& c = t.corners[i];
      const Measures m = triangle_measures({t.x[c[0]], t.x[c[1]], t.x[c[2]]}, {t.u[c[0]], t.u[c[1]], t.u[c[2]]});
      const double w = mesh.weights[t.faces[i]], size = (t.x[c[1]] - t.x[c[0]]).norm() + (t.x[c[2]] - t.x[c[0]]).norm();
      // Of terms of the size of edges squared and edges, a few roundings.
      EXPECT_NEAR(measures[i].area, w * m.area, 1e-15 * w * size * size) << z.name << i;
      EXPECT_NEAR(measures[i].mu0, w * m.mu0, 1e-15 * w * size * size) << z.name << i;
      EXPECT_NEAR(measures[i].mu1(), w * m.mu1, 1e-14 * w * size) << z.name << i;
      EXPECT_NEAR(measures[i].mu2, w * m.mu2, 1e-14 * w) << z.name << i;
    }
  }
}

/// Meshes of plain triangles have a shorter way in than those with other faces, weights, or vertices to leave out.
TEST(Triangles, AreTheSameBitsWhicheverWayTheyCome) {
  const Shape s = shapes::torus(3, 1, 61, 43);
  const Triangles plain = triangles_of(s.mesh, s.normals);
  ASSERT_TRUE(plain.weights.empty());
  Mesh ones = s.mesh, other = s.mesh;
  ones.weights.assign(ones.faces.size(), 1.0);
  other.faces.add({0, 1, 2, 3});
  Mesh dropping = s.mesh;
  dropping.vertices.push_back(Vec3::Constant(kNaN));
  dropping.faces.add(0, 1, static_cast<Index>(s.mesh.vertices.size()));
  Normals one_more = s.normals;
  one_more.emplace_back(0, 0, 1);
  Execution three;
  three.threads = 3;
  const std::vector<MeasureSum> measures = measure_triangles(plain);
  const std::size_t bytes = plain.size() * sizeof(MeasureSum);
  for (const Triangles& t :
       {triangles_of(ones, s.normals), triangles_of(other, s.normals), triangles_of(dropping, one_more),
        triangles_of(s.mesh, s.normals, QuadMeasures::Split, three)}) {
    ASSERT_GE(t.size(), plain.size());
    for (const Execution& run : {Execution(), three})
      EXPECT_EQ(std::memcmp(measure_triangles(t, run).data(), measures.data(), bytes), 0);
    EXPECT_TRUE(std::equal(plain.corners.begin(), plain.corners.end(), t.corners.begin()));
    EXPECT_TRUE(std::equal(plain.faces.begin(), plain.faces.end(), t.faces.begin()));
    EXPECT_EQ(t.weight(7), 1);
  }
}

}  // namespace
}  // namespace kappa
