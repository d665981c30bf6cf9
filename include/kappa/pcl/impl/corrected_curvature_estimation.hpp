// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kappa/core/bounds.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/pcl/convert.hpp"
#include "kappa/pcl/corrected_curvature_estimation.hpp"

namespace kappa {

template <class PointInT, class PointNT, class PointOutT>
CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::CorrectedCurvatureEstimation(unsigned int threads)
    : threads_(threads) {
  this->feature_name_ = "CorrectedCurvatureEstimation";
}

template <class PointInT, class PointNT, class PointOutT>
bool CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::initCompute() {
  std_errors_.clear();
  status_ = detail::status_of([this] {
    check_input();
    prepare_base();
  });
  if (status_.ok()) return true;
  this->deinitCompute();
  log_failure();
  return false;
}

/// Whatever PCL's own initCompute would refuse is refused here before, so that there is one line in the log and a
/// status to read.
template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::check_input() const {
  const auto require = [](bool condition, const std::string& message) {
    if (!condition) throw Error(ErrorCode::InvalidArgument, message);
  };
  require(this->input_ && !this->input_->empty(), "There is no input cloud, or it is empty: call setInputCloud.");
  const auto& surface = this->surface_ ? this->surface_ : this->input_;
  require(!surface->empty(), "The search surface is empty: give setSearchSurface a cloud with points.");
  require(this->normals_ != nullptr, "There are no normals: call setInputNormals.");
  require(this->normals_->size() == surface->size(), "There are " + std::to_string(this->normals_->size()) +
                                                         " normals for the " + std::to_string(surface->size()) +
                                                         " points of the search surface: give one normal a point.");
  const auto finite = [](const PointInT& p) { return pcl::isXYZFinite(p); };
  require(std::any_of(surface->begin(), surface->end(), finite),
          "No point of the search surface is finite: give a cloud with points.");
  detail::check_search(this->search_radius_, this->k_);
  if (this->indices_ && !this->fake_indices_) detail::check_indices(*this->indices_, this->input_->size());
}

template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::prepare_base() {
  if (!this->tree_ || this->tree_ == default_tree_) {
    // A new one each time: the points of the same cloud may have moved since.
    default_tree_.reset(new pcl::search::KdTree<PointInT>(false));
    this->tree_ = default_tree_;
  }
  if (!Base::initCompute()) throw Error(ErrorCode::InvalidArgument, "PCL refused the input: see its messages.");
}

template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::computeFeature(PointCloudOut& output) {
  status_ = detail::status_of([&] {
    const detail::CurvatureJob job = translate();
    fill(job, detail::run(job, execution()), output);
  });
  if (status_.ok()) return;
  output.clear();
  log_failure();
}

template <class PointInT, class PointNT, class PointOutT>
detail::CurvatureJob CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::translate() const {
  detail::CurvatureJob job;
  job.surface.vertices = points_of(*this->surface_);
  job.surface.origin = choose_origin(bounds(job.surface.vertices));
  for (Vec3& x : job.surface.vertices) x -= job.surface.origin;
  job.surface.faces = to_faces(polygons_, this->surface_->size());
  job.normals = normalised(normals_of(*this->normals_));
  job.radius = this->search_radius_;
  job.ball = ball_;
  job.order = order_;
  job.quads = quads_;
  job.umbrella = umbrella_;

  const std::size_t count = this->indices_->size();
  job.centres.resize(count);
  job.centre_normals.resize(count);
  job.radii.resize(this->k_ > 0 ? count : 0);
  parallel_for(count, 256, execution(), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) place_ball(i, job);
  });
  return job;
}

/// Centre, normal and, with k, radius of the ball at one of the indices.
template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::place_ball(std::size_t position,
                                                                            detail::CurvatureJob& job) const {
  const pcl::index_t index = (*this->indices_)[position];
  const PointInT& p = (*this->input_)[index];
  const Vec3 centre = Vec3(p.x, p.y, p.z) - job.surface.origin;
  job.centres[position] = centre;
  const Index nearest = surface_point_at(index);
  job.centre_normals[position] = nearest == kNoIndex ? Vec3::Zero().eval() : job.normals[nearest];
  if (job.radii.empty() || !is_finite(centre)) return;

  pcl::Indices neighbours;
  std::vector<float> distances_sq;
  this->searchForNeighbors(index, this->k_, neighbours, distances_sq);
  double radius_sq = 0;  // In double: the tree's distances are in float.
  for (const pcl::index_t j : neighbours) {
    radius_sq = std::max(radius_sq, (job.surface.vertices[j] - centre).squaredNorm());
  }
  // Rounded up, so that the closed ball holds the k-th neighbour.
  job.radii[position] = std::sqrt(radius_sq) * (1 + std::numeric_limits<double>::epsilon());
}

/// Point of the search surface whose normal a point of the input cloud has, kNoIndex for none.
template <class PointInT, class PointNT, class PointOutT>
Index CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::surface_point_at(pcl::index_t input_index) const {
  if (this->surface_ == this->input_) return static_cast<Index>(input_index);
  if (!pcl::isXYZFinite((*this->input_)[input_index])) return kNoIndex;
  pcl::Indices nearest;
  std::vector<float> distances_sq;
  this->tree_->nearestKSearch(*this->input_, input_index, 1, nearest, distances_sq);
  return nearest.empty() ? kNoIndex : static_cast<Index>(nearest[0]);
}

template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::fill(const detail::CurvatureJob& job,
                                                                      const std::vector<CurvatureSample>& samples,
                                                                      PointCloudOut& output) {
  output.is_dense = true;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std_errors_.push_back(samples[i].std_error);
    to_point(samples[i], job.centres[i] + job.surface.origin, job.centre_normals[i], output[i]);
    if (samples[i].k.status != PointStatus::Valid) output.is_dense = false;
  }
}

template <class PointInT, class PointNT, class PointOutT>
Execution CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::execution() const {
  Execution run;
  run.threads = static_cast<int>(std::min(threads_, 1000000U));  // Too many is an error further down.
  run.cancel = cancel_;
  return run;
}

template <class PointInT, class PointNT, class PointOutT>
void CorrectedCurvatureEstimation<PointInT, PointNT, PointOutT>::log_failure() const {
  PCL_ERROR("[kappa::%s::compute] %s\n", this->getClassName().c_str(), status_.message().c_str());
}

}  // namespace kappa
