// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// Exact nearest-neighbour and radius search among points, in double (FLANN's single kd-tree).
/// Queries are thread-safe. Points that are not finite are never found.
class NeighbourSearch {
 public:
  explicit NeighbourSearch(const std::vector<Vec3>& points);
  ~NeighbourSearch();
  NeighbourSearch(NeighbourSearch&&) noexcept;
  NeighbourSearch& operator=(NeighbourSearch&&) noexcept;

  /// Number of points that can be found.
  std::size_t size() const;

  /// The (up to) `k` nearest points, by increasing distance, with the squared distances.
  void nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices, std::vector<double>& distances_sq) const;

  /// All points within `radius` (closed ball), in no particular but in a fixed order.
  void within(const Vec3& query, double radius, std::vector<Index>& indices, std::vector<double>& distances_sq) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Median distance to the nearest other point of different position, over a fixed sample of the
/// points; NaN if there are fewer than two positions.
double median_spacing(const std::vector<Vec3>& points);

}  // namespace kappa
