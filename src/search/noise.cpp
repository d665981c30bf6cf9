// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "growing_balls.hpp"
#include "kappa/core/percentiles.hpp"
#include "on_positions.hpp"
#include "plane_fit.hpp"
#include "quadric_fit.hpp"

namespace kappa {
namespace {

constexpr std::size_t kSample = 1000, kBlock = 8;
constexpr int kFirstOfMean = 2;  // smaller balls tell nothing of the mean curvature

/// Neighbourhoods of growing size: those of two successive ones tell the noise.
constexpr std::array<std::size_t, 5> kCounts = {12, 32, 85, 227, 605};

/// What one place of the sample says about spacing and noise.
struct Place {
  double area = kNaN;  ///< per point
  double few = kNaN, many = kNaN;
};

Place measure_place(const Positions& positions, Index at, std::size_t few, std::size_t many) {
  std::vector<Index> near;
  std::vector<double> distances_sq;
  positions.search.nearest(positions.x[at], many, near, distances_sq);
  Place place;
  place.area = kPi * distances_sq.back() / static_cast<double>(many - 1);
  Moments m;
  for (const Index i : near) m.add(positions.x[i] - positions.x[at]);
  const Vec3 plane = plane_of_moments(m).normal;
  if (plane.isZero(0)) return place;
  QuadricFit fit(frame_around(plane), std::sqrt(distances_sq.back()));
  for (std::size_t i = 0; i < near.size(); ++i) {
    fit.add(positions.x[near[i]] - positions.x[at]);
    if (i + 1 == few) place.few = fit.variance();
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

/// Points of the cloud, evenly spaced by index.
struct Sample {
  const Positions& positions;
  std::size_t count = std::min(kSample, positions.x.size());

  Index operator[](std::size_t i) const { return static_cast<Index>(i * positions.x.size() / count); }
};

/// Spacing and noise of neighbourhoods of two sizes.
struct Grain {
  double spacing = kNaN, noise = kNaN;
  double roughness = kNaN;  ///< noise over the radius of the larger ones
};

Grain measure_grain(const Sample& sample, std::size_t few, std::size_t many, const Execution& run) {
  std::vector<Place> places(sample.count);
  parallel_for(sample.count, kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) places[i] = measure_place(sample.positions, sample[i], few, many);
  });
  const auto a = static_cast<double>(few), b = static_cast<double>(many);
  const double of_few = median(places, &Place::few) / median_share(a - 6);
  const double of_many = median(places, &Place::many) / median_share(b - 6);
  const double growth = std::pow(b / a, 3);  // (ratio of the radii)^6
  Grain grain;
  grain.spacing = std::sqrt(median(places, &Place::area));
  grain.noise = std::sqrt(std::max(0.0, (growth * of_few - of_many) / (growth - 1)));
  grain.roughness = grain.noise / (grain.spacing * std::sqrt(b / kPi));
  return grain;
}

/// Noise hides in neighbourhoods that are no wider than it is: then they grow, as long as that makes them flatter.
Grain measure_grain(const Sample& sample, const Execution& run) {
  constexpr double kRough = 0.2;
  Grain grain = measure_grain(sample, kCounts[0], kCounts[1], run);
  for (std::size_t i = 2; i < kCounts.size() && grain.roughness > kRough; ++i) {
    if (sample.positions.x.size() < kCounts[i]) break;
    const Grain wider = measure_grain(sample, kCounts[i - 1], kCounts[i], run);
    if (!(wider.roughness < grain.roughness)) break;
    grain = wider;
  }
  return grain;
}

/// Square of the difference between the fits in two balls, and the part of it that noise of variance 1 explains. The
/// larger fit is the best linear one of its points, so the variance of the difference is that of the variances.
struct Difference {
  double square, of_noise;
};
Difference of_mean(const BallFit& from, const BallFit& to) {
  return {std::pow(from.mean - to.mean, 2), from.mean_variance - to.mean_variance};
}
Difference of_normal(const BallFit& from, const BallFit& to) {
  if (from.normal.isZero(0) || to.normal.isZero(0)) return {kNaN, kNaN};
  return {(from.normal - to.normal).squaredNorm(), from.normal_variance - to.normal_variance};
}

/// What is left of the squares at the places of the sample, and the mean of what noise explained. Lopsided balls are
/// left out, unless few others are left.
struct Excesses {
  std::vector<double> values;
  double of_noise = 0;
};
using Differ = Difference (*)(const BallFit&, const BallFit&);
Excesses excesses(const std::vector<GrowingBalls>& sample, int rung, double noise, Differ differ) {
  const auto from = static_cast<std::size_t>(rung), to = from + 1;
  const auto lopsided = std::count_if(sample.begin(), sample.end(), [&](const auto& b) { return b[to].lopsided; });
  const bool use_all = 2 * static_cast<std::size_t>(lopsided) > sample.size();
  Excesses result;
  for (const GrowingBalls& balls : sample) {
    const Difference difference = differ(balls[from], balls[to]);
    const double of_noise = noise * noise * difference.of_noise, excess = difference.square - of_noise;
    if (!std::isfinite(excess) || (balls[to].lopsided && !use_all)) continue;
    result.values.push_back(excess);
    result.of_noise += of_noise;
  }
  result.of_noise /= std::max(1.0, static_cast<double>(result.values.size()));
  return result;
}

/// Mean square of the bias, with its standard error.
struct BiasSq {
  double mean = 0, error = 0;
  bool certain(double errors) const { return mean > errors * error; }
};

/// The largest excesses count as the 98th percentile does: a few wild quadrics would hide all others.
BiasSq bias_sq(const std::vector<double>& excess) {
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

double variation_of(const std::vector<GrowingBalls>& sample, double spacing, double noise) {
  constexpr double kLeast = 3, kAmple = 6, kAgreement = 0.4;  // of the square
  for (int rung = kFirstOfMean; rung + 1 < kRungs; ++rung) {
    // A quadric fitted in a disc of radius r has the bias r^2 / 16 times the Laplacian of the mean curvature.
    const auto variation = [&](int r, double mean) {
      return 16 * std::sqrt(mean) / std::pow(radius_of_rung(r, spacing), 2);
    };
    const BiasSq here = bias_sq(excesses(sample, rung, noise, of_mean).values);
    if (!here.certain(kLeast)) continue;
    if (here.certain(kAmple) || rung + 2 == kRungs) return variation(rung, here.mean);
    // What barely passes may be chance, and is too large on average. The next radius knows better where it follows the
    // same law, by which the square grows by four; at edges it does not.
    const BiasSq next = bias_sq(excesses(sample, rung + 1, noise, of_mean).values);
    if (!next.certain(kLeast)) continue;
    const bool agrees = next.mean / 4 > kAgreement * here.mean;
    return agrees ? variation(rung + 1, next.mean) : variation(rung, here.mean);
  }
  return 0;
}

/// The bias of a normal grows with the square of the radius, from one ball to the next by as much as it is.
double gradient_of(const std::vector<GrowingBalls>& sample, double spacing, double noise) {
  constexpr double kLeast = 3, kClear = 0.25, kRough = 0.22, kSteep = 0.12, kAgreement = 0.4;  // of the square
  for (int rung = 0; rung + 1 < kRungs; ++rung) {
    const double radius = radius_of_rung(rung, spacing);
    if (noise > kRough * radius) continue;
    const Excesses excess = excesses(sample, rung, noise, of_normal);
    const BiasSq here = bias_sq(excess.values);
    if (!here.certain(kLeast) || here.mean < kClear * excess.of_noise) continue;
    // Normals do not follow steep noise linearly. What that leaves falls with the radius, where bias grows.
    if (noise > kSteep * radius && rung + 2 < kRungs) {
      const BiasSq next = bias_sq(excesses(sample, rung + 1, noise, of_normal).values);
      if (next.mean / 4 < kAgreement * here.mean) continue;
    }
    return 6 * std::sqrt(here.mean) / (radius * radius);
  }
  return 0;
}

}  // namespace

CloudScale measure_scale(const std::vector<Vec3>& points, const Execution& run) {
  return measure_scale(Positions(points), run);
}

CloudScale measure_scale(const Positions& positions, const Execution& run) {
  CloudScale scale;
  if (positions.x.size() < kCounts[1]) return scale;
  const Sample sample{positions};
  const Grain grain = measure_grain(sample, stage(run, 0.5, 0.6));
  std::vector<GrowingBalls> balls(sample.count);
  parallel_for(sample.count, kBlock, stage(run, 0.6, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) balls[i] = fit_growing_balls(positions, sample[i], grain.spacing);
  });
  scale.spacing = grain.spacing;
  scale.noise = grain.noise;
  scale.variation = variation_of(balls, scale.spacing, scale.noise);
  scale.gradient = gradient_of(balls, scale.spacing, scale.noise);
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

double normal_noise(const CloudScale& scale, double normal_radius) {
  return std::sqrt(8 / kPi) * scale.noise * scale.spacing / (normal_radius * normal_radius);
}

double normal_bias(const CloudScale& scale, double normal_radius) {
  return scale.gradient * normal_radius * normal_radius / 6;
}

double balanced_normal_radius(const CloudScale& scale, double from, double to) {
  return crossing(from, to, [&](double radius) { return normal_noise(scale, radius) - normal_bias(scale, radius); });
}

double balanced_radius(const CloudScale& scale, double normal_radius, double from, double to) {
  return crossing(from, to, [&](double radius) {
    return curvature_noise(scale, radius, normal_radius) - curvature_bias(scale, radius, normal_radius);
  });
}

}  // namespace kappa
