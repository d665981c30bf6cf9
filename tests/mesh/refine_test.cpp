// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/refine.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <tuple>

#include "kappa/core/error.hpp"
#include "kappa/mesh/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

double total_area(const MeasuredTriangles& t) {
  double area = 0;
  for (const MeasureSum& m : t.measures) area += m.area;
  return area;
}

TEST(Refine, FlatFacesStayAndKeepTheirSums) {
  Shape s = shapes::square(4);
  s.mesh.weights.assign(s.mesh.faces.size(), 0.5);
  for (const int levels : {0, 1, 3}) {
    const MeasuredTriangles t = measure_refined(s.mesh, s.normals, levels);
    EXPECT_EQ(t.size(), s.mesh.faces.size() << (2 * levels));
    EXPECT_EQ(t.vertices, s.mesh.vertices.size());
    EXPECT_NEAR(total_area(t), 0.5, 1e-13);
    for (const Vec3& x : t.x) EXPECT_EQ(x.z(), 0);
    for (const double w : t.weights) EXPECT_EQ(w, 0.5);
  }
}

TEST(Refine, NewPointsComeNearToASphere) {
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    const Shape s = shapes::sphere(2, levels);
    const MeasuredTriangles t = measure_refined(s.mesh, s.normals, 2);
    double off = 0, turned = 0;
    for (std::size_t i = t.vertices; i < t.x.size(); ++i) {
      off = std::max(off, std::abs(t.x[i].norm() - 2));
      turned = std::max(turned, (t.u[i] - t.x[i].normalized()).norm());
      EXPECT_NEAR(t.u[i].norm(), 1, 1e-15);
    }
    if (before > 0) {
      EXPECT_GT(before / off, 12) << "fourth order in the edge length";
    }
    before = off;
    EXPECT_LT(turned, 0.1 * std::pow(0.25, levels - 2));
  }
}

/// Every edge of a part lies in exactly two parts, ends compared by the bits of their positions.
TEST(Refine, KeepsAClosedMeshWatertight) {
  const Shape s = shapes::torus(3, 1, 12, 9);
  const MeasuredTriangles t = measure_refined(s.mesh, s.normals, 2);
  using Bits = std::tuple<double, double, double>;
  const auto bits = [&](Index v) { return Bits(t.x[v].x(), t.x[v].y(), t.x[v].z()); };
  std::map<std::pair<Bits, Bits>, int> edges;
  std::map<Bits, Vec3> normals;
  for (const auto& c : t.corners) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[std::minmax(bits(c[i]), bits(c[(i + 1) % 3]))];
      EXPECT_EQ(normals.emplace(bits(c[i]), t.u[c[i]]).first->second, t.u[c[i]]);
    }
  }
  for (const auto& [edge, count] : edges) ASSERT_EQ(count, 2);
  EXPECT_EQ(normals.size(), s.mesh.vertices.size() * 16);
}

/// The star of a vertex is made of its whole faces, however many parts they have.
TEST(Refine, StarsAreThoseOfWholeFaces) {
  Shape s = shapes::torus(3, 1, 24, 16);
  s.mesh.faces.add({0, 1, 17, 16});
  const MeasuredTriangles coarse = measure_triangles(s.mesh, s.normals);
  const MeasuredTriangles fine = measure_refined(s.mesh, s.normals, 2);
  const CurvatureField a = estimate_at_vertices(coarse, s.normals, VertexLimit::Star);
  const CurvatureField b = estimate_at_vertices(fine, s.normals, VertexLimit::Star);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(b.samples[i].face_count, 16 * a.samples[i].face_count);
    EXPECT_NEAR(b.samples[i].area, a.samples[i].area, 0.05 * a.samples[i].area);
  }
}

TEST(Refine, SameBitsForAnyNumberOfThreads) {
  const Shape s = shapes::torus(3, 1, 40, 30);
  Execution run;
  run.threads = 3;
  const MeasuredTriangles a = measure_refined(s.mesh, s.normals, 2), b = measure_refined(s.mesh, s.normals, 2, run);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.measures[i].mu_sym, b.measures[i].mu_sym);
}

TEST(Refine, RoughnessTellsNoisyNormals) {
  Shape s = shapes::torus(3, 1, 60, 40);
  EXPECT_LT(normal_roughness(s.mesh, s.normals), 0.05);
  EXPECT_TRUE(std::isnan(normal_roughness(shapes::square(4).mesh, shapes::square(4).normals)));
  for (std::size_t i = 0; i < s.normals.size(); ++i) {
    const double angle = 0.3 * std::sin(12.9898 * static_cast<double>(i * i % 9973));
    s.normals[i] = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()) * s.normals[i];
  }
  EXPECT_GT(normal_roughness(s.mesh, s.normals), kRoughNormals);
}

TEST(Refine, SurvivesTheZoo) {
  for (const shapes::Specimen& specimen : shapes::zoo()) {
    const MeasuredTriangles t = measure_refined(specimen.mesh, specimen.normals, 1);
    const MeasuredTriangles coarse = measure_triangles(specimen.mesh, specimen.normals);
    EXPECT_EQ(t.size(), 4 * coarse.size()) << specimen.name;
    EXPECT_EQ(t.dropped_faces, coarse.dropped_faces) << specimen.name;
    for (const MeasureSum& m : t.measures) EXPECT_TRUE(std::isfinite(m.mu0 + m.mu1() + m.mu2)) << specimen.name;
  }
}

TEST(Refine, Refuses) {
  const Shape s = shapes::sphere(1, 1);
  for (const int levels : {-1, kMostRefinements + 1}) EXPECT_THROW(measure_refined(s.mesh, s.normals, levels), Error);
  CurvatureOptions options;
  options.refine = 1;
  options.quads = QuadMeasures::Bilinear;
  EXPECT_THROW(validate(options), Error);
}

}  // namespace
}  // namespace kappa
