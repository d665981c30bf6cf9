// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/fitted_normals.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "ball_normals.hpp"
#include "core/large_array.hpp"
#include "kappa/core/error.hpp"
#include "plane_fit.hpp"
#include "positions.hpp"
#include "quadric_fit.hpp"
#include "robust_normals.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;

/// Spreads equal positions to equal places, 0 and -0 alike.
std::uint64_t hash_of(const Vec3& x) {
  std::uint64_t h = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double value = x[axis] + 0.0;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    h = (h ^ bits) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 32;
  }
  return h;
}

/// The plane of the neighbours, the point itself first.
Plane plane_of(const std::vector<Vec3>& points, const std::vector<Index>& neighbours) {
  // About the point itself, so that nothing cancels.
  const Vec3& centre = points[neighbours.front()];
  Moments m;
  for (const Index i : neighbours) m.add(points[i] - centre);
  return plane_of_moments(m);
}

/// Fits to the nearest neighbours of one point after the other; one thread's worth of memory.
class NearestFits {
 public:
  NearestFits(const std::vector<Vec3>& points, const PointBlocks& search, NormalFit fit)
      : points_(points), search_(search), fit_(fit) {}

  /// From its neighbours, as PointBlocks::nearest finds them.
  Vec3 normal(Index point, const std::vector<Index>& neighbours, const std::vector<double>& distances_sq) {
    const std::size_t count = neighbours.size();
    const double radius = std::sqrt(distances_sq.back());
    found_ = neighbours;
    const Plane plane = plane_of(points_, found_);
    if (fit_ == NormalFit::Plane || plane.normal.isZero(0)) return plane.normal;
    const QuadricFit quadric = fit(point, plane.normal, radius);
    const double growth = growth_of_ball(plane.offset / radius, count);
    const auto more = static_cast<std::size_t>(growth * growth * static_cast<double>(count));
    if (more == count) return quadric.normal_or(plane.normal);
    return better_fit(quadric, fit(point, plane.normal, find(point, more, 1.5 * growth * radius)))
        .normal_or(plane.normal);
  }

 private:
  QuadricFit fit(Index point, const Vec3& plane, double radius) const {
    QuadricFit quadric(frame_around(plane), radius);
    for (const Index i : found_) quadric.add(points_[i] - points_[point]);
    return quadric;
  }

  /// Fills found_, mostly within `guess`; the distance of the farthest.
  double find(Index point, std::size_t count, double guess) {
    search_.nearest(points_[point], count, guess, found_, distances_sq_, work_);
    return std::sqrt(distances_sq_.back());
  }

  const std::vector<Vec3>& points_;
  const PointBlocks& search_;
  const NormalFit fit_;
  std::vector<Index> found_;
  std::vector<double> distances_sq_;
  PointBlocks::Work work_;
};

/// Normals of those that have none yet, from their nearest neighbours.
void fit_nearest(const Positions& positions, const NormalFitOptions& options, const Execution& run, Normals& normals) {
  parallel_for(positions.x.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    NearestFits fits(positions.x, positions.search, options.fit);
    NearestInRuns nearest(positions.search, static_cast<std::size_t>(options.neighbours));
    const auto lacks_normal = [&](std::size_t i) { return normals[i].isZero(0); };
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t first = i;
      while (i < end && lacks_normal(i)) ++i;
      nearest.for_each(first, i, [&](std::size_t point, const auto& indices, const auto& distances_sq) {
        normals[point] = fits.normal(static_cast<Index>(point), indices, distances_sq);
      });
    }
  });
}

Normals normals_of_positions(const Positions& positions, const NormalFitOptions& options, const Execution& run) {
  if (options.fit == NormalFit::Robust) return robust_normals(positions, options, run);
  Normals normals(positions.x.size(), Vec3::Zero());
  const bool balls = options.radius > 0;
  if (balls) {
    const auto least = static_cast<std::size_t>(options.neighbours);
    const double most_variance =
        options.noise > 0 ? 4 * options.noise * options.noise : std::numeric_limits<double>::infinity();
    normals = ball_normals(positions.search, options.radius, least, options.fit, most_variance, stage(run, 0.0, 0.9));
  }
  fit_nearest(positions, options, balls ? stage(run, 0.9, 1.0) : run, normals);
  return normals;
}

void check(const NormalFitOptions& options) {
  if (options.neighbours < 3)
    throw Error(ErrorCode::InvalidArgument,
                "neighbours = " + std::to_string(options.neighbours) + ": a plane needs at least 3");
  if (!(options.radius >= 0 && std::isfinite(options.radius)))
    throw Error(ErrorCode::InvalidArgument, "radius of the normals = " + std::to_string(options.radius) +
                                                ": give a positive length, or 0 for the nearest neighbours alone");
  if (!(options.noise >= 0 && std::isfinite(options.noise)))
    throw Error(ErrorCode::InvalidArgument, "noise of the points = " + std::to_string(options.noise) +
                                                ": give a positive length, or 0 if it is not known");
}

}  // namespace

const std::vector<Named<NormalFit>>& names_of(NormalFit) {
  static const std::vector<Named<NormalFit>> names = {
      {NormalFit::Plane, "plane", "the plane of least squares"},
      {NormalFit::Quadric, "quadric", "the quadric of least squares"},
      {NormalFit::Robust, "robust", "planes and quadrics that resist edges and outliers"},
  };
  return names;
}

std::vector<Index> find_duplicates(const std::vector<Vec3>& points) {
  std::size_t places = 1;
  while (places < 2 * points.size()) places *= 2;
  auto first_at = large_vector<Index>(places, kNoIndex, Execution());
  std::vector<Index> representative(points.size(), kNoIndex);
  for (Index i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    std::size_t place = hash_of(points[i]) & (places - 1);
    while (first_at[place] != kNoIndex && points[first_at[place]] != points[i]) place = (place + 1) & (places - 1);
    if (first_at[place] == kNoIndex) first_at[place] = i;
    representative[i] = first_at[place];
  }
  return representative;
}

Normals fitted_normals(const Positions& positions, const NormalFitOptions& options, const Execution& run) {
  check(options);
  const Normals of_positions = normals_of_positions(positions, options, run);
  Normals normals(positions.representative.size(), Vec3::Zero());
  for (std::size_t i = 0; i < of_positions.size(); ++i) normals[positions.original[i]] = of_positions[i];
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Index first = positions.representative[i];
    if (first != kNoIndex) normals[i] = normals[first];
  }
  return normals;
}

Normals fitted_normals(const std::vector<Vec3>& points, const NormalFitOptions& options, const Execution& run) {
  check(options);
  return fitted_normals(Positions(points), options, run);
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
