// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

/// Checks that know nothing of how the shapes are made.
namespace kappa::test {

/// Unit normal field of a family of surfaces, as a function of space.
using NormalField = std::function<Vec3(const Vec3&)>;

/// The normal field of f's level sets from f's gradient.
inline NormalField normal_field(std::function<Vec3(const Vec3&)> gradient) {
  return [gradient](const Vec3& x) { return gradient(x).normalized(); };
}

/// Derivative of the unit normal by central differences of fourth order.
inline Mat3 normal_derivative(const NormalField& normal, const Vec3& x, double step) {
  Mat3 derivative;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 d = step * Vec3::Unit(axis);
    derivative.col(axis) =
        (8 * (normal(x + d) - normal(x - d)) - (normal(x + 2 * d) - normal(x - 2 * d))) / (12 * step);
  }
  return derivative;
}

inline const std::vector<double>& values(const Scan& scan, const std::string& name) {
  const Field* field = scan.field(name);
  if (field == nullptr) throw std::runtime_error("no field " + name);
  return field->values;
}

inline Vec3 vector_value(const Scan& scan, const std::string& name, std::size_t i) {
  return {values(scan, name + "_x")[i], values(scan, name + "_y")[i], values(scan, name + "_z")[i]};
}

/// Checks the truth fields of every point against the derivative of an independent normal field.
/// `tolerance` is relative to `scale`, a curvature.
inline void expect_truth(const Scan& scan, const NormalField& normal, double step, double scale, double tolerance) {
  ASSERT_EQ(scan.normals.size(), scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3& n = scan.normals[i];
    ASSERT_NEAR((n - normal(scan.points[i])).norm(), 0, 1e-11) << "point " << i;
    const Mat3 shape = normal_derivative(normal, scan.points[i], step) * (Mat3::Identity() - n * n.transpose());
    const double trace = shape.trace(), determinant = 0.5 * (trace * trace - (shape * shape).trace());
    const double k_min = values(scan, "k_min")[i], k_max = values(scan, "k_max")[i];
    ASSERT_LE(k_min, k_max) << "point " << i;
    ASSERT_NEAR(k_min + k_max, trace, tolerance * scale) << "point " << i;
    ASSERT_NEAR(k_min * k_max, determinant, tolerance * scale * scale) << "point " << i;
    ASSERT_NEAR(values(scan, "mean_curvature")[i], 0.5 * trace, tolerance * scale) << "point " << i;
    ASSERT_NEAR(values(scan, "gaussian_curvature")[i], determinant, tolerance * scale * scale) << "point " << i;
    const Vec3 dir_min = vector_value(scan, "dir_min", i), dir_max = vector_value(scan, "dir_max", i);
    if (k_max - k_min <= 1e-9 * std::max(std::abs(k_min), std::abs(k_max))) {
      ASSERT_TRUE(std::isnan(dir_min.sum()) && std::isnan(dir_max.sum())) << "directions of umbilic " << i;
      continue;
    }
    ASSERT_NEAR(dir_min.norm(), 1, 1e-13) << "point " << i;
    ASSERT_NEAR(dir_max.norm(), 1, 1e-13) << "point " << i;
    ASSERT_NEAR(dir_min.dot(n), 0, 1e-13) << "point " << i;
    ASSERT_NEAR(dir_max.dot(n), 0, 1e-13) << "point " << i;
    ASSERT_NEAR(dir_min.dot(dir_max), 0, 1e-13) << "point " << i;
    ASSERT_NEAR((shape * dir_min - k_min * dir_min).norm(), 0, tolerance * scale) << "point " << i;
    ASSERT_NEAR((shape * dir_max - k_max * dir_max).norm(), 0, tolerance * scale) << "point " << i;
  }
}

inline Vec3 vector_area(const Scan& scan, std::size_t face) {
  const auto corners = scan.faces[face];
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 2; c < corners.size(); ++c) {
    sum += (scan.points[corners[c - 1]] - scan.points[corners[0]])
               .cross(scan.points[corners[c]] - scan.points[corners[0]]);
  }
  return 0.5 * sum;
}

/// What a mesh encloses and how its faces hang together.
struct MeshFacts {
  Vec3 area_vector = Vec3::Zero();  ///< 0 on closed meshes
  double area = 0;
  double volume = 0;  ///< positive if faces turn counter-clockwise seen from outside
  long euler = 0;
  std::size_t border_edges = 0;    ///< directed edges without an opposite one
  std::size_t repeated_edges = 0;  ///< directed edges of two faces or more: not manifold, or not consistent
};

inline MeshFacts mesh_facts(const Scan& scan) {
  MeshFacts facts;
  std::map<std::pair<Index, Index>, int> edges;
  std::vector<char> used(scan.points.size(), 0);
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    const Vec3 area = vector_area(scan, f);
    const auto corners = scan.faces[f];
    facts.area_vector += area;
    facts.area += area.norm();
    facts.volume += area.dot(scan.points[corners[0]]) / 3;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      used[corners[c]] = 1;
      ++edges[{corners[c], corners[(c + 1) % corners.size()]}];
    }
  }
  long undirected = 0;
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    const bool border = opposite == edges.end();
    facts.border_edges += border ? 1 : 0;
    facts.repeated_edges += count > 1 ? 1 : 0;
    undirected += border ? 2 : 1;
  }
  long vertices = 0;
  for (const char is_used : used) vertices += is_used;
  facts.euler = vertices - undirected / 2 + static_cast<long>(scan.faces.size());
  return facts;
}

/// Every face turns counter-clockwise seen from the side of its vertices' normals.
inline void expect_faces_follow_normals(const Scan& scan) {
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    Vec3 normal = Vec3::Zero();
    for (const Index corner : scan.faces[f]) normal += scan.normals[corner];
    ASSERT_GT(vector_area(scan, f).dot(normal), 0) << "face " << f;
  }
}

/// Points, normals and fields of equal length and, but for directions at umbilics, without NaN.
inline void expect_complete(const Scan& scan) {
  ASSERT_FALSE(scan.points.empty());
  ASSERT_EQ(scan.normals.size(), scan.points.size());
  ASSERT_EQ(scan.width, scan.points.size());
  ASSERT_EQ(scan.height, 1U);
  const std::vector<std::string> names = {"mean_curvature", "gaussian_curvature", "k_min",     "k_max",
                                          "dir_min_x",      "dir_min_y",          "dir_min_z", "dir_max_x",
                                          "dir_max_y",      "dir_max_z"};
  ASSERT_EQ(scan.fields.size(), names.size());
  for (std::size_t f = 0; f < names.size(); ++f) {
    ASSERT_EQ(scan.fields[f].name, names[f]);
    ASSERT_EQ(scan.fields[f].values.size(), scan.points.size());
  }
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    ASSERT_TRUE(is_finite(scan.points[i]) && is_finite(scan.normals[i])) << "point " << i;
    for (std::size_t f = 0; f < 4; ++f) ASSERT_TRUE(std::isfinite(scan.fields[f].values[i])) << "point " << i;
  }
}

}  // namespace kappa::test
