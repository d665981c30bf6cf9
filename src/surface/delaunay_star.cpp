// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay_star.hpp"

#include <algorithm>
#include <cmath>

namespace kappa {

void DelaunayStar::clip(const Vec2& normal, double offset, int bisector) {
  const std::size_t size = cell_.size();
  distances_.resize(size);
  double farthest = -1;
  for (std::size_t i = 0; i < size; ++i) {
    distances_[i] = normal.dot(cell_[i].position) - offset;
    farthest = std::max(farthest, distances_[i]);
  }
  if (farthest <= 0) return;  // as with most neighbours but the nearest
  clipped_.clear();
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t next = i + 1 < size ? i + 1 : 0;
    const Corner &from = cell_[i], &to = cell_[next];
    const double d_from = distances_[i], d_to = distances_[next];
    if (d_from <= 0) clipped_.push_back(from);
    if ((d_from <= 0) == (d_to <= 0)) continue;
    const Vec2 cut = from.position + d_from / (d_from - d_to) * (to.position - from.position);
    // Leaving the half-plane, the cell goes on along the new bisector; entering, along the old side.
    clipped_.push_back({cut, d_from <= 0 ? bisector : from.bisector});
  }
  std::swap(cell_, clipped_);
}

const std::vector<std::pair<int, int>>& DelaunayStar::compute(const std::vector<Neighbour>& neighbours,
                                                              double own_weight, double reach) {
  cell_ = {{{-reach, -reach}, -1}, {{reach, -reach}, -1}, {{reach, reach}, -1}, {{-reach, reach}, -1}};
  return extend(neighbours, 0, own_weight, reach);
}

const std::vector<std::pair<int, int>>& DelaunayStar::extend(const std::vector<Neighbour>& neighbours,
                                                             std::size_t first, double own_weight, double reach) {
  triangles_.clear();
  for (std::size_t i = first; i < neighbours.size() && cell_.size() > 2; ++i) {
    const Vec2& q = neighbours[i].position;
    const double distance_sq = q.squaredNorm();
    constexpr double kSamePlace = 1e-12;
    if (distance_sq <= kSamePlace * reach * reach) continue;
    clip(q, 0.5 * (distance_sq + own_weight - neighbours[i].weight), static_cast<int>(i));
  }
  double radius_sq = 0;
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    const int a = cell_[(i + cell_.size() - 1) % cell_.size()].bisector, b = cell_[i].bisector;
    const double distance_sq = cell_[i].position.squaredNorm();
    radius_sq = std::max(radius_sq, distance_sq);
    if (a >= 0 && b >= 0 && a != b && distance_sq <= reach * reach) triangles_.emplace_back(a, b);
  }
  cell_radius_ = std::min(std::sqrt(radius_sq), reach);
  return triangles_;
}

}  // namespace kappa
