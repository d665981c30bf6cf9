// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/cloud_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "../search/quadric_fit.hpp"
#include "kappa/mesh/statistics.hpp"
#include "on_positions.hpp"

namespace kappa {
namespace {

constexpr std::size_t kSample = 1000, kBlock = 8;
constexpr std::size_t kFew = 12, kMany = 32;
constexpr int kRadii = 6;
constexpr double kSmallest = 5;  // spacings

/// Axes around a point: two in the plane fitted to its neighbours, and its normal.
Frame fit_frame(const std::vector<Vec3>& x, const std::vector<Index>& near) {
  Vec3 mean = Vec3::Zero();
  for (const Index i : near) mean += (x[i] - x[near[0]]) / static_cast<double>(near.size());
  Mat3 covariance = Mat3::Zero();
  for (const Index i : near) {
    const Vec3 d = x[i] - x[near[0]] - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  Frame frame;
  frame.col(0) = solver.eigenvectors().col(2);
  frame.col(1) = solver.eigenvectors().col(1);
  frame.col(2) = solver.eigenvectors().col(0);
  return frame;
}

/// What one place of the sample says about spacing and noise.
struct Place {
  double area = kNaN;  ///< per point
  double few = kNaN, many = kNaN;
};

Place measure_place(const std::vector<Vec3>& x, const PointBlocks& search, Index at) {
  std::vector<Index> near;
  std::vector<double> distances_sq;
  search.nearest(x[at], kMany, near, distances_sq);
  Place place;
  place.area = kPi * distances_sq.back() / static_cast<double>(kMany - 1);
  QuadricFit fit(fit_frame(x, near), std::sqrt(distances_sq.back()));
  for (std::size_t i = 0; i < near.size(); ++i) {
    fit.add(x[near[i]] - x[at]);
    if (i + 1 == kFew) place.few = fit.variance();
  }
  place.many = fit.variance();
  return place;
}

double median(const std::vector<Place>& places, double Place::*value) {
  std::vector<double> values;
  for (const Place& p : places) {
    if (std::isfinite(p.*value)) values.push_back(p.*value);
  }
  return percentile(values, 50);
}

/// Median of a variance with `freedom` degrees of freedom over its mean (Wilson and Hilferty).
double median_share(double freedom) {
  return std::pow(1 - 2 / (9 * freedom), 3);
}

double noise_of(const std::vector<Place>& places) {
  const double few = median(places, &Place::few) / median_share(kFew - 6.0);
  const double many = median(places, &Place::many) / median_share(kMany - 6.0);
  const double growth = std::pow(static_cast<double>(kMany) / kFew, 3);  // (ratio of the radii)^6
  return std::sqrt(std::max(0.0, (growth * few - many) / (growth - 1)));
}

/// Mean curvature of the quadric in a ball.
struct BallCurvature {
  double mean, variance;  ///< for noise of variance 1
  bool lopsided;          ///< the ball reaches over a border or a gap
};
using Curvatures6 = std::array<BallCurvature, kRadii>;  ///< in growing balls

double radius_of(int step, double spacing) {
  return kSmallest * spacing * std::pow(2.0, 0.5 * step);
}

/// The mean curvature H of a surface from that of its quadric in a disc of radius r. However little the curvature
/// varies there is a quartic part beside the quadric: the quadric of a sphere is wrong by r^2 H^3 / 4, that of a
/// cylinder by r^2 3 H^3 / 4, in general by about r^2 (3 H^3 / 4 - H G / 2).
double without_quartic_part(const QuadricFit::Curvature& quadric, double r) {
  return quadric.mean / (1 + r * r * (0.75 * quadric.mean * quadric.mean - 0.5 * quadric.gaussian));
}

Curvatures6 measure_curvatures(const std::vector<Vec3>& x, const PointBlocks& search, Index at, double spacing) {
  std::vector<Index> near;
  std::vector<double> distances_sq;
  PointBlocks::Work work;
  search.nearest(x[at], kMany, near, distances_sq);
  QuadricFit fit(fit_frame(x, near), radius_of(kRadii - 1, spacing));
  search.within(x[at], radius_of(kRadii - 1, spacing), near, distances_sq, work);
  Curvatures6 result{};
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (int step = 0; step < kRadii; ++step) {
    const double outer = radius_of(step, spacing), inner = step == 0 ? -1 : radius_of(step - 1, spacing);
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (distances_sq[i] > outer * outer || (step > 0 && distances_sq[i] <= inner * inner)) continue;
      fit.add(x[near[i]] - x[at]);
      sum += x[near[i]] - x[at];
      ++count;
    }
    constexpr double kLopsided = 0.2;  // the centroid of half a disc lies 0.42 radii from its centre
    const QuadricFit::Curvature quadric = fit.curvature();
    result[static_cast<std::size_t>(step)] = {without_quartic_part(quadric, outer), quadric.variance,
                                              sum.norm() > kLopsided * outer * count};
  }
  return result;
}

/// Squares of the differences between the quadrics of two radii, less what noise explains. Lopsided balls are left out,
/// unless few others are left.
std::vector<double> excesses(const std::vector<Curvatures6>& sample, std::size_t step, double noise) {
  const auto lopsided =
      std::count_if(sample.begin(), sample.end(), [&](const auto& c) { return c[step + 1].lopsided; });
  const bool use_all = 2 * static_cast<std::size_t>(lopsided) > sample.size();
  std::vector<double> result;
  for (const Curvatures6& c : sample) {
    const BallCurvature &from = c[step], &to = c[step + 1];
    // The larger fit is the best linear one of its points, so the variance of the difference is that of the variances.
    const double difference = from.mean - to.mean, of_noise = noise * noise * (from.variance - to.variance);
    const double excess = difference * difference - of_noise;
    if (std::isfinite(excess) && (use_all || !to.lopsided)) result.push_back(excess);
  }
  return result;
}

/// Mean square of the bias, with its standard error.
struct BiasSq {
  double mean = 0, error = 0;
  bool certain(double errors) const { return mean > errors * error; }
};

/// The largest excesses count as the 98th percentile does: a few wild quadrics would hide all others.
BiasSq bias_sq(std::vector<double> excess) {
  if (excess.size() < 2) return {};
  std::vector<double> sizes = excess;
  for (double& e : sizes) e = std::abs(e);
  const double most = percentile(sizes, 98), count = static_cast<double>(excess.size());
  double sum = 0, sum_sq = 0;
  for (const double e : excess) {
    const double kept = std::clamp(e, -most, most);
    sum += kept;
    sum_sq += kept * kept;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, sum_sq / count - mean * mean) / count)};
}

double variation_of(const std::vector<Curvatures6>& sample, double spacing, double noise) {
  constexpr double kLeast = 3, kAmple = 6, kAgreement = 0.4;  // of the square
  for (int step = 0; step + 1 < kRadii; ++step) {
    // A quadric fitted in a disc of radius r has the bias r^2 / 16 times the Laplacian of the mean curvature.
    const auto variation = [&](int s, double mean) {
      return 16 * std::sqrt(mean) / std::pow(radius_of(s, spacing), 2);
    };
    const BiasSq here = bias_sq(excesses(sample, static_cast<std::size_t>(step), noise));
    if (!here.certain(kLeast)) continue;
    if (here.certain(kAmple) || step + 2 == kRadii) return variation(step, here.mean);
    // What barely passes may be chance, and is too large on average. The next radius knows better where it follows the
    // same law, by which the square grows by four; at edges it does not.
    const BiasSq next = bias_sq(excesses(sample, static_cast<std::size_t>(step) + 1, noise));
    if (!next.certain(kLeast)) continue;
    const bool agrees = next.mean / 4 > kAgreement * here.mean;
    return agrees ? variation(step + 1, next.mean) : variation(step, here.mean);
  }
  return 0;
}

}  // namespace

CloudScale measure_scale(const std::vector<Vec3>& points, const Execution& run) {
  return measure_scale(Positions(points), run);
}

CloudScale measure_scale(const Positions& positions, const Execution& run) {
  const std::vector<Vec3>& x = positions.x;
  const PointBlocks& search = positions.search;
  CloudScale scale;
  if (x.size() < kMany) return scale;
  const std::size_t count = std::min(kSample, x.size());
  const auto sampled = [&](std::size_t i) { return static_cast<Index>(i * x.size() / count); };
  std::vector<Place> places(count);
  parallel_for(count, kBlock, stage(run, 0.5, 0.6), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) places[i] = measure_place(x, search, sampled(i));
  });
  scale.spacing = std::sqrt(median(places, &Place::area));
  scale.noise = noise_of(places);
  std::vector<Curvatures6> curvatures(count);
  parallel_for(count, kBlock, stage(run, 0.6, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) curvatures[i] = measure_curvatures(x, search, sampled(i), scale.spacing);
  });
  scale.variation = variation_of(curvatures, scale.spacing, scale.noise);
  return scale;
}

double curvature_noise(const CloudScale& scale, double radius, double normal_radius) {
  return 0.55 * scale.noise * scale.spacing / std::pow(radius * normal_radius, 1.5);
}

double curvature_bias(const CloudScale& scale, double radius, double normal_radius) {
  return scale.variation * (radius * radius / 8 + normal_radius * normal_radius / 12);
}

namespace {

/// Where `excess`, which falls with the radius, changes its sign.
template <class Excess>
double crossing(double from, double to, const Excess& excess) {
  if (!(from < to) || !(excess(from) > 0)) return from;
  if (excess(to) > 0) return to;
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (from + to);
    (excess(middle) > 0 ? from : to) = middle;
  }
  return from;
}

}  // namespace

double balanced_radius(const CloudScale& scale, double normal_radius, double from, double to) {
  return crossing(from, to, [&](double radius) {
    return curvature_noise(scale, radius, normal_radius) - curvature_bias(scale, radius, normal_radius);
  });
}

double balanced_radius(const CloudScale& scale, double from, double to) {
  return crossing(from, to, [&](double radius) {
    return curvature_noise(scale, radius, kNormalShare * radius) - curvature_bias(scale, radius, kNormalShare * radius);
  });
}

}  // namespace kappa
