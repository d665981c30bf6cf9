// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// FLANN's single kd-tree over finite points, in double; the only class that sees FLANN. Thread-safe queries.
/// Answers are indices into the points; the order of within() depends on the points alone.
class KdTree {
 public:
  explicit KdTree(const std::vector<Vec3>& points);
  ~KdTree();
  KdTree(const KdTree&) = delete;
  KdTree& operator=(const KdTree&) = delete;

  /// By increasing distance.
  void nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices, std::vector<double>& distances_sq) const;
  /// Unsorted.
  void within(const Vec3& query, double radius, std::vector<Index>& indices, std::vector<double>& distances_sq) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kappa
