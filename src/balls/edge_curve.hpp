// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// A point of a curve on a surface, with the unit normal of the surface and its
/// shape operator, du = shape dx; NaN where that is not known.
struct CurvePoint {
  Vec3 x, u;
  Mat3 shape = Mat3::Constant(kNaN);
};

/// The middle of the curve over the edge from `a` to `b`; the same bits with a and b exchanged. See `measure_refined`.
CurvePoint curved_midpoint(const CurvePoint& a, const CurvePoint& b);

/// The middle of a polygon, which on flat ones is the mean of the corners: of an even number, that of the middles of
/// opposite corners; of an odd one, the mean of the points 1 / count of the way from the middle of the others to each,
/// of 11 and more to three of them alone. Corners must not be none.
CurvePoint curved_centre(std::vector<CurvePoint> corners);

}  // namespace kappa
