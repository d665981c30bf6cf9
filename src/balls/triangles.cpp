// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/triangles.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "core/large_array.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/quad_measures.hpp"

namespace kappa {
namespace {

bool usable(const Vec3& u) {
  return is_finite(u) && !u.isZero(0);
}

/// Vertices that have a position and a normal.
std::vector<char> usable_vertices(const Mesh& mesh, const Normals& u) {
  std::vector<char> flags(u.size());
  for (std::size_t v = 0; v < u.size(); ++v) flags[v] = is_finite(mesh.vertices[v]) && usable(u[v]);
  return flags;
}

bool usable_face(const std::vector<char>& vertices, const Faces::View& face) {
  return std::all_of(face.begin(), face.end(), [&](Index v) { return vertices[v] != 0; });
}

/// Adds the barycentre of a polygon and the fan of triangles around it.
void add_fan(Triangles& t, const Faces::View& face) {
  std::vector<Vec3> x, u;
  for (const Index v : face) {
    x.push_back(t.x[v]);
    u.push_back(t.u[v]);
  }
  const Index barycentre = static_cast<Index>(t.x.size());
  t.x.push_back(polygon_barycentre(x.data(), x.size()));
  t.u.push_back(barycentre_normal(u.data(), u.size()));
  for (std::size_t i = 0; i < face.size(); ++i) t.corners.push_back({face[i], face[(i + 1) % face.size()], barycentre});
}

void add_face(Triangles& t, const Mesh& mesh, std::size_t f) {
  const Faces::View face = mesh.faces[f];
  if (face.size() == 3) {
    t.corners.push_back({face[0], face[1], face[2]});
  } else {
    add_fan(t, face);
  }
  for (std::size_t i = t.faces.size(); i < t.corners.size(); ++i) {
    if (!mesh.weights.empty()) t.weights.push_back(mesh.weights[f]);
    t.faces.push_back(static_cast<Index>(f));
  }
}

/// Returns whether all of them have a position and a normal.
bool take_vertices(Triangles& t, const Mesh& mesh, const Normals& normals) {
  t.vertices = mesh.vertices.size();
  reserve_large(t.x, t.vertices);
  reserve_large(t.u, t.vertices);
  bool all = true;
  for (std::size_t v = 0; v < t.vertices; ++v) {
    const Vec3 &x = mesh.vertices[v], &u = normals[v];
    t.x.push_back(x);
    t.u.push_back(u);
    all &= is_finite(x) & is_finite(u) & ((u[0] != 0) | (u[1] != 0) | (u[2] != 0));
  }
  return all;
}

/// Faces that are all triangles and all to be measured.
void take_all(Triangles& t, const Mesh& mesh) {
  const std::size_t count = mesh.faces.size();
  const Index* const corners = mesh.faces.corners().data();
  for (std::size_t f = 0; f < count; ++f) t.corners.push_back({corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]});
  t.faces.resize(count);
  std::iota(t.faces.begin(), t.faces.end(), Index{0});
  t.weights.assign(mesh.weights.begin(), mesh.weights.end());
}

void take_usable(Triangles& t, const Mesh& mesh) {
  const std::vector<char> vertices = usable_vertices(mesh, t.u);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (usable_face(vertices, mesh.faces[f])) {
      add_face(t, mesh, f);
    } else {
      ++t.dropped_faces;
    }
  }
}

/// Of a valid mesh, whose faces have three corners at least.
void take_faces(Triangles& t, const Mesh& mesh, bool all_vertices_usable) {
  reserve_large(t.corners, mesh.faces.size());
  reserve_large(t.weights, mesh.weights.size());
  reserve_large(t.faces, mesh.faces.size());
  const bool triangles = mesh.faces.corners().size() == 3 * mesh.faces.size();
  if (triangles && all_vertices_usable) {
    take_all(t, mesh);
  } else {
    take_usable(t, mesh);
  }
}

/// The four parts of a quad, from `first` on, get what its bilinear patch has over them, by area: whole quads then have
/// the bilinear measures, and a part of one differs from its bilinear part by less than the two forms of the quad do.
void spread_bilinear(Triangles& t, const std::vector<MeasureSum>& measures, std::size_t first) {
  const Index a = t.corners[first][0], b = t.corners[first + 1][0];
  const Index c = t.corners[first + 2][0], d = t.corners[first + 3][0];
  MeasureSum rest = compact(bilinear_measures({t.x[a], t.x[b], t.x[d], t.x[c]}, {t.u[a], t.u[b], t.u[d], t.u[c]}));
  rest *= t.weight(first);
  MeasureSum split;
  for (std::size_t i = first; i < first + 4; ++i) split += measures[i];
  const double area = split.area;
  split *= -1.0;
  rest += split;
  rest.area = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    t.beside[i] = rest;
    t.beside[i] *= area > 0 ? measures[i].area / area : 0.25;
  }
}

void make_quads_bilinear(Triangles& t, const Mesh& mesh, const Execution& run) {
  const std::vector<MeasureSum> measures = measure_triangles(t, run);
  t.beside.resize(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool first = i == 0 || t.faces[i] != t.faces[i - 1];
    if (first && mesh.faces[t.faces[i]].size() == 4) spread_bilinear(t, measures, i);
  }
}

}  // namespace

Triangles triangles_of(const Mesh& mesh, const Normals& normals, QuadMeasures quads, const Execution& run) {
  validate(mesh);
  check_one_each(normals.size(), "normal", mesh.vertices.size(), "vertex");
  check_cancelled(run);
  Triangles t;
  take_faces(t, mesh, take_vertices(t, mesh, normals));
  if (quads == QuadMeasures::Bilinear) make_quads_bilinear(t, mesh, run);
  return t;
}

MeasureSum measures_of(const Triangles& triangles, std::size_t t) {
  const auto& c = triangles.corners[t];
  const Vec3 &x0 = triangles.x[c[0]], &u0 = triangles.u[c[0]], &u1 = triangles.u[c[1]], &u2 = triangles.u[c[2]];
  MeasureSum m =
      triangle_density_sum(triangles.x[c[1]] - x0, triangles.x[c[2]] - x0, u1 - u0, u2 - u0, (u0 + u1 + u2) / 3.0);
  m *= triangles.weight(t);
  if (!triangles.beside.empty()) m += triangles.beside[t];
  return m;
}

std::vector<Index> parts_of_faces(const Triangles& triangles) {
  const auto last = std::max_element(triangles.faces.begin(), triangles.faces.end());
  std::vector<Index> parts(last == triangles.faces.end() ? 0 : *last + std::size_t{1});
  for (const Index face : triangles.faces) ++parts[face];
  return parts;
}

}  // namespace kappa
