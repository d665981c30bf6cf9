// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/bounds.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// Boxes to be found by place. What is found comes in an order that the boxes alone decide.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Bounds>& boxes);

  bool empty() const { return nodes_.empty(); }

  /// Calls stop(index of a box) for those that lie within `radius` of `centre`, until it returns true; returns whether
  /// it did.
  template <class Stop>
  bool find(const Vec3& centre, double radius, Stop&& stop) const {
    const double radius_sq = radius * radius;
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (distance_sq(node.box, centre) > radius_sq) {
        n = node.after;
        continue;
      }
      for (std::size_t i = node.begin; i < node.end; ++i) {
        if (distance_sq(boxes_[i], centre) <= radius_sq && stop(indices_[i])) return true;
      }
      ++n;
    }
    return false;
  }

 private:
  /// In depth-first order; only leaves have items.
  struct Node {
    Bounds box;
    std::size_t begin = 0, end = 0;  ///< items
    std::size_t after = 0;           ///< first node that is not below this one
  };

  static double distance_sq(const Bounds& box, const Vec3& x) {
    return (box.min - x).cwiseMax(x - box.max).cwiseMax(0.0).squaredNorm();
  }

  void build(std::size_t begin, std::size_t end, const std::vector<Bounds>& boxes);

  std::vector<Node> nodes_;
  std::vector<Index> indices_;  ///< of the items, leaf by leaf
  std::vector<Bounds> boxes_;   ///< of the items
};

}  // namespace kappa
