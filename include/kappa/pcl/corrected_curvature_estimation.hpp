// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/Vertices.h>
#include <pcl/features/feature.h>
#include <pcl/point_types.h>

#include <atomic>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/error.hpp"
#include "kappa/pcl/impl/curvature_job.hpp"
#include "kappa/pcl/point_types.hpp"

namespace kappa {

/// Signed curvatures of a cloud or mesh, from corrected curvature measures in balls, as a PCL feature.
///
/// PointOutT: `PointCurvature` (everything) or `pcl::PrincipalCurvatures` (drop-in: pc1 = k_max with its
/// direction, pc2 = k_min). Sign: outward (or upward) normals on a convex surface give positive values;
/// flipping the normals flips mean, k_min and k_max. Units: 1/length, gaussian 1/length^2, of the cloud.
///
/// - setInputCloud, setIndices: the points that get a feature, in the order of the indices.
/// - setSearchSurface: the cloud whose surface is measured, the input cloud by default.
/// - setInputNormals: unit normals of the *search surface* (PCL's rule), which are re-normalised in double. The
///   sign of the result is theirs. A point that is not on the search surface takes the normal of the nearest of
///   its points, which decides the plane of k_min and k_max alone, not mean and gaussian.
/// - setPolygons: faces on the search surface. Without them the surface is the umbrella surface of the points.
/// - setRadiusSearch: radius of the measuring ball, the same at all points. Not a limit of a neighbour list: a
///   face that the sphere cuts counts with the part inside.
/// - setKSearch: at each point the ball is the smallest that holds its k nearest points of the search surface, the
///   point itself included where it is one of them; with fewer than k points, all. Needs k >= 2. Where k
///   points share one position there is no ball: status Empty.
/// - setSearchMethod: the tree that finds those neighbours; a k-d tree by default (PCL's default for organised
///   clouds is exact for projective cameras alone). It is queried from several threads, as in PCL's OMP classes.
///
/// A point that is not finite, or whose normal is zero or not finite, gets NaN and status Invalid; any NaN makes
/// `is_dense` false. Width, height and header of the output are those PCL gives any feature.
///
/// compute() never throws. If it cannot serve the call (no cloud or normals, sizes differ, a polygon or index out of
/// range, neither or both of radius and k) the output is empty, one PCL_ERROR line is logged and status() says
/// why. Any number of threads gives the same bits.
///
/// PCL keeps coordinates in float. Computation is in double relative to a local origin, so nothing is lost beyond
/// what the cloud lost: at a UTM northing that is 0.5 m, so subtract an origin before making the cloud.
///
/// Cost: that of `umbrella_surface` (without polygons), plus one ball sum a point, linear in the faces in the ball
/// and no dearer with a radius of its own for each point than with a common one.
///
/// Compiled for the point types listed at the end of this header. For others, include
/// "kappa/pcl/impl/corrected_curvature_estimation.hpp" as well, and define PCL_NO_PRECOMPILE if the type is
/// not PCL's own.
template <class PointInT, class PointNT = pcl::Normal, class PointOutT = PointCurvature>
class CorrectedCurvatureEstimation : public pcl::FeatureFromNormals<PointInT, PointNT, PointOutT> {
  using Base = pcl::FeatureFromNormals<PointInT, PointNT, PointOutT>;

 public:
  using Ptr = pcl::shared_ptr<CorrectedCurvatureEstimation>;
  using ConstPtr = pcl::shared_ptr<const CorrectedCurvatureEstimation>;
  using PointCloudOut = typename pcl::Feature<PointInT, PointOutT>::PointCloudOut;

  /// `threads` as in setNumberOfThreads.
  explicit CorrectedCurvatureEstimation(unsigned int threads = 1);

  /// 0 = all the machine has.
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }

  /// Faces with corners among the points of the search surface, any number of corners, counter-clockwise seen from
  /// the side of the normals or not. None: back to the umbrella surface.
  void setPolygons(const std::vector<pcl::Vertices>& polygons) { polygons_ = polygons; }
  const std::vector<pcl::Vertices>& getPolygons() const { return polygons_; }

  /// What a face that the sphere cuts adds.
  void setBallDefinition(BallDefinition ball) { ball_ = ball; }
  BallDefinition getBallDefinition() const { return ball_; }

  /// How polygons of four corners are measured.
  void setQuadMeasures(QuadMeasures quads) { quads_ = quads; }
  QuadMeasures getQuadMeasures() const { return quads_; }

  /// Order of the bias that is cancelled, 1 (none, the default) to 3: curvatures are extrapolated from balls of the
  /// radius and smaller ones, see `extrapolate`. Anything else makes compute() fail.
  void setOrder(int order) { order_ = order; }
  int getOrder() const { return order_; }

  /// Standard errors of the second form at the points of the last compute(), in the order of the output, from how much
  /// the orders differ; NaN at order 1 and where there is no curvature.
  const std::vector<double>& getStandardErrors() const { return std_errors_; }

  /// Neighbours of which each star of the umbrella surface is made, 3 to 255; without effect with polygons.
  void setUmbrellaNeighbours(int neighbours) { umbrella_.neighbours = neighbours; }
  int getUmbrellaNeighbours() const { return umbrella_.neighbours; }

  /// A flag that stops compute() when raised, null for none: the output is then empty and status() not ok.
  void setCancel(const std::atomic<bool>* cancel) { cancel_ = cancel; }

  /// Outcome of the last compute(), ok before the first.
  const Status& status() const { return status_; }

 protected:
  bool initCompute() override;

 private:
  void computeFeature(PointCloudOut& output) override;

  void check_input() const;
  void prepare_base();
  detail::CurvatureJob translate() const;
  void place_ball(std::size_t position, detail::CurvatureJob& job) const;
  Index surface_point_at(pcl::index_t input_index) const;
  void fill(const detail::CurvatureJob& job, const std::vector<CurvatureSample>& samples, PointCloudOut& output);
  Execution execution() const;
  void log_failure() const;

  typename Base::KdTreePtr default_tree_;  ///< what tree_ is unless one was given
  unsigned int threads_;
  std::vector<pcl::Vertices> polygons_;
  BallDefinition ball_ = BallDefinition::ExactDensity;
  QuadMeasures quads_ = QuadMeasures::Split;
  int order_ = 1;
  std::vector<double> std_errors_;
  UmbrellaOptions umbrella_;
  const std::atomic<bool>* cancel_ = nullptr;
  Status status_;
};

extern template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalCurvatures>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::PointNormal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZI, pcl::Normal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZI, pcl::Normal, pcl::PrincipalCurvatures>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGB, pcl::Normal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::PrincipalCurvatures>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGBA, pcl::Normal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGBA, pcl::Normal, pcl::PrincipalCurvatures>;
extern template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::Normal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::PointNormal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PrincipalCurvatures>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGBNormal, pcl::PointXYZRGBNormal, PointCurvature>;
extern template class CorrectedCurvatureEstimation<pcl::PointXYZRGBNormal, pcl::PointXYZRGBNormal,
                                                   pcl::PrincipalCurvatures>;

}  // namespace kappa
