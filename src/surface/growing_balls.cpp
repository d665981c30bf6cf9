// SPDX-License-Identifier: BSD-3-Clause
#include "growing_balls.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "../search/ball_normals.hpp"
#include "../search/quadric_fit.hpp"

namespace kappa {
namespace {

/// The points of a ball around a point, relative to it.
struct Ball {
  double radius;
  std::vector<Vec3> points;
};

/// The mean curvature H of a surface from that of its quadric in a disc of radius r. However little the curvature
/// varies there is a quartic part beside the quadric: the quadric of a sphere is wrong by r^2 H^3 / 4, that of a
/// cylinder by r^2 3 H^3 / 4, in general by about r^2 (3 H^3 / 4 - H G / 2).
double without_quartic_part(const QuadricFit::Curvature& quadric, double r) {
  return quadric.mean / (1 + r * r * (0.75 * quadric.mean * quadric.mean - 0.5 * quadric.gaussian));
}

/// Whether the centroid lies far beside the centre, along the plane: noise and curvature move it across.
bool is_lopsided(const Ball& ball, const Vec3& sum, const Vec3& plane) {
  constexpr double kLopsided = 0.2;  // the centroid of half a disc lies 0.42 radii from its centre
  const Vec3 along = sum - sum.dot(plane) * plane;
  return along.norm() > kLopsided * ball.radius * static_cast<double>(ball.points.size());
}

/// With the normal on the side of `towards`, if that is not zero.
BallFit fit_ball(const Ball& ball, const Vec3& towards) {
  Vec3 sum = Vec3::Zero();
  Mat3 products = Mat3::Zero();
  for (const Vec3& d : ball.points) {
    sum += d;
    products += d * d.transpose();
  }
  Vec3 plane = plane_of_moments(ball.points.size(), sum, products).normal;
  if (plane.isZero(0)) return {};
  if (plane.dot(towards) < 0) plane = -plane;
  QuadricFit quadric(frame_around(plane), ball.radius);
  for (const Vec3& d : ball.points) quadric.add(d);
  const QuadricFit::Curvature curvature = quadric.curvature();
  BallFit fit;
  fit.normal = quadric.normal();
  fit.normal_variance = quadric.normal_variance();
  fit.mean = without_quartic_part(curvature, ball.radius);
  fit.mean_variance = curvature.variance;
  fit.lopsided = is_lopsided(ball, sum, plane);
  return fit;
}

}  // namespace

double radius_of_rung(int rung, double spacing) {
  return kSmallestBall * spacing * std::pow(2.0, 0.5 * rung);
}

GrowingBalls fit_growing_balls(const Positions& positions, Index at, double spacing) {
  std::vector<Index> near;
  std::vector<double> distances_sq;
  PointBlocks::Work work;
  positions.search.within(positions.x[at], radius_of_rung(kRungs - 1, spacing), near, distances_sq, work);
  GrowingBalls fits;
  Vec3 towards = Vec3::Zero();
  for (int rung = 0; rung < kRungs; ++rung) {
    Ball ball{radius_of_rung(rung, spacing), {}};
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (distances_sq[i] <= ball.radius * ball.radius) ball.points.push_back(positions.x[near[i]] - positions.x[at]);
    }
    BallFit& fit = fits[static_cast<std::size_t>(rung)];
    fit = fit_ball(ball, towards);
    if (!fit.normal.isZero(0)) towards = fit.normal;
  }
  return fits;
}

}  // namespace kappa
