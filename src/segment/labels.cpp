// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/segment/labels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/curvature/in_balls.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 16384;

void refuse(const std::string& what, double value, const std::string& advice) {
  throw Error(ErrorCode::InvalidArgument, what + " = " + std::to_string(value) + ": give " + advice);
}

/// Every `step`-th of the values.
template <class T>
std::vector<T> every(std::size_t step, const std::vector<T>& from, const Execution& run) {
  std::vector<T> sample((from.size() + step - 1) / step);
  serial_for(sample.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sample[i] = from[i * step];
  });
  return sample;
}

/// What `add(sample, values)` adds for every sample of a field.
template <class Add>
std::vector<double> values_of(const CurvatureField& field, const Execution& run, const Add& add) {
  std::vector<double> values;
  serial_for(field.samples.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) add(field.samples[i], values);
  });
  return values;
}

/// The threshold for curvatures that change, or err, by `changes`.
double threshold_of(std::vector<double>& changes, double scale) {
  const double typical = median(changes);
  return std::isnan(typical) ? kNaN : std::max(kThresholdMedians * typical, kLeastTurn / scale);
}

/// The threshold where every point has a radius of its own, and its error is known already.
double threshold_of_errors(const CurvatureField& field, const Execution& run) {
  std::vector<double> errors = values_of(field, run, [](const CurvatureSample& s, std::vector<double>& values) {
    if (s.k.status == PointStatus::Valid && s.std_error >= 0) values.push_back(s.std_error);
  });
  return errors.empty() ? kNaN : threshold_of(errors, typical_radius(field));
}

}  // namespace

std::vector<Label> classify(const CurvatureField& field, double threshold, const Execution& run) {
  if (!(threshold >= 0 && std::isfinite(threshold)))
    refuse("threshold", threshold, "a finite curvature (1/length), 0 or more");
  std::vector<Label> labels(field.samples.size());
  parallel_for(labels.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Curvatures& k = field.samples[i].k;
      labels[i] = classify(k.k_min, k.k_max, threshold);
    }
  });
  return labels;
}

double curvature_threshold(const CurvatureField& coarse, const CurvatureField& fine, double scale,
                           const Execution& run) {
  if (coarse.samples.size() != fine.samples.size() || !(scale > 0))
    throw Error(ErrorCode::InvalidArgument, "fields of " + std::to_string(coarse.samples.size()) + " and " +
                                                std::to_string(fine.samples.size()) + " points at scale " +
                                                std::to_string(scale) + ": give fields of the same points, scale > 0");
  std::vector<double> changes;
  serial_for(coarse.samples.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Curvatures &a = coarse.samples[i].k, &b = fine.samples[i].k;
      if (a.status != PointStatus::Valid || b.status != PointStatus::Valid) continue;
      changes.push_back(std::abs(a.k_min - b.k_min));
      changes.push_back(std::abs(a.k_max - b.k_max));
    }
  });
  return threshold_of(changes, scale);
}

double estimate_threshold(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                          const CurvatureField& field, BallDefinition ball, double spacing, const Execution& run) {
  check_one_each(field.samples.size(), "sample", centres.size(), "centre");
  check_one_each(u.size(), "normal", centres.size(), "centre");
  if (!(spacing > 0)) refuse("spacing", spacing, "the length of an edge, above 0");
  if (field.own_scales()) return threshold_of_errors(field, run);
  const std::size_t step = std::max<std::size_t>(1, centres.size() / kThresholdSample);
  const double other = field.radius > 0 ? field.radius / 2 : spacing;
  const CurvatureField own{field.radius, every(step, field.samples, stage(run, 0.0, 0.02)), field.order};
  const std::vector<Vec3> some = every(step, centres, stage(run, 0.02, 0.04));
  const Normals of_some = every(step, u, stage(run, 0.04, 0.06));
  const BallPlan finer{{other}, field.order, ball};
  const std::vector<CurvatureField> fine = curvatures_in_balls(balls, some, of_some, finer, stage(run, 0.06, 0.98));
  return curvature_threshold(own, fine.front(), std::max(field.radius, other), stage(run, 0.98, 1.0));
}

double curvature_percentile(const CurvatureField& field, double p, const Execution& run) {
  std::vector<double> sizes = values_of(field, run, [](const CurvatureSample& s, std::vector<double>& values) {
    if (s.k.status == PointStatus::Valid) values.push_back(std::max(std::abs(s.k.k_min), std::abs(s.k.k_max)));
  });
  return percentile(sizes, p);
}

void validate(const LabelOptions& options) {
  const double kappa_max = options.kappa_max.value_or(1), flatness = options.flatness.value_or(kFlatness),
               min_region = options.min_region.value_or(0);
  if (!(kappa_max > 0 && std::isfinite(kappa_max))) refuse("kappa_max", kappa_max, "a finite curvature above 0");
  if (!(flatness >= 0 && flatness <= 1)) refuse("flatness", flatness, "a part of kappa_max, 0 to 1");
  if (!(min_region >= 0 && std::isfinite(min_region))) refuse("min_region", min_region, "a finite area, 0 or more");
}

double label_threshold(const LabelOptions& options, const BallSum& balls, const std::vector<Vec3>& centres,
                       const Normals& u, const CurvatureField& field, BallDefinition ball, double spacing,
                       const Execution& run) {
  validate(options);
  if (options.estimates_threshold()) return estimate_threshold(balls, centres, u, field, ball, spacing, run);
  const double kappa_max =
      options.kappa_max ? *options.kappa_max : curvature_percentile(field, kKappaMaxPercentile, run);
  return options.flatness.value_or(kFlatness) * kappa_max;
}

double least_region(const LabelOptions& options, const CurvatureField& field) {
  validate(options);
  const double radius = kRegionRadius * typical_radius(field);
  return options.min_region.value_or(kPi * radius * radius);
}

}  // namespace kappa
