// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/compare.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

/// The vectors that three fields hold the coordinates of; empty if one of them is missing.
std::vector<Vec3> vectors(const Scan& scan, const std::string& name, const std::string& suffix) {
  const Field *x = scan.field(name + "_x" + suffix), *y = scan.field(name + "_y" + suffix),
              *z = scan.field(name + "_z" + suffix);
  std::vector<Vec3> result;
  if (!x || !y || !z) return result;
  for (std::size_t i = 0; i < x->values.size(); ++i) result.emplace_back(x->values[i], y->values[i], z->values[i]);
  return result;
}

/// Angles between lines, in degrees.
std::vector<double> angles_between(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<double> angles(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    angles[i] = std::atan2(a[i].cross(b[i]).norm(), std::abs(a[i].dot(b[i]))) * 180 / kPi;
  return angles;
}

void check_positions(const Scan& result, const Scan& truth, double tolerance) {
  if (result.points.size() != truth.points.size())
    throw Error(ErrorCode::InvalidData, "the result has " + std::to_string(result.points.size()) +
                                            " points and the truth " + std::to_string(truth.points.size()) +
                                            ": compare results for the same points in the same order");
  const double allowed = std::max(tolerance, 1e-6 * bounds(truth.points).diagonal());
  const Vec3 shift = result.origin - truth.origin;
  for (std::size_t i = 0; i < truth.points.size(); ++i) {
    const double distance = (result.points[i] + shift - truth.points[i]).norm();
    if (distance > allowed)
      throw Error(ErrorCode::InvalidData,
                  "point " + std::to_string(i) + " of the result is " + std::to_string(distance) +
                      " away from that of the truth: compare results for the same points in the same order");
  }
}

}  // namespace

ErrorStatistics compare_values(const std::vector<double>& result, const std::vector<double>& truth) {
  if (result.size() != truth.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(result.size()) + " values to compare with " +
                                                std::to_string(truth.size()) + ": give equally many");
  ErrorStatistics s;
  std::vector<double> errors;
  double sum = 0, sum_sq = 0, truth_sq = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double error = result[i] - truth[i];
    if (!std::isfinite(error)) continue;
    errors.push_back(std::abs(error));
    sum += error;
    sum_sq += error * error;
    truth_sq += truth[i] * truth[i];
  }
  s.compared = errors.size();
  s.missing = result.size() - errors.size();
  if (errors.empty()) return s;
  const double n = static_cast<double>(errors.size());
  s.max = percentile(errors, 100);
  s.rms = std::sqrt(sum_sq / n);
  s.mean = sum / n;
  s.truth_rms = std::sqrt(truth_sq / n);
  s.p50 = percentile(errors, 50);
  s.p90 = percentile(errors, 90);
  s.p99 = percentile(errors, 99);
  return s;
}

std::vector<ErrorStatistics> compare_scans(const Scan& result, const Scan& truth, const std::string& suffix,
                                           double position_tolerance) {
  check_positions(result, truth, position_tolerance);
  std::vector<ErrorStatistics> all;
  for (const char* name : {"mean_curvature", "gaussian_curvature", "k_min", "k_max"}) {
    const Field *a = result.field(name + suffix), *b = truth.field(name);
    if (!a || !b) continue;
    all.push_back(compare_values(a->values, b->values));
    all.back().field = name;
  }
  for (const char* name : {"dir_min", "dir_max"}) {
    const std::vector<Vec3> a = vectors(result, name, suffix), b = vectors(truth, name, "");
    if (a.empty() || b.empty()) continue;
    all.push_back(compare_values(angles_between(a, b), std::vector<double>(a.size(), 0.0)));
    all.back().field = name;
  }
  if (all.empty())
    throw Error(ErrorCode::InvalidData, "the two have no curvature field in common (mean_curvature" + suffix +
                                            ", gaussian_curvature" + suffix + ", k_min" + suffix + ", k_max" + suffix +
                                            ")");
  return all;
}

}  // namespace kappa
