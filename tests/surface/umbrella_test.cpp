// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/umbrella.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "kappa/core/error.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"

namespace kappa {
namespace {

struct Cloud {
  std::vector<Vec3> points;
  Normals normals;
};

/// Random points on a torus, uniform by area (rejection on the distance from the axis).
Cloud torus_cloud(double R, double r, std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Cloud c;
  while (c.points.size() < n) {
    const double a = 2 * kPi * uniform(random), b = 2 * kPi * uniform(random);
    if (uniform(random) * (R + r) > R + r * std::cos(b)) continue;
    const Vec3 u(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
    c.points.push_back(R * Vec3(std::cos(a), std::sin(a), 0) + r * u);
    c.normals.push_back(u);
  }
  return c;
}

Cloud square_cloud(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Cloud c;
  for (std::size_t i = 0; i < n; ++i) c.points.emplace_back(uniform(random), uniform(random), 0);
  c.normals.assign(n, Vec3::UnitZ());
  return c;
}

CloudSurface surface_of(const Cloud& c, int neighbours = 16, int threads = 1) {
  Execution run;
  run.threads = threads;
  return umbrella_surface(Vec3::Zero(), c.points, c.normals, {neighbours}, run);
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) sum += mesh.weight(f) * polygon_vector_area(mesh, f).norm();
  return sum;
}

TEST(Umbrella, AreaOfTorusCloudIsThatOfTheTorus) {
  const double R = 6, r = 2, truth = 4 * kPi * kPi * R * r;
  const CloudSurface s = surface_of(torus_cloud(R, r, 10000, 1));
  EXPECT_NEAR(area(s.mesh), truth, 2e-3 * truth);
  EXPECT_EQ(s.starless_points + s.invalid_points + s.duplicate_points, 0u);
  EXPECT_NEAR(static_cast<double>(s.mesh.faces.size()), 20000, 400);  // two a point
}

/// Largest weight by which a point may break ties (see umbrella.cpp): a tenth of its squared distance to the nearest.
std::vector<double> largest_weights(const std::vector<Vec3>& points) {
  std::vector<double> weights(points.size(), HUGE_VAL);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (i != j) weights[i] = std::min(weights[i], 0.1 * (points[i] - points[j]).squaredNorm());
    }
  }
  return weights;
}

/// Area of the convex hull of points in the plane, by Andrew's chains.
double hull_area(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  double area = 0;
  for (const double side : {1.0, -1.0}) {
    std::vector<Vec3> chain;
    for (const Vec3& p : points) {
      const auto turns = [&](const Vec3& a, const Vec3& b) { return side * (b - a).cross(p - b).z() > 0; };
      while (chain.size() > 1 && !turns(chain[chain.size() - 2], chain.back())) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i) area += side * 0.5 * chain[i - 1].cross(chain[i]).z();
  }
  return area;
}

/// In the plane the stars are those of one Delaunay triangulation: an independent test of every face.
TEST(Umbrella, FacesOfPlanarCloudAreDelaunay) {
  const Cloud c = square_cloud(400, 5);
  const CloudSurface s = surface_of(c, 40);
  const std::vector<double> weights = largest_weights(c.points);
  std::size_t whole = 0;
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const auto face = s.mesh.faces[f];
    const Vec3 &a = c.points[face[0]], &b = c.points[face[1]], &d = c.points[face[2]];
    const double twice_area = (b - a).cross(d - a).z();
    EXPECT_GT(twice_area, 0) << "faces turn counter-clockwise seen from the normals";
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const Vec3& p = c.points[i];
      Mat3 m;
      m << a - p, b - p, d - p;
      m.row(2) = m.topRows(2).colwise().squaredNorm();
      // The determinant is twice the area times the power of p, inside of the circle positive.
      const double inside_by = m.determinant() / twice_area;
      // A Delaunay triangulation with weights allows the weights of the corners, interpolated at p, and that of p.
      const double slack = (std::abs((b - p).cross(d - p).z()) * weights[face[0]] +
                            std::abs((d - p).cross(a - p).z()) * weights[face[1]] +
                            std::abs((a - p).cross(b - p).z()) * weights[face[2]]) /
                               twice_area +
                           weights[i];
      EXPECT_LE(inside_by, slack) << "point " << i << " lies in the circumcircle of face " << f;
    }
    whole += s.mesh.weight(f) == 1.0;
  }
  EXPECT_GT(whole, 0.95 * static_cast<double>(s.mesh.faces.size()));
  // The thin faces along the hull, whose circumcentres lie far outside, are those that may be missing.
  EXPECT_LE(area(s.mesh), hull_area(c.points) + 1e-12);
}

/// Weight of the faces of a mesh in the plane that hold the point `p`.
double coverage_at(const Mesh& mesh, const Vec3& p) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = mesh.vertices[face[i]], &b = mesh.vertices[face[(i + 1) % 3]];
      inside = inside && (b - a).cross(p - a).z() > 0;
    }
    if (inside) sum += mesh.weight(f);
  }
  return sum;
}

TEST(Umbrella, PlanarCloudIsCoveredOnceAwayFromItsBorder) {
  const CloudSurface s = surface_of(square_cloud(400, 5), 40);
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> inner(0.15, 0.85);  // three spacings from the border
  for (int i = 0; i < 2000; ++i) {
    const double x = inner(random), y = inner(random);
    EXPECT_NEAR(coverage_at(s.mesh, {x, y, 0}), 1.0, 1e-12) << x << ' ' << y;
  }
}

/// The four corners of a grid cell lie on a circle: every star must choose the same diagonal.
TEST(Umbrella, GridCellsAreCoveredOnce) {
  Cloud c;
  const int n = 30;
  for (int i = 0; i < n * n; ++i) c.points.emplace_back(i % n, i / n, 0);
  c.normals.assign(c.points.size(), Vec3::UnitZ());
  const CloudSurface s = surface_of(c);
  EXPECT_NEAR(area(s.mesh), (n - 1) * (n - 1), 1e-9);
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) EXPECT_DOUBLE_EQ(s.mesh.weight(f), 1.0);
}

/// On a curved grid the tangent planes distort the cells, each star in its own way.
TEST(Umbrella, CellsOfACurvedGridAreCoveredOnce) {
  Cloud c;
  const double R = 3, r = 1;
  for (int i = 0; i < 120 * 60; ++i) {
    const double a = 2 * kPi * (i % 120) / 120, b = 2 * kPi * (i / 120) / 60;
    const Vec3 u(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
    c.points.push_back(R * Vec3(std::cos(a), std::sin(a), 0) + r * u);
    c.normals.push_back(u);
  }
  const CloudSurface s = surface_of(c);
  const double truth = 4 * kPi * kPi * R * r;
  EXPECT_NEAR(area(s.mesh), truth, 0.01 * truth);
  EXPECT_LT(static_cast<double>(s.mesh.faces.size()), 2.4 * static_cast<double>(c.points.size()));
}

TEST(Umbrella, EqualFacesOfSeveralStarsAreOne) {
  const CloudSurface s = surface_of(torus_cloud(3, 1, 3000, 2));
  std::map<std::array<Index, 3>, int> seen;
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const auto face = s.mesh.faces[f];
    std::array<Index, 3> key = {face[0], face[1], face[2]};
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    EXPECT_EQ(++seen[key], 1);
    const double thirds = 3 * s.mesh.weight(f);
    EXPECT_TRUE(thirds == 1 || thirds == 2 || thirds == 3) << thirds;
  }
}

TEST(Umbrella, CurvatureOfTorusCloudIsRight) {
  const double R = 6, r = 2;
  const Cloud c = torus_cloud(R, r, 10000, 3);
  const CloudSurface s = surface_of(c);
  CurvatureOptions options;
  options.radii = {0.4};
  const CurvatureField field = estimate_curvatures(s.mesh, c.normals, options).front();
  double sum_sq = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    ASSERT_EQ(field.samples[i].k.status, PointStatus::Valid);
    const double axis = std::hypot(c.points[i].x(), c.points[i].y());
    const double truth = 0.5 * (1 / r + (axis - R) / r / axis);
    sum_sq += std::pow(field.samples[i].k.mean - truth, 2);
  }
  // The best of the published random triangles reach 1.7e-3 on an even cloud of this size: at most half of it here.
  EXPECT_LT(std::sqrt(sum_sq / static_cast<double>(c.points.size())), 8.5e-4);
}

TEST(Umbrella, StarsDoNotReachAcrossAGap) {
  Cloud c = square_cloud(500, 8);
  for (Vec3& p : c.points) {
    if (p.x() > 0.5) p.x() += 3;
  }
  const CloudSurface s = surface_of(c, 12);
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const auto face = s.mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((c.points[face[i]] - c.points[face[(i + 1) % 3]]).norm(), 1.5);
  }
}

TEST(Umbrella, DuplicatesAndMissingPointsAreCountedAndHarmless) {
  const Cloud c = torus_cloud(3, 1, 2000, 4);
  Cloud dirty = c;
  dirty.points.insert(dirty.points.end(), c.points.begin(), c.points.end());
  dirty.normals.insert(dirty.normals.end(), c.normals.begin(), c.normals.end());
  for (const Vec3& bad : {Vec3(kNaN, 0, 0), Vec3(0, std::numeric_limits<double>::infinity(), 0)}) {
    dirty.points.push_back(bad);
    dirty.normals.push_back(Vec3::UnitX());
  }
  dirty.points.push_back({3, 0, 1.5});
  dirty.normals.push_back(Vec3::Zero());
  const CloudSurface clean_surface = surface_of(c), s = surface_of(dirty);
  EXPECT_EQ(s.duplicate_points, 2000u);
  EXPECT_EQ(s.invalid_points, 3u);
  EXPECT_EQ(s.mesh.faces.corners(), clean_surface.mesh.faces.corners());
  EXPECT_EQ(s.mesh.weights, clean_surface.mesh.weights);
}

TEST(Umbrella, FewOrCollinearPointsMakeNoFace) {
  Cloud line;
  for (int i = 0; i < 20; ++i) line.points.emplace_back(i, 2 * i, 3 * i);
  line.normals.assign(20, Vec3::UnitZ());
  EXPECT_EQ(surface_of(line).starless_points, 20u);
  Cloud two = {{{0, 0, 0}, {1, 0, 0}}, {Vec3::UnitZ(), Vec3::UnitZ()}};
  EXPECT_EQ(surface_of(two).starless_points, 2u);
  EXPECT_TRUE(surface_of(two).mesh.faces.empty());
}

TEST(Umbrella, RefusesWhatCannotBe) {
  Cloud c = square_cloud(10, 1);
  EXPECT_THROW(surface_of(c, 2), Error);
  EXPECT_THROW(surface_of(c, 256), Error);
  c.normals.pop_back();
  EXPECT_THROW(surface_of(c), Error);
  const Cloud nothing = {{Vec3::Constant(kNaN)}, {Vec3::UnitX()}};
  EXPECT_THROW(surface_of(nothing), Error);
}

TEST(Umbrella, ThreadsAndRigidMotionDoNotMatter) {
  const Cloud c = torus_cloud(3, 1, 2000, 6);
  const CloudSurface one = surface_of(c, 16, 1), three = surface_of(c, 16, 3);
  EXPECT_EQ(one.mesh.faces.corners(), three.mesh.faces.corners());
  EXPECT_EQ(one.mesh.weights, three.mesh.weights);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Cloud moved = c;
  for (Vec3& p : moved.points) p = turn * p + Vec3(10, 20, 30);
  for (Vec3& u : moved.normals) u = turn * u;
  EXPECT_NEAR(area(surface_of(moved).mesh), area(one.mesh), 1e-9 * area(one.mesh));
}

}  // namespace
}  // namespace kappa
