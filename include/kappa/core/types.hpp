// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

/// Signed curvature measures of surfaces.
namespace kappa {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;

/// The index of a vertex, point or face.
using Index = std::uint32_t;
/// Stands where there is no index.
inline constexpr Index kNoIndex = std::numeric_limits<Index>::max();

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kPi = 3.14159265358979323846;

/// Corrected unit normals `u`, one for each vertex or point. The zero vector stands where a point has none.
using Normals = std::vector<Vec3>;

/// Whether a point has a curvature, and if not, why. The numbers are the values of the field `status` in files.
enum class PointStatus : std::uint8_t {
  Valid = 0,
  Empty = 1,       ///< no face in the ball
  Degenerate = 2,  ///< the corrected area mu0 vanishes: |mu0| <= 1e-12 area
  Invalid = 3,     ///< the point or its normal is missing, infinite or NaN
  Border = 4       ///< the faces fill less of the ball than was asked for
};

/// Whether all three coordinates are finite.
inline bool is_finite(const Vec3& v) {
  return v.allFinite();
}

}  // namespace kappa
