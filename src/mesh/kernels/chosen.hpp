// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "faces.hpp"
#include "leaf.hpp"

// Triangles that a search has chosen, without a tree. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// 8 triangles that a search has chosen.
struct ChosenLeaf {
  ChosenCorners leaf;
  VD triangles[2];
};

/// Lanes that hold nothing are infinitely far.
inline void gather(const TriangleView& triangles, const std::uint32_t* chosen, std::size_t count, ChosenLeaf& to) {
  std::uint64_t ids[kWidth];
  for (std::size_t lane = 0; lane < kWidth; ++lane) ids[lane] = chosen[lane < count ? lane : 0];
  for (std::size_t part = 0; part < 2; ++part) {
    const std::size_t at = 4 * part;
    const auto corners = [&](std::size_t lane) { return triangles.corners + 3 * ids[at + lane]; };
    const Corners<VD> x = gathered(triangles.positions, {corners(0), corners(1), corners(2), corners(3)});
    const VD present = VD{0, 1, 2, 3} + spread(static_cast<double>(at));
    const MD here = present < spread(static_cast<double>(count));
    const Vector3<VD> rows[3] = {x.x0, x.x1, x.x2};
    for (int corner = 0; corner < 3; ++corner) {
      const VD axes[3] = {rows[corner].x, rows[corner].y, rows[corner].z};
      for (int axis = 0; axis < 3; ++axis)
        store(to.leaf.x[3 * corner + axis] + at, select(here, axes[axis], spread(__builtin_inf())));
    }
    to.triangles[part] = load<VD>(ids + at);
  }
}

inline void add_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius,
                       const std::uint32_t* chosen, std::size_t count) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  ChosenLeaf c;
  for (std::size_t begin = 0; begin < count; begin += kWidth) {
    gather(triangles, chosen + begin, count - begin, c);
    for (int part = 0; part < 2; ++part) {
      Placed<double> p;
      place(c.leaf, 4 * part, query.centre, p);
      add_placed(rim, c.leaf, p, c.triangles[part]);
    }
  }
}

inline void finish_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius) {
  finish_rim(Rim<double>{triangles, query, radius, query.balls[radius]});
}

}  // namespace
}  // namespace kappa::kernels
