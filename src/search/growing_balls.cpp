// SPDX-License-Identifier: BSD-3-Clause
#include "growing_balls.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "plane_fit.hpp"
#include "quadric_fit.hpp"

namespace kappa {
namespace {

/// Points around a point, relative to it, those of every ball in fours before the others.
struct Near {
  std::array<double, kRungs> radii;
  std::array<kernels::Selected, kRungs> in_ball = {};
  std::vector<kernels::FourPoints> points;

  Near(const Positions& positions, Index at, double spacing) {
    for (int rung = 0; rung < kRungs; ++rung) radii[static_cast<std::size_t>(rung)] = radius_of_rung(rung, spacing);
    std::vector<Index> indices;
    std::vector<double> distances_sq;
    PointBlocks::Work work;
    positions.search.within(positions.x[at], radii.back(), indices, distances_sq, work);
    std::array<std::vector<Index>, kRungs> shells;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      std::size_t rung = 0;
      while (rung + 1 < kRungs && distances_sq[i] > radii[rung] * radii[rung]) ++rung;
      shells[rung].push_back(indices[i]);
    }
    std::size_t count = 0;
    for (std::size_t rung = 0; rung < kRungs; ++rung) {
      for (std::size_t i = 0; i < shells[rung].size(); ++i) add(positions.x[shells[rung][i]] - positions.x[at], i % 4);
      count += shells[rung].size();
      in_ball[rung] = {points.size(), count};
    }
  }

 private:
  void add(const Vec3& d, std::size_t place) {
    if (place == 0) points.push_back({});
    for (int axis = 0; axis < 3; ++axis) points.back().x[axis][place] = d[axis];
  }
};

/// The mean curvature H of a surface from that of its quadric in a disc of radius r. However little the curvature
/// varies there is a quartic part beside the quadric: the quadric of a sphere is wrong by r^2 H^3 / 4, that of a
/// cylinder by r^2 3 H^3 / 4, in general by about r^2 (3 H^3 / 4 - H G / 2).
double without_quartic_part(const QuadricFit::Curvature& quadric, double r) {
  return quadric.mean / (1 + r * r * (0.75 * quadric.mean * quadric.mean - 0.5 * quadric.gaussian));
}

/// Fits to the points of one ball, with the normal on the side of `towards`, if that is not zero.
BallFit fit_ball(const Near& near, std::size_t rung, const Vec3& towards) {
  const auto [fours, count] = near.in_ball[rung];
  const double radius = near.radii[rung];
  PlaneSums sums;
  kernels::best_point_table().plane_sums(near.points.data(), fours, sums.data());
  const Moments m = moments_of(count, sums);
  Vec3 plane = plane_of_moments(m).normal;
  if (plane.isZero(0)) return {};
  if (plane.dot(towards) < 0) plane = -plane;
  QuadricFit quadric(frame_around(plane), radius);
  quadric.take(near.points.data(), fours, m);
  const QuadricFit::Curvature curvature = quadric.curvature();
  BallFit fit;
  fit.normal = quadric.normal();
  fit.normal_variance = quadric.normal_variance();
  fit.mean = without_quartic_part(curvature, radius);
  fit.mean_variance = curvature.variance;
  // The centroid of half a disc lies 0.42 radii from its centre; noise and curvature move it across the plane alone.
  constexpr double kLopsided = 0.2;
  const Vec3 along = m.sum - m.sum.dot(plane) * plane;
  fit.lopsided = along.norm() > kLopsided * radius * static_cast<double>(count);
  return fit;
}

}  // namespace

double radius_of_rung(int rung, double spacing) {
  return kSmallestBall * spacing * std::pow(2.0, 0.5 * rung);
}

GrowingBalls fit_growing_balls(const Positions& positions, Index at, double spacing) {
  const Near near(positions, at, spacing);
  GrowingBalls fits;
  Vec3 towards = Vec3::Zero();
  for (std::size_t rung = 0; rung < kRungs; ++rung) {
    fits[rung] = fit_ball(near, rung, towards);
    if (!fits[rung].normal.isZero(0)) towards = fits[rung].normal;
  }
  return fits;
}

}  // namespace kappa
