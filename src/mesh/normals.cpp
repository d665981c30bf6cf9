// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/normals.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/mesh/topology.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;
/// What rounding leaves of votes that cancel, over the sum of their sizes.
constexpr double kCancelled = 1e-12;

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.stableNorm();
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// Angle between two vectors, accurate for any angle.
double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Weight of a face at its corner `i`, from the edges `a`, `b` that leave the corner.
double corner_weight(NormalWeights weights, const Vec3& a, const Vec3& b, double area) {
  switch (weights) {
    case NormalWeights::Uniform:
      return 1.0;
    case NormalWeights::Area:
      return area;
    case NormalWeights::Angle:
      return angle_between(a, b);
    case NormalWeights::Max: {
      const double lengths = a.squaredNorm() * b.squaredNorm();
      return lengths > 0 ? a.cross(b).norm() / lengths : 0.0;
    }
  }
  return 0.0;
}

Vec3 vertex_normal(const Mesh& mesh, const std::vector<Vec3>& vector_areas, const Adjacency& around, Index v,
                   NormalWeights weights) {
  Vec3 sum = Vec3::Zero();
  double votes = 0;
  for (const Index* it = around.begin(v); it != around.end(v); ++it) {
    const Faces::View face = mesh.faces[*it];
    const double area = vector_areas[*it].stableNorm();
    if (!(area > 0 && std::isfinite(area))) continue;
    const std::size_t corner = static_cast<std::size_t>(std::find(face.begin(), face.end(), v) - face.begin());
    const Vec3 a = mesh.vertices[face[(corner + 1) % face.size()]] - mesh.vertices[v];
    const Vec3 b = mesh.vertices[face[(corner + face.size() - 1) % face.size()]] - mesh.vertices[v];
    const double vote = mesh.weight(*it) * corner_weight(weights, a, b, area);
    sum += vote * (vector_areas[*it] / area);
    votes += vote;
  }
  return sum.stableNorm() <= kCancelled * votes ? Vec3(Vec3::Zero()) : unit_or_zero(sum);
}

Vec3 averaged(const Normals& from, const Adjacency& near, Index v) {
  const Vec3& own = from[v];
  if (!is_finite(own) || own.isZero(0)) return own;
  Vec3 sum = own;
  double votes = own.stableNorm();
  for (const Index* it = near.begin(v); it != near.end(v); ++it) {
    if (!is_finite(from[*it])) continue;
    sum += from[*it];
    votes += from[*it].stableNorm();
  }
  return sum.stableNorm() <= kCancelled * votes ? own : unit_or_zero(sum);
}

/// What `change` makes of each normal.
template <class Change>
Normals changed(const Normals& normals, const Execution& run, const Change& change) {
  Normals result(normals.size());
  parallel_for(normals.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) result[i] = change(normals[i]);
  });
  return result;
}

}  // namespace

const std::vector<Named<NormalWeights>>& names_of(NormalWeights) {
  static const std::vector<Named<NormalWeights>> names = {
      {NormalWeights::Uniform, "geometric", "every face counts as much"},
      {NormalWeights::Area, "area", "by the area of the face"},
      {NormalWeights::Angle, "angle", "by the angle of the face at the vertex"},
      {NormalWeights::Max, "max", "exact on spheres"},
  };
  return names;
}

Vec3 polygon_vector_area(const Mesh& mesh, std::size_t face) {
  const Faces::View corners = mesh.faces[face];
  const Vec3& first = mesh.vertices[corners[0]];
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (mesh.vertices[corners[i]] - first).cross(mesh.vertices[corners[i + 1]] - first);
  return 0.5 * sum;
}

Normals vertex_normals(const Mesh& mesh, NormalWeights weights, const Execution& run) {
  validate(mesh, stage(run, 0.0, 0.05));
  std::vector<Vec3> vector_areas(mesh.faces.size());
  parallel_for(mesh.faces.size(), kBlock, stage(run, 0.05, 0.3), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t f = begin; f < end; ++f) vector_areas[f] = polygon_vector_area(mesh, f);
  });
  const Adjacency around = faces_of_vertices(mesh, stage(run, 0.3, 0.5));
  Normals normals(mesh.vertices.size());
  parallel_for(normals.size(), kBlock, stage(run, 0.5, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t v = begin; v < end; ++v)
      normals[v] = vertex_normal(mesh, vector_areas, around, static_cast<Index>(v), weights);
  });
  return normals;
}

Normals average_normals(const Mesh& mesh, const Normals& normals, int passes, const Execution& run) {
  if (passes < 0)
    throw Error(ErrorCode::InvalidArgument, "averaging passes = " + std::to_string(passes) + ": give 0 or more");
  check_one_each(normals.size(), "normal", mesh.vertices.size(), "vertex");
  validate(mesh, stage(run, 0.0, 0.05));
  Normals from = normals;
  if (passes == 0) return from;
  const Adjacency near = vertex_neighbours(mesh, stage(run, 0.05, 0.4));
  Normals to(normals.size());
  const Execution rest = stage(run, 0.4, 1.0);
  for (int pass = 0; pass < passes; ++pass) {
    const Execution part = stage(rest, static_cast<double>(pass) / passes, static_cast<double>(pass + 1) / passes);
    parallel_for(to.size(), kBlock, part, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t v = begin; v < end; ++v) to[v] = averaged(from, near, static_cast<Index>(v));
    });
    std::swap(from, to);
  }
  return from;
}

Normals normalised(const Normals& normals, const Execution& run) {
  return changed(normals, run, unit_or_zero);
}

Normals flipped(const Normals& normals, const Execution& run) {
  return changed(normals, run, [](const Vec3& u) { return Vec3(-u); });
}

}  // namespace kappa
