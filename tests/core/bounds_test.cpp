// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/utm_points.hpp"

namespace kappa {
namespace {

using test::utm_points;

TEST(Bounds, OfTheFinitePoints) {
  EXPECT_TRUE(bounds({}).empty());
  EXPECT_EQ(bounds({}).diagonal(), 0);
  EXPECT_TRUE(bounds({Vec3(kNaN, 0, 0)}).empty());
  const Bounds b = bounds({Vec3(1, 5, -2), Vec3(kNaN, 100, 100), Vec3(-3, 2, 0), Vec3(0, HUGE_VAL, 0)});
  EXPECT_EQ(b.min, Vec3(-3, 2, -2));
  EXPECT_EQ(b.max, Vec3(1, 5, 0));
  EXPECT_DOUBLE_EQ(b.diagonal(), std::sqrt(16 + 9 + 4));
}

TEST(ChooseOrigin, SubtractingAndAddingBackIsExact) {
  const std::vector<Vec3> centres = {Vec3(500000, 5400000, 100), Vec3(-512345.678, 5.4e6 + 0.1, -33.3),
                                     Vec3(4e6, -3e5, 4.9e6), Vec3(123.456, 0, 1e7), Vec3(1e12 + 0.25, 1e-3, 65536)};
  std::uint64_t seed = 1;
  for (const Vec3& centre : centres) {
    for (const double extent : {0.5, 30.0, 2000.0, 1e5}) {
      const std::vector<Vec3> points = utm_points(centre, extent, seed++);
      const Vec3 origin = choose_origin(bounds(points));
      for (const Vec3& p : points) {
        const Vec3 local = p - origin, back = local + origin;
        ASSERT_EQ(back, p) << "origin " << origin.transpose() << " extent " << extent;
      }
    }
  }
}

TEST(ChooseOrigin, ZeroWhereTheDataIsNear) {
  EXPECT_EQ(choose_origin(bounds({Vec3(4, 0, 1), Vec3(-4, 4, -1), Vec3(0, -4, 0)})), Vec3::Zero().eval());
  EXPECT_EQ(choose_origin(Bounds{}), Vec3::Zero().eval());
  const Vec3 o = choose_origin(bounds(utm_points(Vec3(500000, 5400000, 3), 50, 3)));
  EXPECT_NEAR(o.x(), 500000, 500);
  EXPECT_NEAR(o.y(), 5400000, 500);
  EXPECT_EQ(o.z(), 0);
  EXPECT_EQ(o, o.array().round().matrix().eval()) << "a round number";
}

}  // namespace
}  // namespace kappa
