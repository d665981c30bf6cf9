// SPDX-License-Identifier: BSD-3-Clause
#include "kd_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <flann/flann.hpp>

namespace kappa {
namespace {

using Distance = flann::L2_3D<double>;
constexpr int kLeafSize = 12;

/// Collects everything within a closed radius without sorting, straight into the caller's vectors.
class CollectWithin final : public flann::ResultSet<double> {
 public:
  CollectWithin(double radius_sq, std::vector<Index>& indices, std::vector<double>& distances_sq)
      : radius_sq_(radius_sq),
        beyond_(std::nextafter(radius_sq, std::numeric_limits<double>::infinity())),
        indices_(indices),
        distances_sq_(distances_sq) {}
  bool full() const override { return true; }
  void addPoint(double distance_sq, size_t index) override {
    if (distance_sq > radius_sq_) return;
    indices_.push_back(static_cast<Index>(index));
    distances_sq_.push_back(distance_sq);
  }
  // FLANN takes what is nearer than this; the ball is closed.
  double worstDist() const override { return beyond_; }

 private:
  const double radius_sq_, beyond_;
  std::vector<Index>& indices_;
  std::vector<double>& distances_sq_;
};

/// Collects the k nearest, nearest first, straight into the caller's vectors; of equally far ones the first found.
class CollectNearest final : public flann::ResultSet<double> {
 public:
  CollectNearest(std::size_t k, std::vector<Index>& indices, std::vector<double>& distances_sq)
      : k_(k), indices_(indices), distances_sq_(distances_sq) {
    indices_.resize(k);
    distances_sq_.resize(k);
  }
  bool full() const override { return count_ == k_; }
  void addPoint(double distance_sq, size_t index) override {
    if (distance_sq >= worst_) return;
    std::size_t at = count_ < k_ ? count_++ : k_ - 1;
    for (; at > 0 && distances_sq_[at - 1] > distance_sq; --at) {
      distances_sq_[at] = distances_sq_[at - 1];
      indices_[at] = indices_[at - 1];
    }
    distances_sq_[at] = distance_sq;
    indices_[at] = static_cast<Index>(index);
    if (count_ == k_) worst_ = distances_sq_[k_ - 1];
  }
  double worstDist() const override { return worst_; }
  void finish() {
    indices_.resize(count_);
    distances_sq_.resize(count_);
  }

 private:
  const std::size_t k_;
  std::size_t count_ = 0;
  double worst_ = std::numeric_limits<double>::max();
  std::vector<Index>& indices_;
  std::vector<double>& distances_sq_;
};

flann::SearchParams exact_search() {
  flann::SearchParams params(flann::FLANN_CHECKS_UNLIMITED);
  params.sorted = true;
  params.cores = 1;
  return params;
}

}  // namespace

struct KdTree::Impl {
  const flann::SearchParams exact = exact_search();
  std::unique_ptr<flann::KDTreeSingleIndex<Distance>> index;
};

KdTree::KdTree(const std::vector<Vec3>& points) : impl_(std::make_unique<Impl>()) {
  if (points.empty()) return;
  static_assert(sizeof(Vec3) == 3 * sizeof(double), "the matrix is the points as they lie in memory");
  // FLANN takes what it does not write, and reordered keeps a copy of its own, in the order of its leaves.
  const flann::Matrix<double> matrix(const_cast<double*>(points[0].data()), points.size(), 3);
  const flann::KDTreeSingleIndexParams params(kLeafSize, true);
  impl_->index = std::make_unique<flann::KDTreeSingleIndex<Distance>>(matrix, params);
  impl_->index->buildIndex();
}

KdTree::~KdTree() = default;

void KdTree::nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices,
                     std::vector<double>& distances_sq) const {
  indices.clear();
  distances_sq.clear();
  if (!impl_->index || k == 0) return;
  CollectNearest found(std::min(k, impl_->index->size()), indices, distances_sq);
  Vec3 q = query;
  impl_->index->findNeighbors(found, q.data(), impl_->exact);
  found.finish();
}

void KdTree::within(const Vec3& query, double radius, std::vector<Index>& indices,
                    std::vector<double>& distances_sq) const {
  indices.clear();
  distances_sq.clear();
  if (!impl_->index) return;
  CollectWithin found(radius * radius, indices, distances_sq);
  Vec3 q = query;
  impl_->index->findNeighbors(found, q.data(), impl_->exact);
}

}  // namespace kappa
