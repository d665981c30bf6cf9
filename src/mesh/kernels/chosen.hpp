// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "leaf.hpp"

// Triangles that a search has chosen, without a tree. Included by kernel files alone.

namespace kappa::kernels {
namespace {

inline void add_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius,
                       const std::uint32_t* chosen, std::size_t count) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  for (std::size_t begin = 0; begin < count; begin += kWidth) {
    const std::size_t left = count - begin, last = left < kWidth ? left - 1 : kWidth - 1;
    Leaf<double> leaf;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::size_t triangle = chosen[begin + (lane < last ? lane : last)];
      for (int corner = 0; corner < 3; ++corner) {
        const double* const x = triangles.positions + 3 * std::size_t{triangles.corners[3 * triangle + corner]};
        for (int axis = 0; axis < 3; ++axis) leaf.x[3 * corner + axis][lane] = x[axis];
      }
    }
    Placed<double> p;
    place(leaf, query.centre, p);
    add_placed(rim, p, (2U << last) - 1, nullptr, [at = chosen + begin](int lane) { return at[lane]; });
  }
}

inline void finish_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius) {
  finish_rim(Rim<double>{triangles, query, radius, query.balls[radius]});
}

}  // namespace
}  // namespace kappa::kernels
