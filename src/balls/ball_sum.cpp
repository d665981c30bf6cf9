// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/ball_sum.hpp"

#include <array>
#include <cmath>
#include <string>

#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/triangle_ball.hpp"

namespace kappa {
namespace {

/// What the part of triangle `t` with this share and centroid has over its share of the whole: the density is
/// linear, so it is that of the normal's difference from the mean normal.
MeasureSum density_excess(const Triangles& triangles, std::size_t t, const TriangleShare& part) {
  const auto& c = triangles.corners[t];
  const Vec3 &x0 = triangles.x[c[0]], &u0 = triangles.u[c[0]];
  const Vec3 d1 = triangles.u[c[1]] - u0, d2 = triangles.u[c[2]] - u0;
  const Vec3 difference = (part.b1 - 1.0 / 3) * d1 + (part.b2 - 1.0 / 3) * d2;
  MeasureSum m = triangle_density_sum(triangles.x[c[1]] - x0, triangles.x[c[2]] - x0, d1, d2, difference);
  m.area = 0;
  m *= triangles.weight(t);
  return m;
}

}  // namespace

const std::vector<Named<BallDefinition>>& names_of(BallDefinition) {
  static const std::vector<Named<BallDefinition>> names = {
      {BallDefinition::ExactDensity, "exact", "the integral of the density over the part inside"},
      {BallDefinition::AreaFraction, "fraction", "the measures of the face times the share of its area inside"}};
  return names;
}

bool add_triangle_in_ball(const Triangles& triangles, std::size_t t, const MeasureSum& whole, const Vec3& centre,
                          double radius, BallDefinition ball, BallMeasures& to) {
  const auto& c = triangles.corners[t];
  const std::array<Vec3, 3> x = {triangles.x[c[0]] - centre, triangles.x[c[1]] - centre, triangles.x[c[2]] - centre};
  const TriangleShare part = triangle_ball_share(x, radius);
  if (!part.met) return false;
  ++to.face_count;
  MeasureSum m = whole;
  if (ball == BallDefinition::ExactDensity && part.share > 0 && part.share < 1) m += density_excess(triangles, t, part);
  m *= part.share;
  to.sum += m;
  return true;
}

BallRadii BallRadii::of_each(std::vector<double> radii, std::size_t count) {
  BallRadii own(std::move(radii));
  own.count_ = count;
  own.common_ = false;
  return own;
}

void BallRadii::check(std::size_t centres) const {
  if (!common_) check_one_each(radii_.size(), "radius", centres * count_, "ball");
  for (const double radius : radii_) {
    if (std::isfinite(radius) && (radius > 0 || (radius == 0 && !common_))) continue;
    throw Error(ErrorCode::InvalidArgument,
                "radius = " + std::to_string(radius) + ": a ball needs a positive, finite radius");
  }
}

void BallSum::sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
                  const Sink& sink) const {
  radii.check(centres.size());
  if (radii.count() > 0) do_sum(centres, radii, ball, run, sink);
}

BruteForceBallSum::BruteForceBallSum(Triangles triangles, const Execution& run)
    : triangles_(std::move(triangles)), measures_(measure_triangles(triangles_, run)) {}

void BruteForceBallSum::do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball,
                               const Execution& run, const Sink& sink) const {
  parallel_for(centres.size(), 16, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<BallMeasures> sums;
    for (std::size_t q = begin; q < end; ++q) {
      sums.assign(radii.count(), {});
      for (std::size_t r = 0; r < radii.count() && is_finite(centres[q]); ++r) {
        const double radius = radii.of(q)[r];
        for (std::size_t t = 0; t < triangles_.size() && radius > 0; ++t)
          add_triangle_in_ball(triangles_, t, measures_[t], centres[q], radius, ball, sums[r]);
      }
      sink(q, sums.data());
    }
  });
}

}  // namespace kappa
