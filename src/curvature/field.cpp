// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/field.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

}  // namespace

double typical_radius(const CurvatureField& field) {
  if (!field.own_scales()) return field.radius;
  std::vector<double> radii;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status == PointStatus::Valid) radii.push_back(s.radius);
  }
  return percentile(radii, 50);
}

void mark_borders(CurvatureField& field, double least, const Execution& run) {
  if (!(least >= 0 && least <= 1))
    throw Error(ErrorCode::InvalidArgument,
                "least coverage = " + std::to_string(least) + ": give the share of the ball to be filled, 0 to 1");
  if (field.radius == 0)
    throw Error(ErrorCode::InvalidArgument,
                "least coverage: at radius 0 there is no ball to be covered; give a radius");
  parallel_for(field.samples.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      CurvatureSample& s = field.samples[i];
      if (s.k.status != PointStatus::Valid || s.coverage >= least) continue;
      s.k = Curvatures();
      s.k.status = PointStatus::Border;
      s.std_error = kNaN;
    }
  });
}

FieldSummary::Percentiles percentiles(std::vector<double>& values) {
  const std::vector<double> p = percentiles(values, {1, 50, 99});
  return {p[0], p[1], p[2]};
}

FieldSummary summarise(const CurvatureField& field, const Execution& run) {
  FieldSummary summary;
  std::vector<double> mean, gaussian, k_min, k_max;
  for (auto* values : {&mean, &gaussian, &k_min, &k_max}) values->reserve(field.samples.size());
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    if (i % kBlock == 0) check_cancelled(run);
    const CurvatureSample& s = field.samples[i];
    switch (s.k.status) {
      case PointStatus::Valid:
        ++summary.valid;
        break;
      case PointStatus::Empty:
        ++summary.empty;
        break;
      case PointStatus::Degenerate:
        ++summary.degenerate;
        break;
      case PointStatus::Invalid:
        ++summary.invalid;
        break;
      case PointStatus::Border:
        ++summary.border;
        break;
    }
    if (s.k.status != PointStatus::Valid) continue;
    mean.push_back(s.k.mean);
    gaussian.push_back(s.k.gaussian);
    k_min.push_back(s.k.k_min);
    k_max.push_back(s.k.k_max);
  }
  const std::pair<FieldSummary::Percentiles*, std::vector<double>*> quantities[] = {
      {&summary.mean, &mean}, {&summary.gaussian, &gaussian}, {&summary.k_min, &k_min}, {&summary.k_max, &k_max}};
  parallel_for(std::size(quantities), 1, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) *quantities[i].first = percentiles(*quantities[i].second);
  });
  return summary;
}

}  // namespace kappa
