// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/splitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "edge_curve.hpp"
#include "kappa/balls/measure_options.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;

/// The points of a triangle at barycentric coordinates (side - i - j, i, j) / side, i + j <= side.
class Patch {
 public:
  explicit Patch(int levels) : side_(std::size_t{1} << levels), points_((side_ + 1) * (side_ + 2) / 2) {}

  void fill(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
    at(0, 0) = a;
    at(side_, 0) = b;
    at(0, side_) = c;
    for (std::size_t step = side_; step > 1; step /= 2) add_midpoints(step);
  }

  std::size_t side() const { return side_; }
  const std::vector<CurvePoint>& points() const { return points_; }

  /// Place of a point in points().
  std::size_t place(std::size_t i, std::size_t j) const { return (j * (2 * side_ + 3 - j)) / 2 + i; }

 private:
  CurvePoint& at(std::size_t i, std::size_t j) { return points_[place(i, j)]; }

  void add_midpoints(std::size_t step) {
    const std::size_t half = step / 2;
    for (std::size_t j = 0; j < side_; j += step) {
      for (std::size_t i = 0; i + j < side_; i += step) {
        at(i + half, j) = curved_midpoint(at(i, j), at(i + step, j));
        at(i, j + half) = curved_midpoint(at(i, j), at(i, j + step));
        at(i + half, j + half) = curved_midpoint(at(i + step, j), at(i, j + step));
      }
    }
  }

  std::size_t side_;
  std::vector<CurvePoint> points_;
};

CurvePoint corner_of(const Triangles& t, const ShapeOperators& shapes, Index v) {
  return {t.x[v], t.u[v].normalized(), shapes[v]};
}

/// Splits the triangles of `from` into slots of `to`, each triangle its own.
class Refiner {
 public:
  Refiner(const Triangles& from, const ShapeOperators& shapes, int levels, Triangles& to)
      : from_(from), shapes_(shapes), to_(to), levels_(levels), parts_(std::size_t{1} << (2 * levels)) {
    const std::size_t side = std::size_t{1} << levels;
    added_points_ = (side + 1) * (side + 2) / 2 - 3;
  }

  std::size_t parts() const { return parts_; }
  std::size_t added_points() const { return added_points_; }

  void split(std::size_t begin, std::size_t end) {
    Patch patch(levels_);
    std::vector<Index> names(patch.points().size());
    for (std::size_t t = begin; t < end; ++t) {
      const auto& c = from_.corners[t];
      const auto corner = [&](Index v) { return corner_of(from_, shapes_, v); };
      patch.fill(corner(c[0]), corner(c[1]), corner(c[2]));
      store_points(patch, t, names);
      store_parts(patch, t, names);
    }
  }

 private:
  void store_points(const Patch& patch, std::size_t t, std::vector<Index>& names) {
    std::size_t next = from_.x.size() + t * added_points_;
    const std::array<std::size_t, 3> corner = {patch.place(0, 0), patch.place(patch.side(), 0),
                                               patch.place(0, patch.side())};
    for (std::size_t p = 0; p < names.size(); ++p) {
      const auto is = std::find(corner.begin(), corner.end(), p);
      if (is != corner.end()) {
        names[p] = from_.corners[t][static_cast<std::size_t>(is - corner.begin())];
        continue;
      }
      names[p] = static_cast<Index>(next);
      to_.x[next] = patch.points()[p].x;
      to_.u[next] = patch.points()[p].u;
      ++next;
    }
  }

  /// Of a face, each vertex of the mesh must be the first corner of one part (see Triangles::corners): of a
  /// triangle all three, of a part of a polygon the first one alone.
  void store_parts(const Patch& patch, std::size_t t, const std::vector<Index>& names) {
    const bool whole_face = from_.corners[t][2] < from_.vertices;
    const std::size_t last = patch.side() - 1;
    std::size_t next = t * parts_;
    const auto store = [&](std::size_t i0, std::size_t j0, std::size_t i1, std::size_t j1, std::size_t i2,
                           std::size_t j2) {
      to_.corners[next] = {names[patch.place(i0, j0)], names[patch.place(i1, j1)], names[patch.place(i2, j2)]};
      if (!to_.weights.empty()) to_.weights[next] = from_.weights[t];
      to_.faces[next] = from_.faces[t];
      ++next;
    };
    for (std::size_t j = 0; j <= last; ++j) {
      for (std::size_t i = 0; i + j <= last; ++i) {
        if (whole_face && i == last && last > 0) {
          store(i + 1, j, i, j + 1, i, j);
        } else if (whole_face && j == last && last > 0) {
          store(i, j + 1, i, j, i + 1, j);
        } else {
          store(i, j, i + 1, j, i, j + 1);
        }
        if (i + j < last) store(i + 1, j, i + 1, j + 1, i, j + 1);
      }
    }
  }

  const Triangles& from_;
  const ShapeOperators& shapes_;
  Triangles& to_;
  int levels_;
  std::size_t parts_, added_points_;
};

/// Moves the barycentres of polygons to the surface, with the normals and shape operators there.
void lift_barycentres(Triangles& t, ShapeOperators& shapes) {
  shapes.resize(t.x.size());
  std::vector<CurvePoint> corners;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Index centre = t.corners[i][2];
    if (centre < t.vertices) continue;
    corners.push_back(corner_of(t, shapes, t.corners[i][0]));
    if (i + 1 < t.size() && t.corners[i + 1][2] == centre) continue;
    const CurvePoint lifted = curved_centre(std::move(corners));
    t.x[centre] = lifted.x;
    t.u[centre] = lifted.u;
    shapes[centre] = lifted.shape;
    corners.clear();
  }
}

Triangles refined(Triangles coarse, ShapeOperators shapes, int levels, const Execution& run) {
  lift_barycentres(coarse, shapes);
  Triangles fine;
  Refiner refiner(coarse, shapes, levels, fine);
  fine.vertices = coarse.vertices;
  fine.dropped_faces = coarse.dropped_faces;
  fine.x = coarse.x;
  fine.u = coarse.u;
  fine.x.resize(coarse.x.size() + coarse.size() * refiner.added_points());
  fine.u.resize(fine.x.size());
  fine.corners.resize(coarse.size() * refiner.parts());
  fine.weights.resize(coarse.weights.empty() ? 0 : fine.corners.size());
  fine.faces.resize(fine.corners.size());
  parallel_for(coarse.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) { refiner.split(begin, end); });
  return fine;
}

}  // namespace

void check_refinement(int levels, std::size_t triangles) {
  check_range("refine", levels, 0, kMostRefinements, "the times that a face is split in four");
  constexpr std::size_t kMost = std::size_t{1} << 31;
  if ((triangles << (2 * levels)) >= kMost)
    throw Error(ErrorCode::InvalidArgument, "refine = " + std::to_string(levels) + " makes " +
                                                std::to_string(triangles << (2 * levels)) +
                                                " triangles, more than 2^31 - 1: give less");
}

Triangles refined_triangles(const Mesh& mesh, const Normals& normals, const ShapeOperators& shapes, int levels,
                            const Execution& run) {
  check_refinement(levels, mesh.faces.corners().size());
  check_one_each(shapes.size(), "shape operator", mesh.vertices.size(), "vertex");
  Triangles coarse = triangles_of(mesh, normals, QuadMeasures::Split, stage(run, 0, 0.2));
  return levels == 0 ? coarse : refined(std::move(coarse), shapes, levels, stage(run, 0.2, 1));
}

double normal_roughness(const Mesh& mesh, const Normals& normals, const Execution& run) {
  constexpr double kLeastTurn = 1e-6;
  constexpr std::size_t kMany = 65536;
  std::vector<double> ratios;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (f % kMany == 0) check_cancelled(run);
    const Faces::View face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index a = face[i], b = face[(i + 1) % face.size()];
      const Vec3 e = mesh.vertices[b] - mesh.vertices[a];
      const double turn = e.norm() * (normals[b] - normals[a]).norm();
      if (turn > kLeastTurn * e.norm()) ratios.push_back(std::abs(e.dot(normals[a] + normals[b])) / turn);
    }
  }
  return percentile(ratios, 50);
}

}  // namespace kappa
