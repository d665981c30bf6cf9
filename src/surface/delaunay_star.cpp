// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay_star.hpp"

#include <algorithm>
#include <cmath>

namespace kappa {

void DelaunayStar::clip(const Vec2& normal, double offset, int bisector) {
  double farthest = -1;
  for (std::size_t i = 0; i < corners_; ++i) {
    distances_[i] = normal.dot(cell_[i].position) - offset;
    farthest = std::max(farthest, distances_[i]);
  }
  if (farthest <= 0) return;
  make_room(2 * corners_);
  // In registers: members would be written and read again for each corner.
  const Corner* const cell = cell_.data();
  const double* const distances = distances_.data();
  const std::size_t corners = corners_;
  Corner* to = clipped_.data();
  double radius_sq = 0;
  const auto add = [&](const Corner& corner) {
    *to++ = corner;
    radius_sq = std::max(radius_sq, corner.position.squaredNorm());
  };
  for (std::size_t i = 0; i < corners; ++i) {
    const std::size_t next = i + 1 < corners ? i + 1 : 0;
    const Corner &from = cell[i], &at_next = cell[next];
    const double d_from = distances[i], d_to = distances[next];
    if (d_from <= 0) add(from);
    if ((d_from <= 0) == (d_to <= 0)) continue;
    const Vec2 cut = from.position + d_from / (d_from - d_to) * (at_next.position - from.position);
    // Leaving the half-plane, the cell goes on along the new bisector; entering, along the old side.
    add({cut, d_from <= 0 ? bisector : from.bisector});
  }
  corners_ = static_cast<std::size_t>(to - clipped_.data());
  radius_sq_ = radius_sq;
  std::swap(cell_, clipped_);
}

void DelaunayStar::make_room(std::size_t corners) {
  if (distances_.size() >= corners) return;
  distances_.resize(2 * corners);
  cell_.resize(2 * corners);
  clipped_.resize(2 * corners);
}

const std::vector<std::pair<int, int>>& DelaunayStar::compute(const std::vector<Neighbour>& neighbours,
                                                              double own_weight, double reach) {
  make_room(4);
  const double x[4] = {-reach, reach, reach, -reach}, y[4] = {-reach, -reach, reach, reach};
  for (std::size_t i = 0; i < 4; ++i) cell_[i] = {{x[i], y[i]}, -1};
  corners_ = 4;
  radius_sq_ = 2 * reach * reach;
  return extend(neighbours, 0, own_weight, reach);
}

const std::vector<std::pair<int, int>>& DelaunayStar::extend(const std::vector<Neighbour>& neighbours,
                                                             std::size_t first, double own_weight, double reach) {
  constexpr double kSamePlace = 1e-12, kBeyond = 1 + 1e-12;
  for (std::size_t i = first; i < neighbours.size() && corners_ > 2; ++i) {
    const Vec2& q = neighbours[i].position;
    const double distance_sq = q.squaredNorm(), offset = 0.5 * (distance_sq + own_weight - neighbours[i].weight);
    if (distance_sq <= kSamePlace * reach * reach) continue;
    // Most bisectors but those of the nearest pass by the whole cell.
    if (offset > 0 && offset * offset > kBeyond * distance_sq * radius_sq_) continue;
    clip(q, offset, static_cast<int>(i));
  }
  triangles_.clear();
  int a = corners_ > 0 ? cell_[corners_ - 1].bisector : -1;
  for (std::size_t i = 0; i < corners_; ++i) {
    const int b = cell_[i].bisector;
    if (a >= 0 && b >= 0 && a != b && cell_[i].position.squaredNorm() <= reach * reach) triangles_.emplace_back(a, b);
    a = b;
  }
  cell_radius_ = std::min(std::sqrt(radius_sq_), reach);
  return triangles_;
}

}  // namespace kappa
