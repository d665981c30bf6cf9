// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "leaf.hpp"

// Triangles that a search has chosen, without a tree. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// 8 triangles that a search has chosen.
struct ChosenLeaf {
  Leaf<double> leaf;
  VD triangles[2];
  unsigned faces;
};

/// Lanes that hold nothing are infinitely far.
inline void gather(const TriangleView& triangles, const std::uint32_t* chosen, std::size_t count, ChosenLeaf& to) {
  constexpr double kInfinity = __builtin_inf();
  std::uint64_t ids[kWidth] = {};
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    if (lane < count) ids[lane] = chosen[lane];
    const std::uint32_t* const corners = triangles.corners + 3 * ids[lane];
    for (int corner = 0; corner < 3; ++corner) {
      const double* const x = triangles.positions + 3 * std::size_t{corners[corner]};
      for (int axis = 0; axis < 3; ++axis) to.leaf.x[3 * corner + axis][lane] = lane < count ? x[axis] : kInfinity;
    }
  }
  to.triangles[0] = load<VD>(ids);
  to.triangles[1] = load<VD>(ids + 4);
  to.faces = count < kWidth ? static_cast<unsigned>(count) : kWidth;
}

inline void add_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius,
                       const std::uint32_t* chosen, std::size_t count) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  ChosenLeaf c;
  for (std::size_t begin = 0; begin < count; begin += kWidth) {
    gather(triangles, chosen + begin, count - begin, c);
    Placed<double> p[2];
    place(c.leaf, 0, query.centre, p[0]);
    place(c.leaf, 4, query.centre, p[1]);
    add_leaf_to(rim, c.leaf, p, c.triangles, nullptr, c.faces);
  }
}

inline void finish_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius) {
  finish_rim(Rim<double>{triangles, query, radius, query.balls[radius]});
}

}  // namespace
}  // namespace kappa::kernels
