// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/orders.hpp"
#include "thinning.hpp"

namespace kappa {

/// Rungs in a factor sqrt(2), by which the balls of an order and the estimates that are compared differ.
inline constexpr std::size_t kStep = 2;

/// The graph of the vertices and the edge of the even triangulation that has their area.
struct Surroundings {
  Adjacency neighbours;
  std::vector<double> spacing;  ///< 0 for a vertex in no face
  double typical_spacing = kNaN;
};

Surroundings surroundings(const BallSum& balls, const Execution& run);

/// Points whose scales are chosen.
struct Points {
  std::vector<Vec3> x;
  const Normals& u;
  std::vector<double> spacing;
  double typical_spacing;

  std::size_t size() const { return x.size(); }
};

Points points_of(const Triangles& t, const Normals& u, const Surroundings& around);

/// What the scale is chosen by: the second form (11, 12, 22) and the mean; NaN where a ball gives none.
using Ratios = std::array<double, 4>;

/// The rungs of the ladder, each measured at the points of the coarsest level that are dense enough for it.
class Ladder {
 public:
  Ladder(std::vector<double> radii, const std::vector<ThinnedGraph>& levels, const Points& points);

  std::size_t size() const { return radii_.size(); }
  double radius(std::size_t rung) const { return radii_[rung]; }
  const std::vector<double>& radii() const { return radii_; }
  std::size_t level_of(std::size_t rung) const { return level_of_rung_[rung]; }
  const ThinnedGraph& level(std::size_t l) const { return levels_[l]; }
  std::size_t points() const { return points_.size(); }

  /// Passes that average over a neighbourhood as wide as `radius` at a level.
  int passes(std::size_t level, double radius) const;

  /// Measures some more rungs, from `begin` on, of one level; returns the end of them.
  std::size_t measure(const BallSum& balls, BallDefinition ball, std::size_t begin, const Execution& run);

  /// The estimate of an order whose smallest ball is on rung `finest`, at `place` of a level that all its rungs have.
  Ratios estimate(int order, std::size_t finest, std::size_t l, std::size_t place) const;

 private:
  const std::vector<ThinnedGraph>& levels_;
  const Points& points_;
  std::vector<double> radii_, spacings_;
  std::vector<std::size_t> level_of_rung_;
  std::vector<std::vector<Ratios>> at_;  ///< of each rung at the points of its level
};

}  // namespace kappa
