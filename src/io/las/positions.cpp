// SPDX-License-Identifier: BSD-3-Clause
#include "positions.hpp"

#include <algorithm>
#include <cmath>

#include "io/pace.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

namespace {

constexpr double kLargest = 2147483647.0;  // of a stored coordinate
constexpr double kWholeNumbers = 0x1p53;   // up to there a double holds them all

/// 10^exponent, correctly rounded.
double power_of_ten(int exponent) {
  return std::stod("1e" + std::to_string(exponent));
}

bool all_whole(const Scan& scan, int axis, double offset, double scale, double tolerance, const Execution& run) {
  return !any_row(scan.points.size(), run, [&](std::size_t i) {
    const double x = scan.points[i][axis] - offset;
    return !(std::abs(std::round(x / scale) * scale - x) <= tolerance);
  });
}

/// Exponent of the least power of ten that divides the extent into at most 4e9 steps, of which 32 bits hold half
/// on each side.
int finest_exponent(double extent) {
  int exponent = static_cast<int>(std::ceil(std::log10(extent / 4e9)));
  while (extent / power_of_ten(exponent) > 4e9) ++exponent;
  return exponent;
}

/// A whole number of the largest power of ten within the extent, near the middle; 0 near 0.
double local_offset(double min, double max) {
  if (min == max) return min;
  if (min <= 0 && max >= 0) return 0.0;
  const double unit = power_of_ten(static_cast<int>(std::floor(std::log10(max - min))));
  return std::round((min + 0.5 * (max - min)) / unit) * unit;
}

double choose_scale(const Scan& scan, int axis, double offset, double extent, const Execution& run) {
  constexpr int kUsual = -3, kTiny = -300;
  if (!(extent > 0)) return power_of_ten(kUsual);
  const int finest = std::max(finest_exponent(extent), kTiny);
  const double tolerance = 1e-4 * power_of_ten(finest);
  for (int exponent = kUsual; exponent > finest; --exponent) {
    if (all_whole(scan, axis, offset, power_of_ten(exponent), tolerance, silent(run))) return power_of_ten(exponent);
  }
  return power_of_ten(finest);
}

std::string coordinate_name(std::size_t point, int axis) {
  return std::string(1, "xyz"[axis]) + " of point " + std::to_string(point);
}

}  // namespace

void choose_grid(const Scan& scan, LasFile& las, const Execution& run) {
  const Bounds box = bounds(scan.points);
  for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
    const double offset = local_offset(box.min[axis], box.max[axis]);
    const double reach = std::max(box.max[axis] - offset, offset - box.min[axis]);
    las.scale[axis] = choose_scale(scan, axis, offset, 2 * reach, run);
    las.offset[axis] = scan.origin[axis] + offset;
  }
}

LasPositions::LasPositions(const Scan& scan, const LasFile& las)
    : scan_(scan), las_(las_of(scan)), scale_(las.scale), shift_(scan.origin - las.offset), offset_(las.offset) {
  if (!las_ || scan.points.empty()) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::round(scan.points[0][axis] / scale_[axis]);
    if (!(std::abs(steps) < kWholeNumbers)) continue;
    const auto first = stored_position(*las_, 0)[static_cast<std::size_t>(axis)];
    const std::int64_t centre = first - static_cast<std::int64_t>(steps);
    if (static_cast<double>(centre) * scale_[axis] + offset_[axis] != scan.origin[axis]) continue;
    centre_[static_cast<std::size_t>(axis)] = centre;
  }
}

bool LasPositions::is_unmoved(std::size_t point, int axis, std::int32_t stored) const {
  const auto& centre = centre_[static_cast<std::size_t>(axis)];
  return centre && static_cast<double>(stored - *centre) * scale_[axis] == scan_.points[point][axis];
}

std::int32_t LasPositions::stored(std::size_t point, int axis) const {
  const double value = scan_.points[point][axis];
  const double steps = std::round((value + shift_[axis]) / scale_[axis]);
  if (std::abs(steps) <= kLargest) return static_cast<std::int32_t>(steps);
  if (!std::isfinite(value)) {
    throw Error(ErrorCode::InvalidArgument, coordinate_name(point, axis) +
                                                " is not finite, which LAS cannot hold: write .pcd or .ply, or leave "
                                                "such points out first");
  }
  throw Error(ErrorCode::InvalidArgument,
              coordinate_name(point, axis) + " is " + std::to_string(scan_.origin[axis] + value) +
                  ", too far from the offset " + std::to_string(offset_[axis]) + " of its LAS file for a scale of " +
                  std::to_string(scale_[axis]) + ": write .pcd or .ply, or reset Scan::records");
}

LasPosition LasPositions::operator()(std::size_t point) const {
  LasPosition position{};
  const LasPosition recorded = las_ ? stored_position(*las_, point) : position;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    position[a] = las_ && is_unmoved(point, axis, recorded[a]) ? recorded[a] : stored(point, axis);
  }
  return position;
}

}  // namespace kappa::io
