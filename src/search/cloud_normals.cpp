// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/cloud_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "ball_normals.hpp"
#include "kappa/core/error.hpp"
#include "kappa/mesh/ball_sum.hpp"
#include "quadric_fit.hpp"
#include "robust_normals.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;

bool less_by_coordinates(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// The plane of the neighbours, the point itself first.
Plane plane_of(const std::vector<Vec3>& points, const std::vector<Index>& neighbours) {
  // About the point itself, so that nothing cancels.
  const Vec3& centre = points[neighbours.front()];
  Vec3 sum = Vec3::Zero();
  Mat3 products = Mat3::Zero();
  for (const Index i : neighbours) {
    const Vec3 d = points[i] - centre;
    sum += d;
    products += d * d.transpose();
  }
  return plane_of_moments(neighbours.size(), sum, products);
}

/// Fits to the nearest neighbours of one point after the other; one thread's worth of memory.
class NearestFits {
 public:
  NearestFits(const std::vector<Vec3>& points, const NeighbourSearch& search, const NormalFitOptions& options)
      : points_(points), search_(search), options_(options) {}

  Vec3 normal(Index point) {
    const auto count = static_cast<std::size_t>(options_.neighbours);
    const double radius = find(point, count);
    const Plane plane = plane_of(points_, found_);
    if (options_.fit == NormalFit::Plane || plane.normal.isZero(0)) return plane.normal;
    const QuadricFit quadric = fit(point, plane.normal, radius);
    const double growth = growth_of_ball(plane.offset / radius, count);
    const auto more = static_cast<std::size_t>(growth * growth * static_cast<double>(count));
    if (more == count) return quadric.normal_or(plane.normal);
    return better_fit(quadric, fit(point, plane.normal, find(point, more))).normal_or(plane.normal);
  }

 private:
  QuadricFit fit(Index point, const Vec3& plane, double radius) const {
    QuadricFit quadric(frame_around(plane), radius);
    for (const Index i : found_) quadric.add(points_[i] - points_[point]);
    return quadric;
  }

  /// Fills found_; the distance of the farthest.
  double find(Index point, std::size_t count) {
    search_.nearest(points_[point], count, found_, distances_sq_);
    return std::sqrt(distances_sq_.back());
  }

  const std::vector<Vec3>& points_;
  const NeighbourSearch& search_;
  const NormalFitOptions& options_;
  std::vector<Index> found_;
  std::vector<double> distances_sq_;
};

/// Normals of those that have none yet, from their nearest neighbours.
void fit_nearest(const std::vector<Vec3>& distinct, const NormalFitOptions& options, const Execution& run,
                 Normals& normals) {
  std::vector<Index> order = spatial_order(distinct);
  order.erase(std::remove_if(order.begin(), order.end(), [&](Index i) { return !normals[i].isZero(0); }), order.end());
  if (order.empty()) return;
  const NeighbourSearch search(distinct);
  parallel_for(order.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    NearestFits fits(distinct, search, options);
    for (std::size_t i = begin; i < end; ++i) normals[order[i]] = fits.normal(order[i]);
  });
}

Normals normals_of_distinct(const std::vector<Vec3>& points, const NormalFitOptions& options, const Execution& run) {
  if (options.fit == NormalFit::Robust) return robust_normals(points, options, run);
  Normals normals(points.size(), Vec3::Zero());
  const bool balls = options.radius > 0;
  if (balls) {
    const auto least = static_cast<std::size_t>(options.neighbours);
    normals = ball_normals(points, options.radius, least, options.fit, stage(run, 0.0, 0.9));
  }
  fit_nearest(points, options, balls ? stage(run, 0.9, 1.0) : run, normals);
  return normals;
}

void check(const NormalFitOptions& options) {
  if (options.neighbours < 3)
    throw Error(ErrorCode::InvalidArgument,
                "neighbours = " + std::to_string(options.neighbours) + ": a plane needs at least 3");
  if (!(options.radius >= 0 && std::isfinite(options.radius)))
    throw Error(ErrorCode::InvalidArgument, "radius of the normals = " + std::to_string(options.radius) +
                                                ": give a positive length, or 0 for the nearest neighbours alone");
}

}  // namespace

std::vector<Index> find_duplicates(const std::vector<Vec3>& points) {
  std::vector<Index> order;
  for (Index i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    if (points[a] == points[b]) return a < b;
    return less_by_coordinates(points[a], points[b]);
  });
  std::vector<Index> representative(points.size(), kNoIndex);
  Index first = kNoIndex;
  for (const Index i : order) {
    if (first == kNoIndex || points[first] != points[i]) first = i;
    representative[i] = first;
  }
  return representative;
}

Normals fitted_normals(const std::vector<Vec3>& points, const NormalFitOptions& options, const Execution& run) {
  check(options);
  const std::vector<Index> representative = find_duplicates(points);
  std::vector<Vec3> distinct;
  std::vector<Index> position(points.size(), kNoIndex);
  for (Index i = 0; i < points.size(); ++i) {
    if (representative[i] != i) continue;
    position[i] = static_cast<Index>(distinct.size());
    distinct.push_back(points[i]);
  }
  const Normals of_distinct = normals_of_distinct(distinct, options, run);
  Normals normals(points.size(), Vec3::Zero());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (representative[i] != kNoIndex) normals[i] = of_distinct[position[representative[i]]];
  }
  return normals;
}

void orient_towards(const std::vector<Vec3>& points, const Vec3& viewpoint, Normals& normals) {
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i].dot(viewpoint - points[i]) < 0) normals[i] = -normals[i];
  }
}

void orient_along(const Vec3& direction, Normals& normals) {
  for (Vec3& u : normals) {
    if (u.dot(direction) < 0) u = -u;
  }
}

}  // namespace kappa
