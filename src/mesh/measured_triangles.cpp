// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/mesh/ball_sum.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

bool usable(const Vec3& u) {
  return is_finite(u) && !u.isZero(0);
}

bool usable_face(const Mesh& mesh, const Normals& u, const Faces::View& face) {
  for (const Index v : face) {
    if (!is_finite(mesh.vertices[v]) || !usable(u[v])) return false;
  }
  return true;
}

/// Adds the barycentre of a polygon and the fan of triangles around it.
void add_fan(MeasuredTriangles& t, const Faces::View& face) {
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

void add_face(MeasuredTriangles& t, const Mesh& mesh, std::size_t f) {
  const Faces::View face = mesh.faces[f];
  if (face.size() == 3) {
    t.corners.push_back({face[0], face[1], face[2]});
  } else {
    add_fan(t, face);
  }
  for (std::size_t i = t.faces.size(); i < t.corners.size(); ++i) {
    t.weights.push_back(mesh.weight(f));
    t.faces.push_back(static_cast<Index>(f));
  }
}

MeasureSum whole_measures(const MeasuredTriangles& t, std::size_t i) {
  const auto& c = t.corners[i];
  const Vec3 &x0 = t.x[c[0]], &u0 = t.u[c[0]];
  const Vec3 u_bar = (u0 + t.u[c[1]] + t.u[c[2]]) / 3.0;
  MeasureSum m = triangle_density_sum(t.x[c[1]] - x0, t.x[c[2]] - x0, t.u[c[1]] - u0, t.u[c[2]] - u0, u_bar);
  m *= t.weights[i];
  return m;
}

/// The four parts of a quad get what its bilinear patch has over them, by area: whole quads then have the bilinear
/// measures, and a part of one differs from its bilinear part by less than the two forms of the quad do.
void spread_bilinear(MeasuredTriangles& t, std::size_t first) {
  const Index a = t.corners[first][0], b = t.corners[first + 1][0];
  const Index c = t.corners[first + 2][0], d = t.corners[first + 3][0];
  MeasureSum rest = compact(bilinear_measures({t.x[a], t.x[b], t.x[d], t.x[c]}, {t.u[a], t.u[b], t.u[d], t.u[c]}));
  rest *= t.weights[first];
  MeasureSum split;
  for (std::size_t i = first; i < first + 4; ++i) split += t.measures[i];
  const double area = split.area;
  split *= -1.0;
  rest += split;
  rest.area = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    MeasureSum part = rest;
    part *= area > 0 ? t.measures[i].area / area : 0.25;
    t.measures[i] += part;
  }
}

}  // namespace

MeasuredTriangles measure_triangles(const Mesh& mesh, const Normals& normals, QuadMeasures quads,
                                    const Execution& run) {
  validate(mesh);
  if (normals.size() != mesh.vertices.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(normals.size()) + " normals for " +
                                                std::to_string(mesh.vertices.size()) + " vertices: give one a vertex");
  MeasuredTriangles t;
  t.vertices = mesh.vertices.size();
  t.x = mesh.vertices;
  t.u = normals;
  t.corners.reserve(mesh.faces.size());
  t.weights.reserve(mesh.faces.size());
  t.faces.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (usable_face(mesh, normals, mesh.faces[f])) {
      add_face(t, mesh, f);
    } else {
      ++t.dropped_faces;
    }
  }
  t.measures.resize(t.size());
  parallel_for(t.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) t.measures[i] = whole_measures(t, i);
  });
  if (quads == QuadMeasures::Bilinear) {
    for (std::size_t i = 0; i < t.size(); ++i) {
      const bool first = i == 0 || t.faces[i] != t.faces[i - 1];
      if (first && mesh.faces[t.faces[i]].size() == 4) spread_bilinear(t, i);
    }
  }
  return t;
}

}  // namespace kappa
