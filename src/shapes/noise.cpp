// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/noise.hpp"

#include "check.hpp"
#include "kappa/mesh/topology.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

/// Mean length of the edges around each vertex that have one, 0 for a vertex in no face.
std::vector<double> mean_edge_lengths(const Scan& scan) {
  const Adjacency neighbours = vertex_neighbours(mesh_of(scan));
  std::vector<double> lengths(scan.points.size(), 0);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    double sum = 0;
    int count = 0;
    for (const Index* j = neighbours.begin(i); j != neighbours.end(i); ++j) {
      const double length = (scan.points[*j] - scan.points[i]).norm();
      if (!std::isfinite(length)) continue;
      sum += length;
      ++count;
    }
    if (count > 0) lengths[i] = sum / count;
  }
  return lengths;
}

/// Unit vector along v; 0 if v has no direction.
Vec3 direction_of(const Vec3& v) {
  const double length = v.norm();
  return length > 0 && std::isfinite(length) ? Vec3(v / length) : Vec3::Zero();
}

void add_ball_noise(Scan& scan, double amount, Random& random) {
  if (scan.faces.empty()) {
    throw Error(ErrorCode::InvalidArgument,
                "noise in a ball is relative to the edges of faces, and the scan has no faces; use another kind");
  }
  const std::vector<double> lengths = mean_edge_lengths(scan);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    scan.points[i] += random.in_ball() * (amount * lengths[i]);
  }
}

void add_normal_noise(Scan& scan, double amount, Random& random) {
  if (scan.normals.size() != scan.points.size()) {
    throw Error(ErrorCode::InvalidArgument, "noise along the normals needs normals, and the scan has none");
  }
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    scan.points[i] += amount * random.normal() * direction_of(scan.normals[i]);
  }
}

void add_range_noise(Scan& scan, const NoiseOptions& options, Random& random) {
  const std::optional<Vec3> viewpoint = options.viewpoint ? options.viewpoint : scan.viewpoint;
  if (!viewpoint || !is_finite(*viewpoint)) {
    throw Error(ErrorCode::InvalidArgument, "noise along the range needs a finite viewpoint; give one");
  }
  const Vec3 scanner = *viewpoint - scan.origin;
  for (auto& point : scan.points) point += options.amount * random.normal() * direction_of(point - scanner);
}

}  // namespace

void add_noise(Scan& scan, const NoiseOptions& options) {
  detail::require_not_negative("amount", options.amount);
  Random random(options.seed);
  switch (options.kind) {
    case NoiseKind::Ball:
      add_ball_noise(scan, options.amount, random);
      break;
    case NoiseKind::Normal:
      add_normal_noise(scan, options.amount, random);
      break;
    case NoiseKind::Range:
      add_range_noise(scan, options, random);
      break;
  }
  if (options.normals == NoisyNormals::Drop) scan.normals.clear();
}

}  // namespace kappa
