// SPDX-License-Identifier: BSD-3-Clause
#include "border.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include "kappa/core/bounds.hpp"

namespace kappa {
namespace {

/// Edges opposite a vertex make a closed loop inside a surface, and at its border one that lacks two edges of six or
/// so. Where stars of a cloud disagree a third of an edge may be amiss.
constexpr double kOpen = 0.15;

constexpr std::size_t kMany = 65536;  ///< triangles between two looks at whether to stop

std::vector<char> border_vertices(const Triangles& t, const Execution& run) {
  struct Loop {
    Vec3 gap = Vec3::Zero();
    double length = 0;
  };
  std::vector<Loop> loops(t.x.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i % kMany == 0) check_cancelled(run);
    const auto& c = t.corners[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 opposite = t.weight(i) * (t.x[c[(k + 2) % 3]] - t.x[c[(k + 1) % 3]]);
      loops[c[k]].gap += opposite;
      loops[c[k]].length += opposite.norm();
    }
  }
  std::vector<char> flags(t.x.size());
  for (std::size_t v = 0; v < flags.size(); ++v) flags[v] = loops[v].gap.norm() > kOpen * loops[v].length;
  return flags;
}

/// An edge as one face has it.
struct Side {
  Index low, high;
  Vec3 outward;  ///< times the weight
  double turn;   ///< weight, negative if the face runs from high to low

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

void add_sides(const Triangles& t, std::size_t i, const std::vector<char>& at_border, std::vector<Side>& sides) {
  const auto& c = t.corners[i];
  for (std::size_t k = 0; k < 3; ++k) {
    const Index a = c[k], b = c[(k + 1) % 3];
    if (!at_border[a] || !at_border[b]) continue;
    const Vec3 edge = t.x[b] - t.x[a];
    const Vec3 outward = edge.cross(edge.cross(t.x[c[(k + 2) % 3]] - t.x[a]));
    const double length = outward.norm(), weight = t.weight(i);
    if (!(length > 0)) continue;
    sides.push_back({std::min(a, b), std::max(a, b), outward * (weight / length), a < b ? weight : -weight});
  }
}

std::vector<Side> sides_at_border(const Triangles& t, const Execution& run) {
  const std::vector<char> at_border = border_vertices(t, run);
  std::vector<Side> sides;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i % kMany == 0) check_cancelled(run);
    add_sides(t, i, at_border, sides);
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& a, const Side& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  return sides;
}

/// Integral of (radius^2 - |x - centre|^2) / 2 over the part of the edge in the ball.
double integral(const BorderEdge& edge, const Vec3& centre, double radius) {
  const Vec3 along = edge.to - edge.from, from = edge.from - centre;
  const double length = along.norm();
  if (!(length > 0)) return 0;
  const double start = from.dot(along) / length;
  const double half_chord_sq = radius * radius - (from.squaredNorm() - start * start);
  if (!(half_chord_sq > 0)) return 0;
  const double half_chord = std::sqrt(half_chord_sq);
  const double low = std::max(start, -half_chord), high = std::min(start + length, half_chord);
  if (!(high > low)) return 0;
  return 0.5 * (half_chord_sq * (high - low) - (high * high * high - low * low * low) / 3);
}

std::vector<Bounds> boxes_of(const std::vector<BorderEdge>& edges) {
  std::vector<Bounds> boxes;
  boxes.reserve(edges.size());
  for (const BorderEdge& e : edges) boxes.push_back({e.from.cwiseMin(e.to), e.from.cwiseMax(e.to)});
  return boxes;
}

}  // namespace

/// The patches of refined faces have points along common edges of their own, so that each looks like an island. Of the
/// parts of a polygon one corner alone is none of the mesh.
bool is_refined(const Triangles& t) {
  return std::any_of(t.corners.begin(), t.corners.end(), [&](const std::array<Index, 3>& c) {
    return std::count_if(c.begin(), c.end(), [&](Index i) { return i >= t.vertices; }) > 1;
  });
}

std::vector<BorderEdge> border_edges(const Triangles& triangles, const Execution& run) {
  if (is_refined(triangles)) return {};
  const std::vector<Side> sides = sides_at_border(triangles, run);
  const auto heaviest = std::max_element(triangles.weights.begin(), triangles.weights.end());
  const double least = 0.5 * (heaviest == triangles.weights.end() ? 1.0 : *heaviest);
  std::vector<BorderEdge> edges;
  for (std::size_t first = 0, end; first < sides.size(); first = end) {
    Vec3 outward = Vec3::Zero();
    double turn = 0;
    for (end = first; end < sides.size() && sides[end].same_edge(sides[first]); ++end) {
      outward += sides[end].outward;
      turn += sides[end].turn;
    }
    if (std::min(std::abs(turn), outward.norm()) > least)
      edges.push_back({triangles.x[sides[first].low], triangles.x[sides[first].high], outward});
  }
  return edges;
}

Border::Border(const Triangles& triangles, const Execution& run)
    : edges_(border_edges(triangles, run)), tree_(boxes_of(edges_)) {}

bool Border::is_near(const Vec3& x, double distance) const {
  return tree_.find(x, distance, [](Index) { return true; });
}

Vec3 Border::centroid(const Vec3& centre, double radius, double area) const {
  Vec3 moment = Vec3::Zero();
  tree_.find(centre, radius, [&](Index e) {
    moment -= integral(edges_[e], centre, radius) * edges_[e].outward;
    return false;
  });
  if (!(area > 0)) return Vec3::Zero();
  const Vec3 centroid = moment / area;
  const double distance = centroid.norm();
  return distance > radius ? (centroid * (radius / distance)).eval() : centroid;
}

}  // namespace kappa
