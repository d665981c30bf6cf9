// SPDX-License-Identifier: BSD-3-Clause
// The error of triangle_ball_share on a million random cases, each against 113-bit clipping. KAPPA_TEST_CASES sets
// another number; builds with a sanitizer run 20 000.
#include "kappa/core/triangle_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "core/share_by_boundary.hpp"
#include "core/share_by_sectors.hpp"
#include "kappa/core/execution.hpp"
#include "support/oracles.hpp"
#include "triangle_ball_cases.hpp"

namespace kappa {
namespace {

using test::BallCase;
using test::Family;

std::size_t case_count() {
  if (const char* text = std::getenv("KAPPA_TEST_CASES")) return std::strtoul(text, nullptr, 10);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 20'000;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return 20'000;
#else
  return 1'000'000;
#endif
#else
  return 1'000'000;
#endif
}

double error_of(const TriangleShare& got, const oracle::Share& expected) {
  const long double share = std::abs(got.share - expected.share);
  // b1 and b2 are undefined where the share is 0.
  const long double m1 = got.share == 0 ? 0 : got.share * static_cast<long double>(got.b1);
  const long double m2 = got.share == 0 ? 0 : got.share * static_cast<long double>(got.b2);
  const double worst = static_cast<double>(
      std::max({share, std::abs(m1 - expected.share * expected.b1), std::abs(m2 - expected.share * expected.b2)}));
  return std::isnan(worst) ? HUGE_VAL : worst;
}

struct Worst {
  double error = -1;
  BallCase where;
  std::size_t above = 0;       ///< cases above kShareError
  std::size_t wrong_meet = 0;  ///< triangle_meets_ball against the exact distance
  BallCase wrong_where;

  void operator+=(const Worst& o) {
    if (o.error > error) {
      error = o.error;
      where = o.where;
    }
    if (wrong_meet == 0) wrong_where = o.wrong_where;
    above += o.above;
    wrong_meet += o.wrong_meet;
  }
};

/// What a change of the radius by 4 ulp does to the share. Where the plane touches the ball this is the best that can
/// be asked for: a triangle 1e-4 times the ball gains its whole area when the radius grows by 1e-9 of itself.
double uncertainty(const BallCase& c) {
  constexpr double k4Ulp = 0x1p-50;
  return static_cast<double>(oracle::share_by_clipping(c.x, c.radius * (1 + k4Ulp)).share -
                             oracle::share_by_clipping(c.x, c.radius * (1 - k4Ulp)).share);
}

/// Whether emptiness was decided wrongly. Contact may fall either way within what rounding leaves of the squared
/// distance.
bool wrong_emptiness(const BallCase& c, double got, long double expected) {
  const bool meets = triangle_meets_ball(c.x, c.radius);
  if (expected > 0 && got > 0) return !meets;
  const long double excess = oracle::distance_excess(c.x, c.radius);
  if (std::abs(excess) <= test::distance_rounding(c)) return false;
  return meets != (excess < 0) || (excess > 0 && got != 0);
}

void check(Family family, const BallCase& c, Worst& worst) {
  const TriangleShare got = triangle_ball_share(c.x, c.radius);
  const oracle::Share expected = oracle::share_by_clipping(c.x, c.radius);
  Worst w;
  w.error = error_of(got, expected);
  if (family == Family::TangentPlane && w.error > kShareError) w.error = std::max(0.0, w.error - uncertainty(c));
  w.above = w.error > kShareError;
  w.wrong_meet = wrong_emptiness(c, got.share, expected.share);
  w.where = w.wrong_where = c;
  worst += w;
}

Worst run_family(Family family, std::size_t count) {
  constexpr std::size_t kBlock = 500;
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  std::vector<Worst> worst(blocks);
  Execution run;
  run.threads = 0;
  parallel_for(blocks, 1, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t b = begin; b < end; ++b) {
      for (const BallCase& c : test::ball_cases(family, kBlock, 1000 * b + static_cast<std::size_t>(family))) {
        check(family, c, worst[b]);
      }
    }
  });
  Worst all;
  for (const Worst& w : worst) all += w;
  return all;
}

TEST(TriangleBallShare, AgreesWithClippingIn113Bits) {
  const std::size_t per_family = case_count() / test::kFamilies + 1;
  for (int f = 0; f < test::kFamilies; ++f) {
    const Family family = static_cast<Family>(f);
    SCOPED_TRACE(test::family_name(family));
    const Worst w = run_family(family, per_family);
    std::cout << "  " << test::family_name(family) << ": worst error " << w.error << '\n';
    EXPECT_LE(w.error, kShareError) << w.above << " of " << per_family << " cases, worst " << test::describe(w.where);
    EXPECT_EQ(w.wrong_meet, 0U) << "first " << test::describe(w.wrong_where);
  }
}

/// Beyond the contract: slivers of 1e-9 and 1e-11. What is asked for is that the answer stays useful.
TEST(TriangleBallShare, DegradesGently) {
  for (const double height : {1e-9, 1e-11}) {
    double worst = 0;
    BallCase where;
    for (const BallCase& base : test::ball_cases(Family::Generic, 4000, 77)) {
      BallCase c = base;
      // Flatten the triangle towards its first edge.
      const Vec3 e = c.x[1] - c.x[0];
      const double t = (c.x[2] - c.x[0]).dot(e) / e.squaredNorm();
      const Vec3 up = c.x[2] - c.x[0] - t * e;
      c.x[2] = c.x[0] + std::clamp(t, 0.0, 1.0) * e + (height * e.norm() / up.norm()) * up;
      const double error = error_of(triangle_ball_share(c.x, c.radius), oracle::share_by_clipping(c.x, c.radius));
      if (error > worst) {
        worst = error;
        where = c;
      }
    }
    std::cout << "  height / longest edge " << height << ": worst error " << worst << '\n';
    EXPECT_LE(worst, 1e-6) << test::describe(where);
  }
}

TEST(TriangleBallShare, FormsAgreeWhereBothAreSound) {
  for (const BallCase& c : test::ball_cases(Family::Generic, 5000, 5)) {
    const double longest = std::max({(c.x[1] - c.x[0]).norm(), (c.x[2] - c.x[1]).norm(), (c.x[0] - c.x[2]).norm()});
    const double height = (c.x[1] - c.x[0]).cross(c.x[2] - c.x[0]).norm() / longest;
    // Sectors are as large as the disc: they cancel in triangles that are much smaller.
    if (height < 0.1 * c.radius || !triangle_meets_ball(c.x, c.radius)) continue;
    const oracle::Share expected = oracle::share_by_clipping(c.x, c.radius);
    EXPECT_LE(error_of(detail::share_by_sectors(c.x, c.radius), expected), kShareError) << test::describe(c);
    EXPECT_LE(error_of(detail::share_by_boundary(c.x, c.radius), expected), kShareError) << test::describe(c);
  }
}

/// The oracle against an independent one, so that an error of both sides of the great test would show.
TEST(ShareOracle, AgreesWithQuadrature) {
  for (const Family family : {Family::Generic, Family::Sliver, Family::CentreOnEdge, Family::CornerOnSphere}) {
    for (const BallCase& c : test::ball_cases(family, 100, 3)) {
      const double longest = (c.x[1] - c.x[0]).norm() + (c.x[2] - c.x[0]).norm();
      const oracle::Share a = oracle::share_by_clipping(c.x, c.radius);
      // The panels of the quadrature must resolve what the ball holds.
      if (longest > 20 * c.radius || (a.share > 0 && a.share < 1e-4)) continue;
      const oracle::Share b = oracle::share_by_quadrature(c.x, c.radius);
      constexpr double kBound = 1e-11;  // ten times the tolerance of the quadrature
      EXPECT_NEAR(static_cast<double>(a.share), static_cast<double>(b.share), kBound) << test::describe(c);
      EXPECT_NEAR(static_cast<double>(a.share * a.b1), static_cast<double>(b.share * b.b1), kBound);
      EXPECT_NEAR(static_cast<double>(a.share * a.b2), static_cast<double>(b.share * b.b2), kBound);
    }
  }
}

}  // namespace
}  // namespace kappa
