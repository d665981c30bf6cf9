// SPDX-License-Identifier: BSD-3-Clause
// Exact answers, degenerate triangles and the identities of triangle_ball_share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/share_of_simplex.hpp"
#include "kappa/core/triangle_ball.hpp"
#include "support/oracles.hpp"
#include "triangle_ball_cases.hpp"

namespace kappa {
namespace {

using Triangle = std::array<Vec3, 3>;
using test::BallCase;
using test::Family;

Vec3 moment(const TriangleShare& s) {
  return s.share == 0 ? Vec3::Zero() : Vec3(s.share, s.share * s.b1, s.share * s.b2);
}
Vec3 moment(const oracle::Share& s) {
  return Vec3(static_cast<double>(s.share), static_cast<double>(s.share * s.b1), static_cast<double>(s.share * s.b2));
}

TEST(TriangleBallShare, MissedHugeTriangleIsExactlyEmpty) {
  const double far = 1e4;
  const std::vector<Triangle> missed = {{Vec3(-far, -far, 1.001), Vec3(far, -far, 1.001), Vec3(0, far, 1.001)},
                                        {Vec3(-far, 1.000001, 0), Vec3(far, 1.000001, 0), Vec3(0, far, 0)},
                                        {Vec3(1.1, 0, 0), Vec3(far, far, 0.5), Vec3(far, -far, 0.5)},
                                        {Vec3(-far, 1.0001, 0), Vec3(far, 1.0001, 1e-3), Vec3(0, 1.0002, 0.5)}};
  for (const Triangle& x : missed) {
    EXPECT_FALSE(triangle_meets_ball(x, 1));
    EXPECT_EQ(triangle_ball_share(x, 1).share, 0.0);
    EXPECT_GT(distance_sq_to_triangle(x), 1.0);
  }
}

TEST(TriangleBallShare, WholeTriangleIsExactlyOne) {
  for (const BallCase& base : test::ball_cases(Family::TriangleInside, 3000, 9)) {
    BallCase c = base;
    for (Vec3& x : c.x) x *= 0.999999;
    const TriangleShare s = triangle_ball_share(c.x, c.radius);
    EXPECT_EQ(s.share, 1.0) << test::describe(c);
    EXPECT_NEAR(s.b1, 1.0 / 3, 1e-16);
    EXPECT_NEAR(s.b2, 1.0 / 3, 1e-16);
  }
}

TEST(TriangleMeetsBall, ClosedBallTouches) {
  // Integer coordinates: the squared distances are exact, so contact is decided exactly.
  EXPECT_TRUE(triangle_meets_ball({Vec3(-8, -8, 5), Vec3(8, -8, 5), Vec3(0, 8, 5)}, 5));  // plane
  EXPECT_TRUE(triangle_meets_ball({Vec3(-7, 3, 0), Vec3(9, 3, 0), Vec3(0, 8, 0)}, 3));    // edge
  EXPECT_TRUE(triangle_meets_ball({Vec3(3, 4, 0), Vec3(9, 4, 1), Vec3(4, 9, -1)}, 5));    // corner
  EXPECT_FALSE(triangle_meets_ball({Vec3(-8, -8, 5), Vec3(8, -8, 5), Vec3(0, 8, 5)}, std::nextafter(5.0, 0.0)));
  EXPECT_FALSE(triangle_meets_ball({Vec3(3, 4, 0), Vec3(9, 4, 1), Vec3(4, 9, -1)}, std::nextafter(5.0, 0.0)));
}

TEST(TriangleMeetsBall, DistanceToFacesEdgesAndCorners) {
  EXPECT_EQ(distance_sq_to_triangle({Vec3(-8, -8, 5), Vec3(8, -8, 5), Vec3(0, 8, 5)}), 25.0);
  EXPECT_EQ(distance_sq_to_triangle({Vec3(-7, 3, 0), Vec3(9, 3, 0), Vec3(0, 8, 0)}), 9.0);
  EXPECT_EQ(distance_sq_to_triangle({Vec3(3, 4, 0), Vec3(9, 4, 1), Vec3(4, 9, -1)}), 25.0);
  EXPECT_EQ(distance_sq_to_triangle({Vec3(-1, -1, 0), Vec3(2, -1, 0), Vec3(-1, 2, 0)}), 0.0);
  EXPECT_EQ(distance_sq_to_triangle({Vec3(1, 2, 2), Vec3(1, 2, 2), Vec3(1, 2, 2)}), 9.0);
  EXPECT_EQ(distance_sq_to_triangle({Vec3(-4, 3, 0), Vec3(4, 3, 0), Vec3(0, 3, 0)}), 9.0);
}

TEST(TriangleMeetsBall, DistanceAgreesWith113Bits) {
  for (int f = 0; f < test::kFamilies; ++f) {
    for (const BallCase& c : test::ball_cases(static_cast<Family>(f), 500, 31)) {
      const double expected = static_cast<double>(1 + oracle::distance_excess(c.x, c.radius));
      const double got = distance_sq_to_triangle(c.x) / (c.radius * c.radius);
      EXPECT_NEAR(got, expected, test::distance_rounding(c) * std::max(1.0, expected)) << test::describe(c);
    }
  }
}

TEST(TriangleBallShare, ClosedForms) {
  // Quarter, half and full discs.
  const Triangle corner = {Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(0, 10, 0)};
  TriangleShare s = triangle_ball_share(corner, 2);
  EXPECT_NEAR(s.share, kPi / 50, 1e-14);
  EXPECT_NEAR(10 * s.b1, 8 / (3 * kPi), 1e-13);
  EXPECT_NEAR(10 * s.b2, 8 / (3 * kPi), 1e-13);
  s = triangle_ball_share({Vec3(-10, 0, 0), Vec3(10, 0, 0), Vec3(0, 10, 0)}, 2);
  EXPECT_NEAR(s.share, 2 * kPi / 100, 1e-14);
  EXPECT_NEAR(10 * s.b2, 8 / (3 * kPi), 1e-13);
  s = triangle_ball_share({Vec3(-10, -9, 3), Vec3(10, -9, 3), Vec3(0, 18, 3)}, 5);
  EXPECT_NEAR(s.share, 16 * kPi / 270, 1e-14);
  EXPECT_NEAR(s.b1, 1.0 / 3, 1e-14);
  EXPECT_NEAR(s.b2, 1.0 / 3, 1e-14);
}

/// Corners at multiples of a direction of small integers: collinear exactly.
TEST(TriangleBallShare, CollinearCorners) {
  std::mt19937_64 random(11);
  const auto some = [&](int n) { return static_cast<double>(static_cast<int>(random() % (2 * n + 1)) - n); };
  for (int i = 0; i < 20000; ++i) {
    const Vec3 base(some(8), some(8), some(8)), along(some(3), some(3), some(3));
    const Triangle x = {base + some(5) * along, base + some(5) * along, base + some(5) * along};
    const double radius = 0.25 + 0.125 * static_cast<double>(random() % 100);
    const Vec3 got = moment(triangle_ball_share(x, radius)), expected = moment(oracle::share_of_collinear(x, radius));
    // A line that touches the ball enters it by the root of a rounding error: allow what 4 ulp of the radius change.
    const double slack = moment(oracle::share_of_collinear(x, radius * (1 + 0x1p-50)))[0] -
                         moment(oracle::share_of_collinear(x, radius * (1 - 0x1p-50)))[0];
    EXPECT_NEAR((got - expected).cwiseAbs().maxCoeff(), 0, kShareError + slack) << test::describe({x, radius});
  }
}

TEST(TriangleBallShare, CoincidentCorners) {
  const Vec3 p(0.3, 0.4, 0);
  EXPECT_EQ(triangle_ball_share({p, p, p}, 0.51).share, 1.0);
  EXPECT_EQ(triangle_ball_share({p, p, p}, 0.49).share, 0.0);
  const Vec3 corner(3, 4, 0);
  EXPECT_EQ(detail::share_of_simplex({corner, corner, corner}, 5).share, 1.0) << "the ball is closed";
  // A segment: the corners x1 and x2 coincide, so the share of the simplex is 1 - (1 - t)^2 from the other end.
  const Vec3 q(0, 0, 0), far(4, 0, 0);
  EXPECT_NEAR(triangle_ball_share({q, far, far}, 1).share, 1.0 / 16, 1e-14);
  EXPECT_NEAR(triangle_ball_share({far, q, q}, 1).share, 1 - 9.0 / 16, 1e-14);
}

/// Almost collinear, below the ratio at which the simplex takes over and just above it.
TEST(TriangleBallShare, ContinuousAtTheDegenerateRatio) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> some(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const double foot = some(random), offset = 0.5 * some(random), start = -2 * some(random);
    for (const double height : {0.3e-12, 0.99e-12, 1.01e-12, 3e-12}) {
      const Triangle x = {Vec3(start, offset, 0), Vec3(start + 2, offset, 0),
                          Vec3(start + 2 * foot, offset, 2 * height)};
      const Vec3 got = moment(triangle_ball_share(x, 1));
      const Vec3 expected = moment(oracle::share_by_clipping(x, 1));
      EXPECT_NEAR((got - expected).cwiseAbs().maxCoeff(), 0, 1e-10) << height << test::describe({x, 1});
    }
  }
}

TEST(TriangleBallShare, GrowsWithTheRadius) {
  for (const Family family : {Family::Generic, Family::Sliver, Family::TangentEdge}) {
    for (const BallCase& c : test::ball_cases(family, 300, 21)) {
      double before = 0;
      for (double factor = 0.5; factor < 2; factor *= 1.01) {
        const double share = triangle_ball_share(c.x, factor * c.radius).share;
        EXPECT_GE(share, before - 2 * kShareError) << test::describe(c) << " factor " << factor;
        EXPECT_LE(share, 1.0);
        EXPECT_GE(share, 0.0);
        before = share;
      }
    }
  }
}

TEST(TriangleBallShare, SameForAnyOrderOfTheCorners) {
  for (int f = 0; f < test::kFamilies; ++f) {
    if (static_cast<Family>(f) == Family::TangentPlane) continue;  // no order is right to 1e-10, see the great test
    for (const BallCase& c : test::ball_cases(static_cast<Family>(f), 300, 22)) {
      const Vec3 a = moment(triangle_ball_share(c.x, c.radius));
      const Vec3 turned = moment(triangle_ball_share({c.x[1], c.x[2], c.x[0]}, c.radius));
      const Vec3 mirrored = moment(triangle_ball_share({c.x[0], c.x[2], c.x[1]}, c.radius));
      EXPECT_NEAR(turned[0], a[0], 2 * kShareError) << test::describe(c);
      EXPECT_NEAR(turned[1], a[2], 2 * kShareError) << test::describe(c);
      EXPECT_NEAR(turned[2], a[0] - a[1] - a[2], 3 * kShareError) << test::describe(c);
      EXPECT_NEAR(mirrored[1], a[2], 2 * kShareError) << test::describe(c);
      EXPECT_NEAR(mirrored[2], a[1], 2 * kShareError) << test::describe(c);
    }
  }
}

TEST(TriangleBallShare, PartsAddUp) {
  for (int f = 0; f < test::kFamilies; ++f) {
    for (const BallCase& c : test::ball_cases(static_cast<Family>(f), 300, 23)) {
      const double scale = std::max({c.x[0].norm(), c.x[1].norm(), c.x[2].norm()});
      const Vec3 e1 = c.x[1] - c.x[0], e2 = c.x[2] - c.x[0];
      const double height = e1.cross(e2).norm() / std::max({e1.norm(), e2.norm(), (e2 - e1).norm()});
      // The rounding of the midpoints moves the parts by this fraction of their height.
      if (1e-16 * scale > 1e-12 * height) continue;
      const Vec3 a = (c.x[0] + c.x[1]) / 2, b = (c.x[1] + c.x[2]) / 2, d = (c.x[2] + c.x[0]) / 2;
      const std::array<Triangle, 4> parts = {{{c.x[0], a, d}, {a, c.x[1], b}, {d, b, c.x[2]}, {a, b, d}}};
      double sum = 0;
      for (const Triangle& part : parts) sum += triangle_ball_share(part, c.radius).share / 4;
      EXPECT_NEAR(sum, triangle_ball_share(c.x, c.radius).share, 1e-9) << test::describe(c);
    }
  }
}

TEST(TriangleBallShare, AnySmallOrLargeUnit) {
  for (const BallCase& c : test::ball_cases(Family::Generic, 1000, 24)) {
    const Vec3 a = moment(triangle_ball_share(c.x, c.radius));
    for (const double unit : {0x1p-60, 0x1p60}) {  // powers of two: nothing is rounded
      const Vec3 b = moment(triangle_ball_share({unit * c.x[0], unit * c.x[1], unit * c.x[2]}, unit * c.radius));
      EXPECT_NEAR((a - b).cwiseAbs().maxCoeff(), 0, kShareError) << test::describe(c) << " unit " << unit;
    }
  }
}

}  // namespace
}  // namespace kappa
