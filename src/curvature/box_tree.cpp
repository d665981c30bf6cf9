// SPDX-License-Identifier: BSD-3-Clause
#include "box_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include "kappa/core/bounds.hpp"

namespace kappa {
namespace {

constexpr std::size_t kLeaf = 6;

void extend(Bounds& box, const Bounds& other) {
  box.min = box.min.cwiseMin(other.min);
  box.max = box.max.cwiseMax(other.max);
}

}  // namespace

BoxTree::BoxTree(const std::vector<Bounds>& boxes) : indices_(boxes.size()) {
  std::iota(indices_.begin(), indices_.end(), Index{0});
  if (!boxes.empty()) build(0, boxes.size(), boxes);
  boxes_.reserve(boxes.size());
  for (const Index i : indices_) boxes_.push_back(boxes[i]);
}

void BoxTree::build(std::size_t begin, std::size_t end, const std::vector<Bounds>& boxes) {
  const std::size_t n = nodes_.size();
  nodes_.emplace_back();
  Bounds box;
  for (std::size_t i = begin; i < end; ++i) extend(box, boxes[indices_[i]]);
  nodes_[n].box = box;
  if (end - begin <= kLeaf) {
    nodes_[n].begin = begin;
    nodes_[n].end = end;
  } else {
    Eigen::Index axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    const auto key = [&](Index i) { return std::pair(boxes[i].min[axis] + boxes[i].max[axis], i); };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return indices_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) { return key(a) < key(b); });
    build(begin, middle, boxes);
    build(middle, end, boxes);
  }
  nodes_[n].after = nodes_.size();
}

}  // namespace kappa
