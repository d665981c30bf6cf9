// SPDX-License-Identifier: BSD-3-Clause
#include "curvature_sample.hpp"

#include <array>

#include "kappa/core/orders.hpp"

namespace kappa {

bool usable(const Vec3& x, const Vec3& u) {
  return is_finite(x) && is_finite(u) && !u.isZero(0);
}

CurvatureRatios ratios_of(const BallMeasures& ball, const Vec3& u) {
  if (ball.face_count > 0) return curvature_ratios(ball.sum, u);
  CurvatureRatios empty;
  empty.status = PointStatus::Empty;
  return empty;
}

CurvatureSample make_sample(const BallMeasures* const* balls, int order, double radius, const Vec3& u) {
  std::array<CurvatureRatios, kMaxOrder> ratios;
  for (int b = 0; b < order; ++b) ratios[static_cast<std::size_t>(b)] = ratios_of(*balls[b], u);
  const OrderedRatios of_order = extrapolate(ratios.data(), order);
  const BallMeasures& ball = *balls[0];
  CurvatureSample s;
  s.k = curvatures(of_order.ratios, u);
  s.std_error = of_order.std_error;
  s.radius = radius;
  s.order = order;
  s.face_count = ball.face_count;
  s.area = ball.sum.area;
  s.mu0 = ball.sum.mu0;
  s.mu1 = ball.sum.mu1();
  s.mu2 = ball.sum.mu2;
  if (radius > 0) s.coverage = s.area / (kPi * radius * radius);
  return s;
}

}  // namespace kappa
