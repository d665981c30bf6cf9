// SPDX-License-Identifier: BSD-3-Clause
#include "ball_fields.hpp"

#include <algorithm>
#include <array>

#include "core/large_array.hpp"
#include "curvature_sample.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/orders.hpp"

namespace kappa {
namespace {

/// The different balls that radii of one order need, and which of them each radius is made of.
struct DistinctBalls {
  std::vector<double> radii;                              ///< each once
  std::vector<std::array<std::size_t, kMaxOrder>> balls;  ///< of each radius asked for

  DistinctBalls(const std::vector<double>& asked, int order) {
    for (const double radius : asked) {
      std::array<std::size_t, kMaxOrder> of_radius{};
      auto to = of_radius.begin();
      for (const double r : order_radii(radius, order)) *to++ = place_of(r);
      balls.push_back(of_radius);
    }
  }

 private:
  std::size_t place_of(double radius) {
    const auto found = std::find(radii.begin(), radii.end(), radius);
    if (found != radii.end()) return static_cast<std::size_t>(found - radii.begin());
    radii.push_back(radius);
    return radii.size() - 1;
  }
};

}  // namespace

std::vector<CurvatureField> ball_fields(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                                        const BallPlan& plan, const BallObserver& observe, const Execution& run) {
  check_one_each(u.size(), "normal", centres.size(), "centre");
  check_order(plan.order);
  std::vector<CurvatureField> fields;
  for (const double radius : plan.radii)
    fields.push_back({radius, fetched_vector(centres.size(), CurvatureSample(), run), plan.order});
  const DistinctBalls distinct(plan.radii, plan.order);
  balls.sum(centres, distinct.radii, plan.ball, run, [&](std::size_t q, const BallMeasures* measures) {
    if (!usable(centres[q], u[q])) return;
    for (std::size_t r = 0; r < fields.size(); ++r) {
      std::array<const BallMeasures*, kMaxOrder> of_radius{};
      for (std::size_t b = 0; b < of_radius.size(); ++b) of_radius[b] = measures + distinct.balls[r][b];
      fields[r].samples[q] = make_sample(of_radius.data(), plan.order, plan.radii[r], u[q]);
      if (observe) observe(r, q, of_radius.data());
    }
  });
  return fields;
}

}  // namespace kappa
