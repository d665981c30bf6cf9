// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <random>

#include "shapes.hpp"

namespace kappa::shapes {
namespace {

/// Unit normals that vary with the position, whatever the faces do.
Normals bent_normals(const std::vector<Vec3>& x) {
  Normals u;
  for (const Vec3& p : x) u.push_back(Vec3(0.3 * std::sin(p.x() + p.z()), 0.4 * std::cos(p.y()), 1).normalized());
  return u;
}

Specimen specimen(std::string name, Mesh mesh) {
  Normals u = bent_normals(mesh.vertices);
  return {std::move(name), std::move(mesh), std::move(u)};
}

Mesh three_sheets() {
  Mesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.4, 1, 0), Vec3(0.5, -0.5, 0.8), Vec3(0.6, -0.5, -0.8)};
  for (const Index apex : {2, 3, 4}) m.faces.add(0, 1, apex);
  return m;
}

Mesh bow_tie() {
  Mesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(1, -0.5, 0), Vec3(1, 0.5, 0.2), Vec3(-1, 0.5, 0.1), Vec3(-1, -0.5, -0.2)};
  m.faces.add(0, 1, 2);
  m.faces.add(0, 3, 4);
  return m;
}

Mesh duplicate_and_opposite() {
  Mesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0.1), Vec3(1, 1, 0.4)};
  m.faces.add(0, 1, 2);
  m.faces.add(0, 1, 2);
  m.faces.add(2, 1, 0);
  m.faces.add(1, 3, 2);
  m.faces.add(2, 3, 1);
  return m;
}

Mesh zero_area() {
  Mesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.25, 0, 0), Vec3(2, 0, 0),
                Vec3(0, 1, 0), Vec3(0, 0, 0), Vec3(0, 0, 0),    Vec3(0.5, 0.5, 0.5)};
  m.faces.add(0, 1, 2);  // collinear
  m.faces.add(0, 3, 1);
  m.faces.add(0, 5, 6);  // one point three times
  m.faces.add(0, 5, 4);  // two corners in one point
  m.faces.add(7, 7, 4);  // a repeated vertex
  m.faces.add(0, 1, 4);
  return m;
}

Mesh isolated_vertices() {
  Mesh m = three_sheets();
  m.vertices.emplace_back(0.5, 0.3, 0.01);
  m.vertices.emplace_back(40, 40, 40);
  return m;
}

Mesh giant() {
  Mesh m = square(9).mesh;
  const Index n = static_cast<Index>(m.vertices.size());
  m.vertices.emplace_back(-700, -500, 0.05);
  m.vertices.emplace_back(900, -400, 0.02);
  m.vertices.emplace_back(10, 800, -0.03);
  m.faces.add(n, n + 1, n + 2);
  return m;
}

Mesh mixed_polygons() {
  Mesh m;
  for (int i = 0; i < 7; ++i) {
    const double a = 2 * kPi * i / 7;
    m.vertices.emplace_back(std::cos(a), std::sin(a), 0.2 * std::sin(3 * a));
  }
  m.vertices.emplace_back(2, 0.2, 0.3);
  m.vertices.emplace_back(2, 1.1, 0.1);
  m.vertices.emplace_back(1.5, 2, 0.4);
  m.faces.add({0, 1, 2, 3, 4, 5, 6});
  m.faces.add({0, 7, 8, 1});
  m.faces.add({1, 8, 9});
  m.faces.add({1, 0, 2, 9, 8});  // crosses itself
  return m;
}

Mesh missing_corner() {
  Mesh m = square(4).mesh;
  m.vertices[5] = Vec3(kNaN, 0, 0);
  m.vertices[10].z() = std::numeric_limits<double>::infinity();
  return m;
}

Mesh weighted() {
  Mesh m = square(5).mesh;
  for (std::size_t f = 0; f < m.faces.size(); ++f) m.weights.push_back(static_cast<double>(1 + f % 5) / 3);
  return m;
}

Mesh needles() {
  Mesh m;
  for (int i = 0; i < 40; ++i) {
    const double a = 0.11 * i;
    m.vertices.emplace_back(std::cos(a), std::sin(a), 0.02 * i);
    m.vertices.emplace_back(3 * std::cos(a), 3 * std::sin(a), 0.05);
    m.vertices.emplace_back(1.7 * std::cos(a) - 1e-6 * std::sin(a), 1.7 * std::sin(a) + 1e-6 * std::cos(a), 0.03);
    m.faces.add(static_cast<Index>(3 * i), static_cast<Index>(3 * i + 1), static_cast<Index>(3 * i + 2));
  }
  return m;
}

}  // namespace

std::vector<Specimen> zoo() {
  std::vector<Specimen> all;
  all.push_back(specimen("three sheets", three_sheets()));
  all.push_back(specimen("bow tie", bow_tie()));
  all.push_back(specimen("duplicate and opposite faces", duplicate_and_opposite()));
  all.push_back(specimen("zero area", zero_area()));
  all.push_back(specimen("isolated vertices", isolated_vertices()));
  all.push_back(specimen("giant triangle", giant()));
  all.push_back(specimen("mixed polygons", mixed_polygons()));
  all.push_back(specimen("missing corner", missing_corner()));
  all.push_back(specimen("weighted", weighted()));
  all.push_back(specimen("needles", needles()));
  all.push_back(specimen("moebius", moebius(24)));
  const Shape soup = sphere_soup(1, 60, 7);
  all.push_back({"soup", soup.mesh, soup.normals});
  for (Specimen& s : all) {
    for (std::size_t i = 0; i < s.normals.size(); ++i) {
      if (!s.mesh.vertices[i].allFinite()) s.normals[i] = Vec3::UnitZ();
    }
  }
  return all;
}

}  // namespace kappa::shapes
