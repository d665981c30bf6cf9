// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay_star.hpp"

#include <algorithm>

namespace kappa {
namespace {

/// Size of the perturbation that breaks ties, relative to the squared reach: above what the different tangent planes of
/// a curved surface make of the corners of a grid cell (a part (spacing / radius)^2), below what matters for the shape
/// of triangles.
constexpr double kTieBreak = 2e-3;

}  // namespace

void DelaunayStar::clip(const Vec2& normal, double offset, int bisector) {
  clipped_.clear();
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    const Corner& from = cell_[i];
    const Corner& to = cell_[(i + 1) % cell_.size()];
    const double d_from = normal.dot(from.position) - offset, d_to = normal.dot(to.position) - offset;
    if (d_from <= 0) clipped_.push_back(from);
    if ((d_from <= 0) == (d_to <= 0)) continue;
    const Vec2 cut = from.position + d_from / (d_from - d_to) * (to.position - from.position);
    // Leaving the half-plane, the cell goes on along the new bisector; entering, along the old side.
    clipped_.push_back({cut, d_from <= 0 ? bisector : from.bisector});
  }
  std::swap(cell_, clipped_);
}

const std::vector<std::pair<int, int>>& DelaunayStar::compute(const std::vector<Neighbour>& neighbours,
                                                              double own_tie_break, double reach) {
  triangles_.clear();
  cell_ = {{{-reach, -reach}, -1}, {{reach, -reach}, -1}, {{reach, reach}, -1}, {{-reach, reach}, -1}};
  const double unit = kTieBreak * reach * reach;
  for (std::size_t i = 0; i < neighbours.size() && cell_.size() > 2; ++i) {
    const Vec2& q = neighbours[i].position;
    const double distance_sq = q.squaredNorm();
    constexpr double kSamePlace = 1e-12;
    if (distance_sq <= kSamePlace * reach * reach) continue;
    const double power = distance_sq + unit * (own_tie_break - neighbours[i].tie_break);
    clip(q, 0.5 * power, static_cast<int>(i));
  }
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    const int a = cell_[(i + cell_.size() - 1) % cell_.size()].bisector, b = cell_[i].bisector;
    if (a >= 0 && b >= 0 && a != b && cell_[i].position.squaredNorm() <= reach * reach) triangles_.emplace_back(a, b);
  }
  return triangles_;
}

}  // namespace kappa
