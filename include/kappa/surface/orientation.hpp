// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Which points count as neighbours when signs of normals are compared.
struct NeighbourGraphOptions {
  int neighbours = 10;  ///< nearest points of different position each point is joined to, 1 to 255
};

/// How well the signs of normals agree.
struct NormalAgreement {
  std::size_t pairs = 0;    ///< of neighbours, each once
  std::size_t opposed = 0;  ///< those whose normals lie more than 120 degrees apart
  /// Share of opposed pairs, 0 if there is no pair. A few per cent come from sharp edges and from walls sampled on
  /// both sides; random signs give nearly one half.
  double opposed_share() const { return pairs == 0 ? 0.0 : static_cast<double>(opposed) / static_cast<double>(pairs); }
};

/// Share of opposed pairs from which a user should be warned that the normals have no consistent sign.
inline constexpr double kSuspiciousDisagreement = 0.05;

/// Compares the normals of all pairs of neighbours. Points that are not finite or have no normal are left out,
/// duplicates count once.
/// @throws Error InvalidArgument if sizes differ or the option is out of range.
NormalAgreement normal_agreement(const std::vector<Vec3>& points, const Normals& normals,
                                 const NeighbourGraphOptions& options = {}, const Execution& run = {});

/// What `orient_consistently` did.
struct ConsistentOrientation {
  std::size_t parts = 0;      ///< connected components of the graph
  std::size_t turned = 0;     ///< normals whose sign changed
  NormalAgreement agreement;  ///< afterwards
};

/// Gives normals of arbitrary sign a consistent one: along the minimum spanning forest of the graph of nearest
/// neighbours (joined if either is among the nearest of the other) with weights 1 - |u.v|, neighbours point the same
/// way. What remains is one sign for each connected part, chosen so that its outermost points look outward: the
/// normals of its highest points (one per cent, at least one) must point up on the average; where those are nearly
/// vertical walls (average |z| below 0.3), the points farthest along x or y decide in the same way. So closed parts
/// are oriented outward and terrain upward; the inside of a room needs a viewpoint instead.
///
/// Deterministic: ties between edges are broken by the indices of their points. A duplicate points to the side of the
/// first point at its position. Points that are not finite or have no normal are left alone.
/// Cost: O(n k log(n k)) time, 20 k bytes a point.
/// @throws Error InvalidArgument if sizes differ or the option is out of range.
ConsistentOrientation orient_consistently(const std::vector<Vec3>& points, Normals& normals,
                                          const NeighbourGraphOptions& options = {}, const Execution& run = {});

}  // namespace kappa
