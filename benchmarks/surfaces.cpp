// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/Geometry>

#include "kappa/core/spatial_order.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa::bench {
namespace {

constexpr int kSide = 707;  // vertices along each side: 999,698 triangles on the torus
constexpr double kJitter = 0.3;

void add_grid_faces(Mesh& mesh, int rows, int columns, int wrap_rows, int wrap_columns) {
  const auto at = [=](int i, int j) { return static_cast<Index>((i % wrap_rows) * wrap_columns + j % wrap_columns); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      mesh.faces.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.faces.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
}

Surface torus() {
  Surface s;
  Random random(1);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double a = 2 * kPi * (i + random.uniform(-kJitter, kJitter)) / kSide;
      const double b = 2 * kPi * (j + random.uniform(-kJitter, kJitter)) / kSide;
      const Vec3 u(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
      s.mesh.vertices.push_back(3 * Vec3(std::cos(a), std::sin(a), 0) + u);
      s.normals.push_back(u);
    }
  }
  add_grid_faces(s.mesh, kSide, kSide, kSide, kSide);
  return s;
}

Surface terrain() {
  Surface s;
  Random random(2);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const double x = i + random.uniform(-kJitter, kJitter), y = j + random.uniform(-kJitter, kJitter);
      s.mesh.vertices.emplace_back(x, y, 20 * std::sin(x / 60) * std::cos(y / 80));
      s.normals.push_back(
          Vec3(-std::cos(x / 60) * std::cos(y / 80) / 3, std::sin(x / 60) * std::sin(y / 80) / 4, 1).normalized());
    }
  }
  add_grid_faces(s.mesh, kSide - 1, kSide - 1, kSide, kSide);
  return s;
}

/// Adds an equilateral triangle with corners at `size` from `centre`, all with the normal `u`.
void add_triangle(Surface& s, Vec3 centre, Vec3 u, double size) {
  const Vec3 a = u.unitOrthogonal(), b = u.cross(a);
  const auto first = static_cast<Index>(s.mesh.vertices.size());
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * kPi * i / 3;
    s.mesh.vertices.push_back(centre + size * (std::cos(angle) * a + std::sin(angle) * b));
    s.normals.push_back(u);
  }
  s.mesh.faces.add(first, first + 1, first + 2);
}

constexpr double kTorusEdge = 2 * kPi / kSide;

Surface with_huge_face() {
  Surface s = torus();
  add_triangle(s, Vec3(0, 0, 0.1), Vec3::UnitZ(), 1e4 * kTorusEdge);
  return s;
}

Surface with_pareto_faces() {
  Surface s = torus();
  Random random(3);
  const std::size_t vertices = s.mesh.vertices.size(), extra = s.mesh.faces.size() / 100;
  for (std::size_t i = 0; i < extra; ++i) {
    const std::size_t v = random.below(vertices);
    const double size = kTorusEdge * std::pow(1 - random.uniform(), -1 / 1.2);
    add_triangle(s, s.mesh.vertices[v], s.normals[v], size);
  }
  return s;
}

std::vector<Index> random_order(std::size_t count, std::uint64_t seed) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  Random random(seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

Surface shuffled() {
  const Surface from = torus();
  const std::vector<Index> place = random_order(from.mesh.vertices.size(), 4);
  Surface s = from;
  for (std::size_t v = 0; v < place.size(); ++v) {
    s.mesh.vertices[place[v]] = from.mesh.vertices[v];
    s.normals[place[v]] = from.normals[v];
  }
  s.mesh.faces.clear();
  for (const Index f : random_order(from.mesh.faces.size(), 5)) {
    const Faces::View face = from.mesh.faces[f];
    s.mesh.faces.add(place[face[0]], place[face[1]], place[face[2]]);
  }
  return s;
}

Surface make(const std::string& name) {
  if (name == "shuffled") return shuffled();
  if (name == "terrain") return terrain();
  if (name == "huge") return with_huge_face();
  if (name == "pareto") return with_pareto_faces();
  return torus();
}

}  // namespace

const Surface& surface(const std::string& name) {
  static std::map<std::string, Surface> made;
  const auto found = made.find(name);
  return found != made.end() ? found->second : made.emplace(name, make(name)).first->second;
}

const Triangles& triangles(const std::string& name) {
  static std::map<std::string, Triangles> made;
  const auto found = made.find(name);
  if (found != made.end()) return found->second;
  const Surface& s = surface(name);
  return made.emplace(name, triangles_of(s.mesh, s.normals)).first->second;
}

double radius_for(const std::string& name, double faces) {
  const double area = name == "terrain" ? 0.5 : 12 * kPi * kPi / (2.0 * kSide * kSide);
  return std::sqrt(faces * area / kPi);
}

std::vector<Vec3> queries(const std::string& name, std::size_t count) {
  const Surface& s = surface(name == "terrain" ? name : "torus");
  const std::vector<Index> order = spatial_order(s.mesh.vertices);
  const std::size_t run = std::min<std::size_t>(count, 1000), runs = count / run;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < runs; ++i) {
    // Off the multiples of powers of two, where the curve jumps.
    const std::size_t first = (2 * i + 1) * order.size() / (2 * runs);
    for (std::size_t k = first; k < std::min(first + run, order.size()); ++k) out.push_back(s.mesh.vertices[order[k]]);
  }
  return out;
}

}  // namespace kappa::bench
