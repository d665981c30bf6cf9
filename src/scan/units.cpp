// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/units.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 16384;

/// The vector with its height multiplied, of the length that it had. Where heights are multiplied, directions along the
/// surface are stretched alike, its normals by the inverse.
Vec3 stretched(const Vec3& v, double factor) {
  const double length = v.norm();
  const Vec3 turned(v.x(), v.y(), v.z() * factor);
  return length > 0 ? (turned * (length / turned.norm())).eval() : v;
}

bool geographic_by_extent(const Scan& scan) {
  constexpr double kWidest = 2, kSteepest = 100;
  const Bounds box = bounds(scan.points);
  if (box.empty()) return false;
  const Vec3 size = box.max - box.min, low = scan.origin + box.min, high = scan.origin + box.max;
  const bool on_globe = low.x() >= -180 && high.x() <= 180 && low.y() >= -90 && high.y() <= 90;
  const double width = std::max(size.x(), size.y());
  return on_globe && width > 0 && width < kWidest && size.z() > kSteepest * width;
}

}  // namespace

bool looks_geographic(const Scan& scan) {
  return scan.geographic.value_or(false) || (!scan.geographic && geographic_by_extent(scan));
}

HeightUnit::HeightUnit(double z_scale) : z_scale_(z_scale) {
  if (z_scale > 0 && std::isfinite(z_scale)) return;
  throw Error(ErrorCode::InvalidArgument,
              "heights cannot be scaled by " + std::to_string(z_scale) + ": give a positive number");
}

void HeightUnit::apply(Scan& scan, const Execution& run) {
  if (z_scale_ == 1) return;
  std::vector<double> heights(scan.points.size());
  parallel_for(heights.size(), kBlock, stage(run, 0.0, 0.5), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) heights[i] = scan.points[i].z();
  });
  Normals normals(scan.normals.size());
  parallel_for(normals.size(), kBlock, stage(run, 0.5, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) normals[i] = stretched(scan.normals[i], 1 / z_scale_);
  });
  // From here on nothing can be cancelled: whoever cancels finds the scan as it was.
  for (Vec3& p : scan.points) p.z() *= z_scale_;
  heights_ = std::move(heights);
  normals_ = std::exchange(scan.normals, std::move(normals));
  origin_height_ = scan.origin.z();
  scan.origin.z() *= z_scale_;
  viewpoint_ = scan.viewpoint;
  if (scan.viewpoint) scan.viewpoint->z() *= z_scale_;
}

void HeightUnit::restore(Scan& scan, const Execution& run) const {
  if (z_scale_ == 1) return;
  Normals normals = normals_;
  report_progress(run, 1.0);
  for (std::size_t i = 0; i < scan.points.size(); ++i) scan.points[i].z() = heights_[i];
  scan.normals = std::move(normals);
  scan.origin.z() = origin_height_;
  scan.viewpoint = viewpoint_;
}

Vec3 HeightUnit::point_of_file(const Vec3& point) const {
  return {point.x(), point.y(), point.z() / z_scale_};
}

Vec3 HeightUnit::normal_of_file(const Vec3& normal) const {
  return z_scale_ == 1 ? normal : stretched(normal, z_scale_);
}

Vec3 HeightUnit::direction_of_file(const Vec3& direction) const {
  return z_scale_ == 1 ? direction : stretched(direction, 1 / z_scale_);
}

}  // namespace kappa
