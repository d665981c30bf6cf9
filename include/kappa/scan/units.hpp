// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Whether x and y are degrees, in which no curvature can be measured. If the file states it (Scan::geographic), this
/// decides. Otherwise x and y are taken for degrees if they could be longitude and latitude, span less than 2, and the
/// heights span more than 100 times as much: a degree is about 100 km, and no terrain is that steep.
bool looks_geographic(const Scan& scan);

/// Brings the heights of a scan into the unit of x and y, and back to the very bits.
class HeightUnit {
 public:
  /// `z_scale` is the length of a unit of height in units of x and y.
  /// @throws Error InvalidArgument unless it is positive and finite.
  explicit HeightUnit(double z_scale = 1);

  /// Multiplies the heights of points, origin and viewpoint by z_scale(). The normals are turned: they stay
  /// perpendicular to the surface and keep their length.
  /// @throws Cancelled, and Error as `thread_count` does.
  void apply(Scan& scan, const Execution& run = {});
  /// Undoes `apply`. The scan must have the same points.
  /// @throws Cancelled.
  void restore(Scan& scan, const Execution& run = {}) const;

  double z_scale() const { return z_scale_; }

  // What a position, a normal, and a direction along the surface are in the coordinates of the file, given in the unit
  // of x and y. Normals and directions keep their length.
  Vec3 point_of_file(const Vec3& point) const;
  Vec3 normal_of_file(const Vec3& normal) const;
  Vec3 direction_of_file(const Vec3& direction) const;

 private:
  double z_scale_;
  std::vector<double> heights_;  ///< of the points before `apply`, as all that follows
  Normals normals_;
  double origin_height_ = 0;
  std::optional<Vec3> viewpoint_;
};

}  // namespace kappa
