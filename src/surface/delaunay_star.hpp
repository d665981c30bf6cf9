// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// Computes stars of Delaunay triangulations in the plane, reusing its memory.
class DelaunayStar {
 public:
  /// A point around the origin. `weight` is a squared length, small beside the squared distances, that must be a
  /// function of the point alone: it decides between triangulations of (nearly) cocircular points, alike in every star
  /// that the points take part in.
  struct Neighbour {
    Vec2 position;
    double weight;
  };

  /// Triangles (origin, a, b), counter-clockwise, of the weighted Delaunay triangulation of the origin and
  /// `neighbours`, as pairs of indices in the order of their direction. Only those whose circumcentre lies within
  /// `reach` of the origin. Neighbours at the origin are passed over.
  const std::vector<std::pair<int, int>>& compute(const std::vector<Neighbour>& neighbours, double own_weight,
                                                  double reach);

  /// The same after compute with the neighbours before `first`, which are not looked at again.
  const std::vector<std::pair<int, int>>& extend(const std::vector<Neighbour>& neighbours, std::size_t first,
                                                 double own_weight, double reach);

  /// Radius of the last Voronoi cell around the origin, at most `reach`. Points farther than twice this take no part
  /// in the star.
  double cell_radius() const { return cell_radius_; }

 private:
  /// A corner of the Voronoi cell of the origin with the neighbour whose bisector leaves it, -1 for none.
  struct Corner {
    Vec2 position;
    int bisector;
  };
  void clip(const Vec2& normal, double offset, int bisector);
  void make_room(std::size_t corners);

  std::vector<Corner> cell_, clipped_;  ///< with room for more
  std::size_t corners_ = 0;             ///< of the cell
  double radius_sq_ = 0;                ///< of the cell
  std::vector<double> distances_;       ///< of the corners from the last bisector
  std::vector<std::pair<int, int>> triangles_;
  double cell_radius_ = 0;
};

}  // namespace kappa
