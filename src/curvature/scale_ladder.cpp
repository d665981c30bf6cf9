// SPDX-License-Identifier: BSD-3-Clause
#include "scale_ladder.hpp"

#include <algorithm>
#include <cmath>

#include "curvature_sample.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

/// Rungs that are measured at once; then it is looked whether any point goes on.
constexpr std::size_t kRungsAtOnce = 4;
/// A scale cannot change faster than it is large: changes are averaged over a neighbourhood as wide as the ball (passes
/// of averaging for a ball of one spacing), and a rung is measured at points that lie at most this part of it apart.
constexpr double kPassesOfSpacing = 2.5, kApart = 0.5;
/// At least so many passes where every point is measured: the changes of near points are all but independent.
constexpr double kLeastPasses = 24;
/// Least radius in spacings of the centre: a narrower ball sees one star, and no noise.
constexpr double kLeastSpacings = 0.7;
constexpr std::size_t kMany = 65536;  ///< triangles between two looks at whether to stop
constexpr Ratios kNone = {kNaN, kNaN, kNaN, kNaN};

struct FaceVertex {
  Index face, vertex;
  bool operator<(const FaceVertex& other) const {
    return face != other.face ? face < other.face : vertex < other.vertex;
  }
};

/// The vertices of the faces of the mesh, sorted; the triangles may stand in any order.
std::vector<FaceVertex> face_vertices(const Triangles& t, const std::vector<Index>& parts) {
  std::vector<FaceVertex> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Index face = t.faces[i];
    // Of a face in several parts each vertex is the first corner of one.
    const std::size_t corners = parts[face] > 1 ? 1 : 3;
    for (std::size_t c = 0; c < corners; ++c)
      if (t.corners[i][c] < t.vertices) all.push_back({face, t.corners[i][c]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

Surroundings surroundings(const BallSum& balls, const Execution& run) {
  const Triangles& t = balls.triangles();
  const std::vector<Index> parts = parts_of_faces(t);
  std::vector<double> face_areas(parts.size()), areas(t.vertices);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i % kMany == 0) check_cancelled(run);
    face_areas[t.faces[i]] += balls.measures_of(i).area;
  }
  const std::vector<FaceVertex> of_faces = face_vertices(t, parts);
  Mesh graph;
  graph.vertices.resize(t.vertices);
  std::vector<Index> face;
  for (auto next = of_faces.begin(); next != of_faces.end();) {
    const Index f = next->face;
    for (face.clear(); next != of_faces.end() && next->face == f; ++next) face.push_back(next->vertex);
    graph.faces.add(face);
    for (const Index v : face) areas[v] += face_areas[f] / static_cast<double>(face.size());
  }
  Surroundings s;
  s.neighbours = vertex_neighbours(graph);
  std::vector<double> positive;
  for (const double area : areas) {
    s.spacing.push_back(std::sqrt(area * 2 / std::sqrt(3.0)));
    if (area > 0) positive.push_back(s.spacing.back());
  }
  s.typical_spacing = percentile(positive, 50);
  return s;
}

Points points_of(const Triangles& t, const Normals& u, const Surroundings& around) {
  Points p{{}, u, around.spacing, around.typical_spacing};
  p.x.assign(t.x.begin(), t.x.begin() + static_cast<std::ptrdiff_t>(t.vertices));
  for (double& spacing : p.spacing) {
    if (!(spacing > 0)) spacing = around.typical_spacing;
  }
  return p;
}

Ladder::Ladder(std::vector<double> radii, const std::vector<ThinnedGraph>& levels, const Points& points)
    : levels_(levels), points_(points), radii_(std::move(radii)), at_(radii_.size()) {
  for (std::size_t level = 0; level < levels.size(); ++level)
    spacings_.push_back(points.typical_spacing *
                        std::sqrt(static_cast<double>(points.size()) / static_cast<double>(levels[level].size())));
  for (const double radius : radii_) {
    std::size_t level = 0;
    while (level + 1 < levels.size() && spacings_[level + 1] <= kApart * radius) ++level;
    level_of_rung_.push_back(level);
  }
}

int Ladder::passes(std::size_t level, double radius) const {
  const double least = kLeastPasses * std::pow(points_.typical_spacing / spacings_[level], 2);
  return static_cast<int>(std::ceil(std::max(least, kPassesOfSpacing * std::pow(radius / spacings_[level], 2))));
}

std::size_t Ladder::measure(const BallSum& balls, BallDefinition ball, std::size_t begin, const Execution& run) {
  const std::size_t l = level_of_rung_[begin];
  std::size_t end = begin + 1;
  while (end < size() && end < begin + kRungsAtOnce && level_of_rung_[end] == l) ++end;
  std::vector<Vec3> x;
  for (const Index i : levels_[l].points) x.push_back(points_.x[i]);
  for (std::size_t rung = begin; rung < end; ++rung) at_[rung].assign(x.size(), kNone);
  const std::vector<double> radii(radii_.begin() + static_cast<std::ptrdiff_t>(begin),
                                  radii_.begin() + static_cast<std::ptrdiff_t>(end));
  balls.sum(x, radii, ball, run, [&](std::size_t q, const BallMeasures* measures) {
    const Index i = levels_[l].points[q];
    if (!usable(x[q], points_.u[i])) return;
    for (std::size_t r = 0; r < radii.size(); ++r) {
      if (measures[r].face_count == 0 || radii[r] < kLeastSpacings * points_.spacing[i]) continue;
      const CurvatureRatios ratios = curvature_ratios(measures[r].sum, points_.u[i]);
      at_[begin + r][q] = {ratios.form[0], ratios.form[1], ratios.form[2], ratios.mean};
    }
  });
  return end;
}

Ratios Ladder::estimate(int order, std::size_t finest, std::size_t l, std::size_t place) const {
  std::array<CurvatureRatios, kMaxOrder> of_balls;
  for (int b = 0; b < order; ++b) {
    const std::size_t rung = finest + kStep * static_cast<std::size_t>(order - 1 - b);
    const Ratios& r = at_[rung][levels_[level_of_rung_[rung]].place_of(levels_[l], place)];
    if (std::isnan(r[0])) return kNone;
    of_balls[static_cast<std::size_t>(b)] = {r[3], 0, {r[0], r[1], r[2]}, PointStatus::Valid};
  }
  const CurvatureRatios e = extrapolate(of_balls.data(), order).ratios;
  return {e.form[0], e.form[1], e.form[2], e.mean};
}

}  // namespace kappa
