// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa::test {

/// A triangle relative to the centre of a ball.
struct BallCase {
  std::array<Vec3, 3> x;
  double radius = 1;
};

/// Ways a triangle and a ball can meet, each as hard as the contract of `triangle_ball_share` allows: longest edge from
/// 1e-4 to 1e4 radii, height over longest edge down to 1e-6.
enum class Family {
  Generic,         ///< any size, the sphere passes near a point of the triangle
  Sliver,          ///< height over longest edge from 1 to 1e-6, log-uniform
  CentreOnCorner,  ///< exactly
  CentreOnEdge,
  CentreInPlane,
  TangentPlane,  ///< distance of the plane r (1 + d), d from 0 to +-1e-2
  TangentEdge,   ///< distance of an edge likewise
  ObtuseNeedle,  ///< the long edge is nearly the sum of the others
  Missed,        ///< near misses
  BallInside,
  TriangleInside,  ///< corners up to the sphere
  CornerOnSphere,
  Giant,  ///< 1e3 to 1e4 radii
  Tiny    ///< 1e-4 to 1e-3 radii, on the sphere
};
inline constexpr int kFamilies = 14;

const char* family_name(Family family);

/// `count` cases of a family, the same for the same seed.
std::vector<BallCase> ball_cases(Family family, std::size_t count, std::uint64_t seed);

/// What rounding may change of the squared distance of a triangle at contact, over radius^2. The foot of the
/// perpendicular is a difference of vectors as long as the farthest corner, s: a dot product, a product and a
/// subtraction leave it off by four units of roundoff of s, and the square of a distance of one radius by twice that.
double distance_rounding(const BallCase& c);

/// Triangle with the longest edge `longest` along t1, the apex above the fraction `foot` of it at `height` longest
/// edges along t2, moved so that its point of barycentric coordinates (b1, b2) is at `place`.
struct TrianglePlan {
  double longest = 1, height = 1, foot = 0.5, b1 = 0, b2 = 0;
};
std::array<Vec3, 3> planned_triangle(const TrianglePlan& plan, const Vec3& t1, const Vec3& t2, const Vec3& place);

/// The case in hexadecimal floats, to be pasted in a test.
std::string describe(const BallCase& c);

}  // namespace kappa::test
