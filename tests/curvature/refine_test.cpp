// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/shape_operators.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "kappa/core/error.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

double total_area(const Triangles& t) {
  double area = 0;
  for (const MeasureSum& m : measure_triangles(t)) area += m.area;
  return area;
}

Mat3 tangent_plane(const Vec3& u) {
  return Mat3::Identity() - u * u.transpose();
}

/// Exact ones of a sphere around the origin.
ShapeOperators sphere_shapes(const Shape& s) {
  ShapeOperators shapes;
  for (std::size_t i = 0; i < s.normals.size(); ++i) shapes.push_back(s.mean[i] * tangent_plane(s.normals[i]));
  return shapes;
}

/// Exact ones of a torus around z, whose k_min is along the parallels.
ShapeOperators torus_shapes(const Shape& s) {
  ShapeOperators shapes;
  for (std::size_t i = 0; i < s.normals.size(); ++i) {
    const Vec3 along = Vec3::UnitZ().cross(s.mesh.vertices[i]).normalized();
    const Vec3 across = along.cross(s.normals[i]);
    shapes.push_back(s.k_min[i] * along * along.transpose() + s.k_max[i] * across * across.transpose());
  }
  return shapes;
}

/// The middle of an edge, with the normal there.
struct Middle {
  Vec3 x, u;
};

/// The middle of the edge of two points, as a triangle with a third has it.
Middle middle(const Vec3& x0, const Vec3& u0, const Mat3& s0, const Vec3& x1, const Vec3& u1, const Mat3& s1) {
  Mesh mesh;
  mesh.vertices = {x0, x1, x0 + Vec3(0.1, 2.3, 0.4)};
  mesh.faces.add(0, 1, 2);
  const Triangles t = refined_triangles(mesh, {u0, u1, Vec3(1, 2, 3)}, ShapeOperators{s0, s1, s0}, 1);
  // The part at corner 0 has the middle of its first edge next.
  for (const auto& c : t.corners) {
    if (c[0] == 0) return {t.x[c[1]], t.u[c[1]]};
  }
  return {};
}

TEST(Refine, FlatFacesStayAndKeepTheirSums) {
  Shape s = shapes::square(4);
  s.mesh.weights.assign(s.mesh.faces.size(), 0.5);
  for (const int levels : {0, 1, 3}) {
    const Triangles t = refined_triangles(s.mesh, s.normals, levels);
    EXPECT_EQ(t.size(), s.mesh.faces.size() << (2 * levels));
    EXPECT_EQ(t.vertices, s.mesh.vertices.size());
    EXPECT_NEAR(total_area(t), 0.5, 1e-13);
    for (const Vec3& x : t.x) EXPECT_EQ(x.z(), 0);
    for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(t.weight(i), 0.5);
  }
}

TEST(Refine, MiddlesOfASphereAreOfSixthOrder) {
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    const Shape s = shapes::sphere(2, levels);
    const Triangles t = refined_triangles(s.mesh, s.normals, sphere_shapes(s), 1);
    double off = 0;
    for (std::size_t i = t.vertices; i < t.x.size(); ++i) {
      off = std::max(off, std::abs(t.x[i].norm() - 2));
      EXPECT_LT((t.u[i] - t.x[i].normalized()).norm(), 1e-14) << "both lie in the middle by symmetry";
    }
    if (before > 0) {
      EXPECT_GT(before / off, 50) << "64 in the limit";
    }
    before = off;
  }
  EXPECT_LT(before, 2e-8);
}

/// Largest distance of new points from a torus of R = 3, r = 1, and of their normals from its own.
struct Offsets {
  double points = 0, normals = 0;
};

Offsets offsets_from_torus(const Triangles& t) {
  Offsets off;
  for (std::size_t i = t.vertices; i < t.x.size(); ++i) {
    const Vec3 from_core = t.x[i] - 3 * Vec3(t.x[i].x(), t.x[i].y(), 0).normalized();
    off.points = std::max(off.points, std::abs(from_core.norm() - 1));
    off.normals = std::max(off.normals, (t.u[i] - from_core.normalized()).norm());
  }
  return off;
}

/// Curvature varies along the edges, which are no geodesics.
TEST(Refine, PointsAndNormalsOfATorusAreOfFourthOrder) {
  const double normal_ratio[] = {15, 7.5};  // the mean of shape operators makes it third order from the second level on
  for (const int levels : {1, 2}) {
    Offsets before;
    for (const int n : {48, 96}) {
      const Shape s = shapes::torus(3, 1, n, n);
      const Offsets off = offsets_from_torus(refined_triangles(s.mesh, s.normals, torus_shapes(s), levels));
      if (before.points > 0) {
        EXPECT_GT(before.points / off.points, 15);
        EXPECT_GT(before.normals / off.normals, normal_ratio[levels - 1]);
      }
      before = off;
    }
    EXPECT_LT(before.points, 1e-6);
    EXPECT_LT(before.normals, levels == 1 ? 2e-6 : 3e-5);
  }
}

/// A torus of n x n places in bricks of six corners, each of them whole, or a pentagon and a triangle, or two quads.
Shape torus_of_polygons(int n, int corners) {
  Shape s = shapes::torus(3, 1, n, n);
  s.mesh.faces.clear();
  const auto at = [n](int i, int j) { return static_cast<Index>((i % n) * n + j % n); };
  for (int i = 0; i < n; ++i) {
    for (int j = i % 2; j < n; j += 2) {
      const Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i + 1, j + 2), e = at(i, j + 2);
      const Index f = at(i, j + 1);
      if (corners == 6) s.mesh.faces.add({a, b, c, d, e, f});
      if (corners == 5) s.mesh.faces.add({a, b, c, d, f});
      if (corners == 5) s.mesh.faces.add(f, d, e);
      if (corners == 4) s.mesh.faces.add({a, b, c, f});
      if (corners == 4) s.mesh.faces.add({c, d, e, f});
    }
  }
  return s;
}

/// As new points of edges are; normals of third order, as from the second level on, of pentagons not quite. Flat
/// barycentres are 1.5e-3 to 3.5e-3 off at n = 128.
TEST(Refine, MiddlesOfPolygonsAreOfFourthOrder) {
  for (const int corners : {4, 5, 6}) {
    Offsets before;
    for (const int n : {64, 128}) {
      const Shape s = torus_of_polygons(n, corners);
      Triangles t = refined_triangles(s.mesh, s.normals, torus_shapes(s), 1);
      // The middles come before all other new points.
      t.x.resize(t.vertices + s.mesh.faces.size() / (corners == 5 ? 2 : 1));
      const Offsets off = offsets_from_torus(t);
      if (before.points > 0) {
        EXPECT_GT(before.points / off.points, 15) << corners;
        EXPECT_GT(before.normals / off.normals, corners == 5 ? 6.5 : 7.5) << corners;
      }
      before = off;
    }
    EXPECT_LT(before.points, 4e-6) << corners;
    EXPECT_LT(before.normals, 5e-5) << corners;
  }
}

/// Middles of diagonals may nearly meet, one above the other: the way between them is no edge of the surface.
TEST(Refine, MiddlesOfPolygonsWithoutShapeOperatorsAreOfSecondOrder) {
  for (const int corners : {4, 5, 6}) {
    Offsets before;
    for (const int n : {64, 128}) {
      const Shape s = torus_of_polygons(n, corners);
      const ShapeOperators unknown(s.normals.size(), Mat3::Constant(kNaN));
      Triangles t = refined_triangles(s.mesh, s.normals, unknown, 1);
      t.x.resize(t.vertices + s.mesh.faces.size() / (corners == 5 ? 2 : 1));
      const Offsets off = offsets_from_torus(t);
      if (before.points > 0) {
        EXPECT_GT(before.points / off.points, 3.5) << corners;
        EXPECT_GT(before.normals / off.normals, 3.5) << corners;
      }
      before = off;
    }
    EXPECT_LT(before.points, 1e-3) << corners;
    EXPECT_LT(before.normals, 1e-2) << corners;
  }
}

TEST(Refine, MiddlesOfFlatPolygonsAreTheMeansOfTheirCorners) {
  for (const std::size_t count : {4, 5, 7, 9, 11, 13, 62, 1023}) {
    Mesh mesh;
    std::vector<Index> face;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(count);
      mesh.vertices.emplace_back(3 * std::cos(angle) + 0.3 * std::sin(5 * angle), std::sin(angle), 0.5);
      mean += mesh.vertices.back() / static_cast<double>(count);
      face.push_back(static_cast<Index>(i));
    }
    mesh.faces.add(face);
    const ShapeOperators flat(count, Mat3::Zero());
    const Triangles t = refined_triangles(mesh, Normals(count, Vec3::UnitZ()), flat, 1);
    EXPECT_LT((t.x[count] - mean).norm(), 1e-14) << count;
    EXPECT_LT((t.u[count] - Vec3::UnitZ()).norm(), 1e-15) << count;
  }
}

TEST(Refine, MiddlesOfPolygonsDoNotDependOnTheFirstCorner) {
  for (const int corners : {4, 5, 6}) {
    const Shape s = torus_of_polygons(24, corners);
    Shape turned = s;
    turned.mesh.faces.clear();
    for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
      std::vector<Index> face(s.mesh.faces[f].begin(), s.mesh.faces[f].end());
      std::rotate(face.begin(), face.begin() + 1, face.end());
      turned.mesh.faces.add(face);
    }
    const Triangles a = refined_triangles(s.mesh, s.normals, torus_shapes(s), 1);
    const Triangles b = refined_triangles(turned.mesh, turned.normals, torus_shapes(s), 1);
    for (std::size_t i = a.vertices; i < a.vertices + s.mesh.faces.size() / 2; ++i) {
      EXPECT_LT((a.x[i] - b.x[i]).norm(), 1e-15);
      EXPECT_LT((a.u[i] - b.u[i]).norm(), 1e-15);
    }
  }
}

TEST(Refine, EstimatedShapesAreNearTheTruth) {
  const Shape s = shapes::torus(3, 1, 60, 60);
  const ShapeOperators found = estimate_shape_operators(s.mesh, s.normals), truth = torus_shapes(s);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT((found[i] - truth[i]).norm(), 3e-3);
  Mesh points;
  points.vertices = s.mesh.vertices;
  for (const Mat3& shape : estimate_shape_operators(points, s.normals)) EXPECT_TRUE(shape.array().isNaN().all());
}

TEST(Refine, WithoutShapesMiddlesAreThoseOfPnTriangles) {
  const Vec3 a(0, 0, 0), b(1, 0.2, -0.1), ua = Vec3(-0.2, 0.1, 1).normalized(), ub = Vec3(0.3, 0, 1).normalized();
  const Mat3 known = 0.3 * tangent_plane(ua), unknown = Mat3::Constant(kNaN);
  const Vec3 e = b - a;
  const Vec3 x = (a + b) / 2 - (e.dot(ua) * ua - e.dot(ub) * ub) / 8;
  const Vec3 u = (ua + ub - 2 * e.dot(ua + ub) / e.dot(e) * e).normalized();
  for (const auto& [sa, sb] : {std::pair(unknown, unknown), {known, unknown}, {unknown, known}}) {
    const Middle m = middle(a, ua, sa, b, ub, sb);
    EXPECT_LT((m.x - x).norm(), 1e-15);
    EXPECT_LT((m.u - u).norm(), 1e-15);
  }
  EXPECT_GT((middle(a, ua, known, b, ub, 0.3 * tangent_plane(ub)).x - x).norm(), 1e-3);
}

/// No surface leans by more than 60 degrees over an edge, nor turns by more than 2 along it: the edge stays straight.
TEST(Refine, EdgesThatNoCurveDescribesStayStraight) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), up = Vec3::UnitZ(), steep = Vec3(-4, 0, 1).normalized();
  const Mat3 flat = Mat3::Zero(), sharp = 5 * tangent_plane(up);
  for (const Middle& m : {middle(a, steep, flat, b, up, flat), middle(a, up, sharp, b, up, flat),
                          middle(a, Vec3::UnitX(), flat, b, up, flat)}) {
    EXPECT_LT((m.x - (a + b) / 2).norm(), 1e-15);
    EXPECT_NEAR(m.u.norm(), 1, 1e-15);
  }
  const Middle opposite = middle(a, up, flat, b, -up, flat), none = middle(a, up, flat, a, up, flat);
  EXPECT_EQ(opposite.x, (a + b) / 2);
  EXPECT_EQ(opposite.u, Vec3::Zero()) << "nothing says which";
  EXPECT_EQ(none.x, a);
  EXPECT_EQ(none.u, up);
}

TEST(Refine, MovesAndScalesWithTheMesh) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  const Triangles t = refined_triangles(s.mesh, s.normals, 2);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).matrix();
  for (const double scale : {1e-6, 1e6}) {
    Shape moved = s;
    for (Vec3& x : moved.mesh.vertices) x = scale * (turn * x + Vec3(5, -7, 2));
    for (Vec3& u : moved.normals) u = turn * u;
    const Triangles m = refined_triangles(moved.mesh, moved.normals, 2);
    ASSERT_EQ(m.size(), t.size());
    for (std::size_t i = 0; i < t.x.size(); ++i) {
      EXPECT_LT((m.x[i] / scale - turn * t.x[i] - Vec3(5, -7, 2)).norm(), 1e-11);
      EXPECT_LT((m.u[i] - turn * t.u[i]).norm(), 1e-11);
    }
  }
}

TEST(Refine, NewPointsComeNearToASphere) {
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    const Shape s = shapes::sphere(2, levels);
    const Triangles t = refined_triangles(s.mesh, s.normals, 2);
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
void expect_watertight(const Shape& s, const Triangles& t) {
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

TEST(Refine, KeepsAClosedMeshWatertight) {
  const Shape s = shapes::torus(3, 1, 12, 9);
  ShapeOperators shapes = torus_shapes(s);
  for (std::size_t i = 0; i < shapes.size(); i += 5) shapes[i] = Mat3::Constant(kNaN);
  for (std::size_t i = 1; i < shapes.size(); i += 7) shapes[i] *= 10;
  expect_watertight(s, refined_triangles(s.mesh, s.normals, 2));
  expect_watertight(s, refined_triangles(s.mesh, s.normals, shapes, 2));
}

/// The star of a vertex is made of its whole faces, however many parts they have.
TEST(Refine, StarsAreThoseOfWholeFaces) {
  Shape s = shapes::torus(3, 1, 24, 16);
  s.mesh.faces.add({0, 1, 17, 16});
  const BruteForceBallSum coarse(triangles_of(s.mesh, s.normals));
  const BruteForceBallSum fine(refined_triangles(s.mesh, s.normals, 2));
  const CurvatureField a = curvatures_at_vertices(coarse, s.normals, VertexLimit::Star);
  const CurvatureField b = curvatures_at_vertices(fine, s.normals, VertexLimit::Star);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(b.samples[i].face_count, 16 * a.samples[i].face_count);
    EXPECT_NEAR(b.samples[i].area, a.samples[i].area, 0.05 * a.samples[i].area);
  }
}

TEST(Refine, SameBitsForAnyNumberOfThreads) {
  const Shape s = shapes::torus(3, 1, 40, 30);
  Execution run;
  run.threads = 3;
  const Triangles a = refined_triangles(s.mesh, s.normals, 2), b = refined_triangles(s.mesh, s.normals, 2, run);
  ASSERT_EQ(a.size(), b.size());
  const std::vector<MeasureSum> of_a = measure_triangles(a), of_b = measure_triangles(b, run);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(of_a[i].mu_sym, of_b[i].mu_sym);
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
    const Triangles t = refined_triangles(specimen.mesh, specimen.normals, 1);
    const Triangles coarse = triangles_of(specimen.mesh, specimen.normals);
    EXPECT_EQ(t.size(), 4 * coarse.size()) << specimen.name;
    EXPECT_EQ(t.dropped_faces, coarse.dropped_faces) << specimen.name;
    for (const MeasureSum& m : measure_triangles(t))
      EXPECT_TRUE(std::isfinite(m.mu0 + m.mu1() + m.mu2)) << specimen.name;
  }
}

TEST(Refine, Refuses) {
  const Shape s = shapes::sphere(1, 1);
  for (const int levels : {-1, kMostRefinements + 1}) EXPECT_THROW(refined_triangles(s.mesh, s.normals, levels), Error);
  EXPECT_THROW(refined_triangles(s.mesh, s.normals, ShapeOperators(), 1), Error);
  MeasureOptions options;
  options.refine = 1;
  options.quads = QuadMeasures::Bilinear;
  EXPECT_THROW(validate(options), Error);
  EXPECT_THROW(triangles_of(s.mesh, s.normals, options), Error);
}

}  // namespace
}  // namespace kappa
