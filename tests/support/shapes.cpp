// SPDX-License-Identifier: BSD-3-Clause
#include "shapes.hpp"

#include <array>
#include <cmath>
#include <map>
#include <random>

namespace kappa::shapes {
namespace {

/// Adds a vertex with its truth.
void add_vertex(Shape& s, const Vec3& x, const Vec3& u, double k_min, double k_max) {
  s.mesh.vertices.push_back(x);
  s.normals.push_back(u);
  s.k_min.push_back(k_min);
  s.k_max.push_back(k_max);
  s.mean.push_back((k_min + k_max) / 2);
  s.gaussian.push_back(k_min * k_max);
}

Index index(int i) {
  return static_cast<Index>(i);
}

using Edge = std::pair<Index, Index>;

}  // namespace

Shape torus(double R, double r, int slices, int rings) {
  Shape s;
  for (int i = 0; i < slices; ++i) {
    for (int j = 0; j < rings; ++j) {
      const double a = 2 * kPi * i / slices, b = 2 * kPi * j / rings;
      const Vec3 u(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
      const Vec3 core(R * std::cos(a), R * std::sin(a), 0);
      const double around = std::cos(b) / (R + r * std::cos(b));
      add_vertex(s, core + r * u, u, around, 1 / r);
    }
  }
  const auto at = [&](int i, int j) { return index((i % slices) * rings + j % rings); };
  for (int i = 0; i < slices; ++i) {
    for (int j = 0; j < rings; ++j) {
      s.mesh.faces.add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      s.mesh.faces.add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return s;
}

Shape sphere(double radius, int levels) {
  Shape s;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) add_vertex(s, side * Vec3::Unit(axis), Vec3::Zero(), 0, 0);
  }
  const auto corner = [](int axis, int side) { return index(2 * axis + side); };
  for (int octant = 0; octant < 8; ++octant) {
    const int a = octant & 1, b = (octant >> 1) & 1, c = octant >> 2;
    if ((a + b + c) % 2 == 0) {
      s.mesh.faces.add(corner(0, a), corner(1, b), corner(2, c));
    } else {
      s.mesh.faces.add(corner(0, a), corner(2, c), corner(1, b));
    }
  }
  for (int level = 0; level < levels; ++level) {
    s = subdivided(s);
    for (Vec3& x : s.mesh.vertices) x.normalize();
  }
  s.normals = s.mesh.vertices;
  for (Vec3& x : s.mesh.vertices) x *= radius;
  const std::size_t n = s.normals.size();
  s.k_min.assign(n, 1 / radius);
  s.k_max = s.mean = s.k_min;
  s.gaussian.assign(n, 1 / (radius * radius));
  return s;
}

Shape sphere_soup(double radius, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Shape s;
  while (s.normals.size() < static_cast<std::size_t>(count)) {
    const Vec3 u = Vec3(normal(random), normal(random), normal(random)).normalized();
    add_vertex(s, radius * u, u, 1 / radius, 1 / radius);
  }
  std::uniform_int_distribution<int> pick(0, count - 1);
  while (s.mesh.faces.size() < static_cast<std::size_t>(count)) {
    const Index a = index(pick(random)), b = index(pick(random)), c = index(pick(random));
    const Vec3 &xa = s.normals[a], &xb = s.normals[b], &xc = s.normals[c];
    const double turn = xa.dot(xb.cross(xc));
    if (std::abs(turn) < 1e-3) continue;
    turn > 0 ? s.mesh.faces.add(a, b, c) : s.mesh.faces.add(a, c, b);
  }
  return s;
}

Shape cylinder(double radius, double height, int n, int m, double twist) {
  Shape s;
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i < n; ++i) {
      const double a = 2 * kPi * (i + twist * j) / n;
      const Vec3 u(std::cos(a), std::sin(a), 0);
      add_vertex(s, radius * u + Vec3(0, 0, height * j / m), u, 0, 1 / radius);
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const Index a = index(j * n + i), b = index(j * n + (i + 1) % n), c = index((j + 1) * n + i),
                  d = index((j + 1) * n + (i + 1) % n);
      s.mesh.faces.add(a, b, c);
      s.mesh.faces.add(b, d, c);
    }
  }
  return s;
}

Shape wavy_quads() {
  Shape s;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      s.mesh.vertices.emplace_back(i, j, std::sin(0.7 * i) * std::cos(0.5 * j));
      s.normals.push_back(Vec3(0.3 * std::sin(i), 0.2 * std::cos(j), 1).normalized());
      const auto v = static_cast<Index>(9 * i + j);
      if (i < 8 && j < 8) s.mesh.faces.add({v, v + 9, v + 10, v + 1});
    }
  }
  return s;
}

Shape square(int n) {
  Shape s;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      add_vertex(s, Vec3(static_cast<double>(i) / (n - 1), static_cast<double>(j) / (n - 1), 0), Vec3::UnitZ(), 0, 0);
    }
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const Index a = index(j * n + i), c = index((j + 1) * n + i);
      s.mesh.faces.add(a, a + 1, c);
      s.mesh.faces.add(a + 1, c + 1, c);
    }
  }
  return s;
}

Mesh moebius(int n) {
  Mesh mesh;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * kPi * i / n;
    for (const double w : {-0.3, 0.3}) {
      const double rho = 1 + w * std::cos(a / 2);
      mesh.vertices.emplace_back(rho * std::cos(a), rho * std::sin(a), w * std::sin(a / 2));
    }
  }
  for (int i = 0; i < n; ++i) {
    const Index a = index(2 * i), b = a + 1;
    // The last strip joins the first one with its sides exchanged.
    const Index c = i + 1 < n ? index(2 * i + 2) : 1, d = i + 1 < n ? index(2 * i + 3) : 0;
    mesh.faces.add(a, c, d);
    mesh.faces.add(a, d, b);
  }
  return mesh;
}

Mesh tetrahedron() {
  Mesh mesh;
  mesh.vertices = {Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1)};
  mesh.faces.add(0, 2, 1);
  mesh.faces.add(0, 1, 3);
  mesh.faces.add(0, 3, 2);
  mesh.faces.add(1, 2, 3);
  return mesh;
}

Mesh fan(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> some(0.5, 1.5);
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, 0.7);
  for (int i = 0; i < n; ++i) {
    const double a = 2 * kPi * i / n, r = some(random);
    mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 0.3 * some(random));
  }
  for (int i = 0; i < n; ++i) mesh.faces.add(0, index(1 + i), index(1 + (i + 1) % n));
  return mesh;
}

Shape subdivided(const Shape& shape) {
  Shape s = shape;
  s.mesh.faces.clear();
  s.mesh.weights.clear();
  std::map<Edge, Index> midpoints;
  const auto midpoint = [&](Index a, Index b) {
    const auto [it, fresh] = midpoints.try_emplace(std::minmax(a, b), index(static_cast<int>(s.normals.size())));
    if (fresh) {
      s.mesh.vertices.emplace_back((s.mesh.vertices[a] + s.mesh.vertices[b]) / 2);
      s.normals.emplace_back((s.normals[a] + s.normals[b]) / 2);
    }
    return it->second;
  };
  for (std::size_t f = 0; f < shape.mesh.faces.size(); ++f) {
    const Faces::View v = shape.mesh.faces[f];
    const Index a = midpoint(v[0], v[1]), b = midpoint(v[1], v[2]), c = midpoint(v[2], v[0]);
    s.mesh.faces.add(v[0], a, c);
    s.mesh.faces.add(a, v[1], b);
    s.mesh.faces.add(c, b, v[2]);
    s.mesh.faces.add(a, b, c);
    if (!shape.mesh.weights.empty()) s.mesh.weights.insert(s.mesh.weights.end(), 4, shape.mesh.weights[f]);
  }
  return s;
}

Mesh reversed(const Mesh& mesh) {
  Mesh out = mesh;
  out.faces.clear();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Faces::View v = mesh.faces[f];
    out.faces.add(std::vector<Index>(std::make_reverse_iterator(v.end()), std::make_reverse_iterator(v.begin())));
  }
  return out;
}

}  // namespace kappa::shapes
