// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "kappa/scan/scan.hpp"

namespace kappa {

/// Whether x and y are degrees, in which no curvature can be measured. What the file states (Scan::geographic) decides;
/// without a statement, whether x and y could be longitude and latitude, span less than 2, and heights span more than
/// 100 times that.
bool looks_geographic(const Scan& scan);

/// Brings the heights of a scan into the unit of x and y, and back to the very bits.
class HeightUnit {
 public:
  /// `z_scale`: units of x and y in a unit of height.
  /// @throws Error InvalidArgument unless it is positive and finite.
  explicit HeightUnit(double z_scale = 1);

  /// Multiplies the heights of the points, of the origin and of the viewpoint, and turns the normals along: they stay
  /// perpendicular to the surface, and as long as they were.
  void apply(Scan& scan);
  /// Undoes `apply` on the scan with the same points.
  void restore(Scan& scan) const;

  double z_scale() const { return z_scale_; }
  /// What a position, a normal and a direction along the surface in the unit of x and y are in the coordinates of the
  /// file; normals and directions keep their length.
  Vec3 point_of_file(const Vec3& point) const;
  Vec3 normal_of_file(const Vec3& normal) const;
  Vec3 direction_of_file(const Vec3& direction) const;

 private:
  double z_scale_;
  std::vector<double> heights_;  ///< before, and what else changed with them
  Normals normals_;
  double origin_height_ = 0;
  std::optional<Vec3> viewpoint_;
};

}  // namespace kappa
