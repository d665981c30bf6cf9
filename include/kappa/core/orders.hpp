// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/core/curvatures.hpp"

namespace kappa {

/// The highest order at which bias is cancelled, see `extrapolate`.
inline constexpr int kMaxOrder = 3;

/// Checks an order.
/// @throws Error InvalidArgument unless it is 1, 2 or 3.
void check_order(int order);

/// The radii of the balls from which an estimate of this order at the scale `radius` is made. They are the first
/// `order` of radius, radius / sqrt(2), radius / 2.
/// @throws Error InvalidArgument unless `order` is 1, 2 or 3.
std::vector<double> order_radii(double radius, int order);

/// One weight for each ball of an estimate; 0 for the balls that the estimate does not use.
using OrderWeights = std::array<double, kMaxOrder>;

/// The weights of the balls of `order_radii` in an estimate of this order. Their sum is 1.
/// @throws Error InvalidArgument unless `order` is 1, 2 or 3.
const OrderWeights& order_weights(int order);

/// An estimate with the spread between its order and the order below.
struct OrderedRatios {
  CurvatureRatios ratios;
  double std_error = kNaN;  ///< 1/length; NaN at order 1
};

/// Curvature ratios whose bias is cancelled over scales.
///
/// On a smooth surface with smooth normals a ratio Q of a ball of radius rho has a bias c2 rho^2 + c4 rho^4 + ... Balls
/// of several radii around one point cancel it (Richardson's extrapolation in rho^2):
///     order 1:  Q(rho)                                                    bias of order rho^2
///     order 2:  2 Q(rho / sqrt 2) - Q(rho)                                bias of order rho^4
///     order 3:  8/3 Q(rho / 2) - 2 Q(rho / sqrt 2) + 1/3 Q(rho)           bias of order rho^6
/// In turn, the noise of the smaller balls is amplified.
///
/// `balls` are `order` ratios, those of the balls with the radii `order_radii(rho, order)`. `order` must be 1, 2 or 3;
/// this is not checked. If a ball is not valid, the estimate has the status of the first such ball and no value: there
/// is no silent fall to a lower order.
///
/// `std_error` is the distance between the second forms of this order and of the order below, in Frobenius' norm over
/// sqrt(2). So a difference of e in both principal curvatures gives e. Where noise prevails, it is about the error of
/// either principal curvature. Where bias prevails, it is the bias of the order below, which is an upper bound.
OrderedRatios extrapolate(const CurvatureRatios* balls, int order);

}  // namespace kappa
