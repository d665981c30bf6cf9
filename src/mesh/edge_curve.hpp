// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace kappa
