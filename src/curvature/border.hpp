// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "box_tree.hpp"
#include "kappa/balls/ball_sum.hpp"

namespace kappa {

/// An edge where faces end.
struct BorderEdge {
  Vec3 from, to;
  Vec3 outward;  ///< unit, in the face and perpendicular to the edge, times the weight that ends here
};

/// The edges of a surface, of whatever weights and topology, at which it ends. Edges in between, where the weights of
/// the faces on both sides balance, are none; nor are the small imbalances that the faces of a cloud have, whose stars
/// disagree. Surfaces of refined faces tell none.
std::vector<BorderEdge> border_edges(const Triangles& triangles, const Execution& run);

/// Whether the triangles are those of `refined_triangles`.
bool is_refined(const Triangles& triangles);

/// Tells where the part of a surface in a ball lies.
class Border {
 public:
  Border(const Triangles& triangles, const Execution& run);

  /// False for a closed surface.
  bool exists() const { return !edges_.empty(); }

  /// Whether an edge (its box) lies within `distance` of `x`.
  bool is_near(const Vec3& x, double distance) const;

  /// Where the centroid of the surface in a ball is, seen from the centre of the ball, `area` being that of the surface
  /// in it; zero if no border is. Exact for a plane, to the second order of radius x curvature for other surfaces: the
  /// tangential field x - c is the gradient of (|x - c|^2 - radius^2) / 2, which vanishes on the sphere, so that its
  /// integral over the faces is one over the border alone (Gauss).
  Vec3 centroid(const Vec3& centre, double radius, double area) const;

 private:
  std::vector<BorderEdge> edges_;
  BoxTree tree_;
};

}  // namespace kappa
