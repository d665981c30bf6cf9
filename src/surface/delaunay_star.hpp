// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// Computes stars of Delaunay triangulations in the plane, reusing its memory.
class DelaunayStar {
 public:
  /// A point around the origin. `tie_break` in [-1, 1] must be a function of the point alone: it decides
  /// between triangulations of (nearly) cocircular points, alike in every star that the points take part in.
  struct Neighbour {
    Vec2 position;
    double tie_break;
  };

  /// Triangles (origin, a, b), counter-clockwise, of the Delaunay triangulation of the origin and `neighbours`,
  /// as pairs of indices in the order of their direction. Only those whose circumcentre lies within `reach` of
  /// the origin. Neighbours are given by increasing distance; those at the origin are passed over.
  const std::vector<std::pair<int, int>>& compute(const std::vector<Neighbour>& neighbours, double own_tie_break,
                                                  double reach);

 private:
  /// A corner of the Voronoi cell of the origin with the neighbour whose bisector leaves it, -1 for none.
  struct Corner {
    Vec2 position;
    int bisector;
  };
  void clip(const Vec2& normal, double offset, int bisector);

  std::vector<Corner> cell_, clipped_;
  std::vector<std::pair<int, int>> triangles_;
};

}  // namespace kappa
