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

flann::SearchParams exact() {
  flann::SearchParams params(flann::FLANN_CHECKS_UNLIMITED);
  params.sorted = true;
  params.cores = 1;
  return params;
}

}  // namespace

struct KdTree::Impl {
  std::vector<double> coordinates;
  std::unique_ptr<flann::KDTreeSingleIndex<Distance>> index;
};

KdTree::KdTree(const std::vector<Vec3>& points) : impl_(std::make_unique<Impl>()) {
  impl_->coordinates.reserve(3 * points.size());
  for (const Vec3& p : points) impl_->coordinates.insert(impl_->coordinates.end(), p.data(), p.data() + 3);
  if (points.empty()) return;
  const flann::Matrix<double> matrix(impl_->coordinates.data(), points.size(), 3);
  const flann::KDTreeSingleIndexParams params(kLeafSize);
  impl_->index = std::make_unique<flann::KDTreeSingleIndex<Distance>>(matrix, params);
  impl_->index->buildIndex();
}

KdTree::~KdTree() = default;

void KdTree::nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices,
                     std::vector<double>& distances_sq) const {
  indices.clear();
  distances_sq.clear();
  if (!impl_->index || k == 0) return;
  k = std::min(k, impl_->index->size());
  flann::KNNSimpleResultSet<double> found(k);
  Vec3 q = query;
  impl_->index->findNeighbors(found, q.data(), exact());
  std::vector<std::size_t> found_indices(found.size());
  distances_sq.resize(found.size());
  found.copy(found_indices.data(), distances_sq.data(), found.size(), true);
  indices.assign(found_indices.begin(), found_indices.end());
}

void KdTree::within(const Vec3& query, double radius, std::vector<Index>& indices,
                    std::vector<double>& distances_sq) const {
  indices.clear();
  distances_sq.clear();
  if (!impl_->index) return;
  CollectWithin found(radius * radius, indices, distances_sq);
  Vec3 q = query;
  impl_->index->findNeighbors(found, q.data(), exact());
}

}  // namespace kappa
