// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/orders.hpp"

#include <array>
#include <cmath>
#include <string>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

/// Lagrange weights at 0 of the nodes rho^2 = 1, 1/2, 1/4.
constexpr std::array<OrderWeights, kMaxOrder> kWeights = {{{1, 0, 0}, {-1, 2, 0}, {1.0 / 3, -2, 8.0 / 3}}};

CurvatureRatios combine(const CurvatureRatios* balls, int order, const OrderWeights& weights) {
  CurvatureRatios sum;
  sum.mean = sum.gaussian = 0;
  sum.form = {0, 0, 0};
  sum.status = PointStatus::Valid;
  for (int b = 0; b < order; ++b) {
    const double w = weights[static_cast<std::size_t>(b)];
    sum.mean += w * balls[b].mean;
    sum.gaussian += w * balls[b].gaussian;
    for (std::size_t i = 0; i < 3; ++i) sum.form[i] += w * balls[b].form[i];
  }
  return sum;
}

double distance(const CurvatureRatios& a, const CurvatureRatios& b) {
  const double d11 = a.form[0] - b.form[0], d12 = a.form[1] - b.form[1], d22 = a.form[2] - b.form[2];
  return std::sqrt(0.5 * (d11 * d11 + d22 * d22) + d12 * d12);
}

}  // namespace

void check_order(int order) {
  if (order >= 1 && order <= kMaxOrder) return;
  throw Error(ErrorCode::InvalidArgument, "order = " + std::to_string(order) + ": give 1, 2 or 3");
}

std::vector<double> order_radii(double radius, int order) {
  check_order(order);
  std::vector<double> radii = {radius, radius * std::sqrt(0.5), radius / 2};
  radii.resize(static_cast<std::size_t>(order));
  return radii;
}

const OrderWeights& order_weights(int order) {
  check_order(order);
  return kWeights[static_cast<std::size_t>(order - 1)];
}

OrderedRatios extrapolate(const CurvatureRatios* balls, int order) {
  OrderedRatios result;
  for (int b = 0; b < order; ++b) {
    result.ratios.status = balls[b].status;
    if (balls[b].status != PointStatus::Valid) return result;
  }
  const auto row = static_cast<std::size_t>(order - 1);
  result.ratios = combine(balls, order, kWeights[row]);
  if (order > 1) result.std_error = distance(result.ratios, combine(balls, order - 1, kWeights[row - 1]));
  return result;
}

}  // namespace kappa
