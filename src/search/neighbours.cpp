// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kd_tree.hpp"

namespace kappa {

/// FLANN answers in the order of the points it was given: sorted along a curve, which makes queries twice as fast.
struct NeighbourSearch::Impl {
  std::vector<Index> original;  ///< index of the point that the tree calls i
  std::unique_ptr<KdTree> tree;

  explicit Impl(const std::vector<Vec3>& points) {
    original = spatial_order(points);
    while (!original.empty() && !is_finite(points[original.back()])) original.pop_back();
    std::vector<Vec3> sorted(original.size());
    std::transform(original.begin(), original.end(), sorted.begin(), [&](Index i) { return points[i]; });
    tree = std::make_unique<KdTree>(sorted);
  }

  void to_original(std::vector<Index>& indices) const {
    for (Index& i : indices) i = original[i];
  }
};

NeighbourSearch::NeighbourSearch(const std::vector<Vec3>& points) : impl_(std::make_unique<Impl>(points)) {}
NeighbourSearch::~NeighbourSearch() = default;
NeighbourSearch::NeighbourSearch(NeighbourSearch&&) noexcept = default;
NeighbourSearch& NeighbourSearch::operator=(NeighbourSearch&&) noexcept = default;

std::size_t NeighbourSearch::size() const {
  return impl_->original.size();
}

void NeighbourSearch::nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices,
                              std::vector<double>& distances_sq) const {
  impl_->tree->nearest(query, k, indices, distances_sq);
  impl_->to_original(indices);
}

void NeighbourSearch::within(const Vec3& query, double radius, std::vector<Index>& indices,
                             std::vector<double>& distances_sq) const {
  impl_->tree->within(query, radius, indices, distances_sq);
  impl_->to_original(indices);
}

double median_spacing(const std::vector<Vec3>& points) {
  constexpr std::size_t kSample = 2000;
  const NeighbourSearch search(points);
  std::vector<double> spacings, distances_sq;
  std::vector<Index> indices;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kSample);
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (!is_finite(points[i])) continue;
    // Exact duplicates are no neighbours: widen the search until another position is found.
    for (std::size_t k = 2;; k *= 2) {
      search.nearest(points[i], k, indices, distances_sq);
      const auto other = std::find_if(distances_sq.begin(), distances_sq.end(), [](double d) { return d > 0; });
      if (other != distances_sq.end()) spacings.push_back(std::sqrt(*other));
      if (other != distances_sq.end() || k >= search.size()) break;
    }
  }
  return percentile(spacings, 50);
}

}  // namespace kappa
