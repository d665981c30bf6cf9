// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/curvature/in_balls.hpp"
#include "kappa/segment/regions.hpp"

namespace kappa {
namespace {

constexpr std::size_t kSample = 20000;

template <class T>
std::vector<T> every(std::size_t step, const std::vector<T>& from) {
  std::vector<T> sample;
  for (std::size_t i = 0; i < from.size(); i += step) sample.push_back(from[i]);
  return sample;
}

/// Where every point has its own scale the error is known already.
double threshold_of_errors(const CurvatureField& field) {
  constexpr double kErrors = 1.5, kLeast = 1e-6;
  std::vector<double> errors;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status == PointStatus::Valid && s.std_error >= 0) errors.push_back(s.std_error);
  }
  const double typical = percentile(errors, 50);
  return std::isnan(typical) ? kNaN : std::max(kErrors * typical, kLeast / typical_radius(field));
}

}  // namespace

double curvature_threshold(const CurvatureField& coarse, const CurvatureField& fine, double scale) {
  if (coarse.samples.size() != fine.samples.size() || !(scale > 0))
    throw Error(ErrorCode::InvalidArgument, "fields of " + std::to_string(coarse.samples.size()) + " and " +
                                                std::to_string(fine.samples.size()) + " points at scale " +
                                                std::to_string(scale) + ": give fields of the same points, scale > 0");
  constexpr double kLeast = 1e-6, kMedians = 1.5;
  std::vector<double> differences;
  for (std::size_t i = 0; i < coarse.samples.size(); ++i) {
    const Curvatures &a = coarse.samples[i].k, &b = fine.samples[i].k;
    if (a.status != PointStatus::Valid || b.status != PointStatus::Valid) continue;
    differences.push_back(std::abs(a.k_min - b.k_min));
    differences.push_back(std::abs(a.k_max - b.k_max));
  }
  const double typical = percentile(differences, 50);
  return std::isnan(typical) ? kNaN : std::max(kMedians * typical, kLeast / scale);
}

double estimate_threshold(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                          const CurvatureField& field, BallDefinition ball, double spacing, const Execution& run) {
  if (field.samples.size() != centres.size() || u.size() != centres.size() || !(spacing > 0))
    throw Error(ErrorCode::InvalidArgument, std::to_string(field.samples.size()) + " samples and " +
                                                std::to_string(u.size()) + " normals for " +
                                                std::to_string(centres.size()) + " centres at spacing " +
                                                std::to_string(spacing) + ": give one each, spacing > 0");
  if (field.own_scales()) return threshold_of_errors(field);
  const std::size_t step = std::max<std::size_t>(1, centres.size() / kSample);
  const double other = field.radius > 0 ? field.radius / 2 : spacing;
  const CurvatureField own{field.radius, every(step, field.samples), field.order};
  const BallPlan finer{{other}, field.order, ball};
  const std::vector<CurvatureField> fine = curvatures_in_balls(balls, every(step, centres), every(step, u), finer, run);
  return curvature_threshold(own, fine.front(), std::max(field.radius, other));
}

double curvature_percentile(const CurvatureField& field, double p) {
  std::vector<double> sizes;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status == PointStatus::Valid) sizes.push_back(std::max(std::abs(s.k.k_min), std::abs(s.k.k_max)));
  }
  return percentile(sizes, p);
}

}  // namespace kappa
