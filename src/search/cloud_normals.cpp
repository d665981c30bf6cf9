// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/cloud_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <Eigen/Eigenvalues>

#include "kappa/core/error.hpp"
#include "kappa/mesh/ball_sum.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;

bool less_by_coordinates(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Normal of the plane of least squares, the zero vector if the points do not span a plane.
Vec3 plane_normal(const std::vector<Vec3>& points, const std::vector<Index>& neighbours) {
  if (neighbours.size() < 3) return Vec3::Zero();
  // About the first neighbour, the point itself, so that nothing cancels.
  const Vec3& centre = points[neighbours.front()];
  Vec3 mean = Vec3::Zero();
  for (const Index i : neighbours) mean += points[i] - centre;
  mean /= static_cast<double>(neighbours.size());
  Mat3 covariance = Mat3::Zero();
  for (const Index i : neighbours) {
    const Vec3 d = points[i] - centre - mean;
    covariance += d * d.transpose();
  }
  const double size = covariance.trace();
  if (!(size > 0)) return Vec3::Zero();
  Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance / size);
  constexpr double kCollinear = 1e-12;
  if (solver.eigenvalues()[1] <= kCollinear) return Vec3::Zero();
  return solver.eigenvectors().col(0).normalized();
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

Normals pca_normals(const std::vector<Vec3>& points, const PcaOptions& options, const Execution& run) {
  if (options.neighbours < 3)
    throw Error(ErrorCode::InvalidArgument,
                "neighbours = " + std::to_string(options.neighbours) + ": a plane needs at least 3");
  const std::vector<Index> representative = find_duplicates(points);
  std::vector<Vec3> distinct;
  std::vector<Index> position(points.size(), kNoIndex);
  for (Index i = 0; i < points.size(); ++i) {
    if (representative[i] != i) continue;
    position[i] = static_cast<Index>(distinct.size());
    distinct.push_back(points[i]);
  }
  const NeighbourSearch search(distinct);
  const std::vector<Index> order = spatial_order(distinct);
  Normals of_distinct(distinct.size());
  parallel_for(distinct.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<Index> neighbours;
    std::vector<double> distances_sq;
    for (std::size_t i = begin; i < end; ++i) {
      search.nearest(distinct[order[i]], static_cast<std::size_t>(options.neighbours), neighbours, distances_sq);
      of_distinct[order[i]] = plane_normal(distinct, neighbours);
    }
  });
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
