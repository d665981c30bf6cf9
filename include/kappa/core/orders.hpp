// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/core/curvatures.hpp"

namespace kappa {

/// Highest order of bias that is cancelled.
inline constexpr int kMaxOrder = 3;

/// @throws Error InvalidArgument unless order is 1, 2 or 3.
void check_order(int order);

/// Radii of the balls that an estimate of this order at scale `radius` is made of: radius, radius / sqrt(2), radius /
/// 2, as many as the order.
/// @throws Error InvalidArgument unless order is 1, 2 or 3.
std::vector<double> order_radii(double radius, int order);

/// Weights of the balls of `order_radii` in an estimate of this order, 0 past the order; their sum is 1.
/// @throws Error InvalidArgument unless order is 1, 2 or 3.
using OrderWeights = std::array<double, kMaxOrder>;
const OrderWeights& order_weights(int order);

/// An estimate with the spread between its order and the one below.
struct OrderedRatios {
  CurvatureRatios ratios;
  double std_error = kNaN;  ///< 1/length; NaN at order 1
};

/// Curvature with its bias cancelled over scales. Where surface and normals are smooth every ratio of a ball has a bias
/// c2 rho^2 + c4 rho^4 + ...; balls around the same point cancel it: order 2 is 2 Q(rho / sqrt 2) - Q(rho), with a bias
/// of order rho^4; order 3 is 8/3 Q(rho / 2) - 2 Q(rho / sqrt 2) + 1/3 Q(rho), of order rho^6 (Richardson's
/// extrapolation in rho^2). The noise of the smaller balls is amplified in turn: order buys scale.
///
/// `balls[i]` are the ratios of the ball of radius `order_radii(rho, order)[i]`. If one is not valid the estimate has
/// its status and no value: there is no silent fall to a lower order.
///
/// `std_error` is the distance between the second forms of this order and of the one below, in Frobenius' norm over
/// sqrt(2): a difference of e in both principal curvatures is a spread of e. Where noise prevails it is about as large
/// as the error of either principal curvature; where bias prevails it is the bias of the order below, an upper bound.
OrderedRatios extrapolate(const CurvatureRatios* balls, int order);

}  // namespace kappa
