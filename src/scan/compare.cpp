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

constexpr std::size_t kBlock = 16384;

/// Three fields with the coordinates of a vector for each point.
struct VectorField {
  const Field *x, *y, *z;

  VectorField(const Scan& scan, const std::string& name, const std::string& suffix)
      : x(scan.field(name + "_x" + suffix)), y(scan.field(name + "_y" + suffix)), z(scan.field(name + "_z" + suffix)) {}
  bool is_there() const { return x && y && z && !x->values.empty(); }
  std::size_t size() const { return x->values.size(); }
  Vec3 operator[](std::size_t i) const { return {x->values[i], y->values[i], z->values[i]}; }
};

/// Angles between lines, in degrees.
std::vector<double> angles_between(const VectorField& a, const VectorField& b, const Execution& run) {
  std::vector<double> angles(a.size());
  parallel_for(angles.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 u = a[i], v = b[i];
      angles[i] = std::atan2(u.cross(v).norm(), std::abs(u.dot(v))) * 180 / kPi;
    }
  });
  return angles;
}

void check_positions(const Scan& result, const Scan& truth, double tolerance, const Execution& run) {
  if (result.points.size() != truth.points.size())
    throw Error(ErrorCode::InvalidData, "the result has " + std::to_string(result.points.size()) +
                                            " points and the truth " + std::to_string(truth.points.size()) +
                                            ": compare results for the same points in the same order");
  const double allowed = std::max(tolerance, 1e-6 * bounds(truth.points).diagonal());
  const Vec3 shift = result.origin - truth.origin;
  serial_for(truth.points.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double distance = (result.points[i] + shift - truth.points[i]).norm();
      if (distance > allowed)
        throw Error(ErrorCode::InvalidData,
                    "point " + std::to_string(i) + " of the result is " + std::to_string(distance) +
                        " away from that of the truth: compare results for the same points in the same order");
    }
  });
}

}  // namespace

ErrorStatistics compare_values(const std::vector<double>& result, const std::vector<double>& truth,
                               const Execution& run) {
  if (result.size() != truth.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(result.size()) + " values to compare with " +
                                                std::to_string(truth.size()) + ": give equally many");
  ErrorStatistics s;
  std::vector<double> errors;
  double sum = 0, sum_sq = 0, truth_sq = 0;
  serial_for(result.size(), kBlock, stage(run, 0.0, 0.5), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double error = result[i] - truth[i];
      if (!std::isfinite(error)) continue;
      errors.push_back(std::abs(error));
      sum += error;
      sum_sq += error * error;
      truth_sq += truth[i] * truth[i];
    }
  });
  s.compared = errors.size();
  s.missing = result.size() - errors.size();
  if (errors.empty()) return s;
  const double n = static_cast<double>(errors.size());
  s.rms = std::sqrt(sum_sq / n);
  s.mean = sum / n;
  s.truth_rms = std::sqrt(truth_sq / n);
  const std::vector<double> ranked = percentiles(errors, {50, 90, 99, 100});
  s.p50 = ranked[0];
  s.p90 = ranked[1];
  s.p99 = ranked[2];
  s.max = ranked[3];
  report_progress(run, 1.0);
  return s;
}

std::vector<ErrorStatistics> compare_scans(const Scan& result, const Scan& truth, const std::string& suffix,
                                           double position_tolerance, const Execution& run) {
  constexpr double kParts = 10;  // the positions, four numbers, and two directions that take twice as long
  check_positions(result, truth, position_tolerance, stage(run, 0.0, 1 / kParts));
  std::vector<ErrorStatistics> all;
  double part = 1;
  for (const char* name : {"mean_curvature", "gaussian_curvature", "k_min", "k_max"}) {
    const double from = part++;
    const Field *a = result.field(name + suffix), *b = truth.field(name);
    if (!a || !b) continue;
    all.push_back(compare_values(a->values, b->values, stage(run, from / kParts, part / kParts)));
    all.back().field = name;
  }
  for (const char* name : {"dir_min", "dir_max"}) {
    const double from = part, middle = part + 1.5;
    part += 2.5;
    const VectorField a(result, name, suffix), b(truth, name, "");
    if (!a.is_there() || !b.is_there()) continue;
    const std::vector<double> angles = angles_between(a, b, stage(run, from / kParts, middle / kParts)),
                              none(angles.size(), 0.0);
    all.push_back(compare_values(angles, none, stage(run, middle / kParts, part / kParts)));
    all.back().field = name;
  }
  if (all.empty())
    throw Error(ErrorCode::InvalidData, "the two have no curvature field in common (mean_curvature" + suffix +
                                            ", gaussian_curvature" + suffix + ", k_min" + suffix + ", k_max" + suffix +
                                            ")");
  return all;
}

}  // namespace kappa
