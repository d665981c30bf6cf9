// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/random.hpp"

#include <gtest/gtest.h>

namespace kappa {
namespace {

// First outputs of xoshiro256** whose four words are the first four of splitmix64.
TEST(Random, FollowsThePublishedGenerator) {
  Random random(0);
  EXPECT_EQ(random.next(), 0x99ec5f36cb75f2b4ULL);
  EXPECT_EQ(random.next(), 0xbf6e1f784956452aULL);
  EXPECT_EQ(random.next(), 0x1a5f849d4933e6e0ULL);
}

TEST(Random, SeedsTellSequencesApart) {
  Random a(1), b(1), c(2);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const auto value = a.next();
    EXPECT_EQ(value, b.next());
    equal += value == c.next() ? 1 : 0;
  }
  EXPECT_EQ(equal, 0);
}

TEST(Random, UniformHasItsMoments) {
  Random random(3);
  constexpr int kDraws = 200000;
  double sum = 0, sum_sq = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
    sum_sq += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.003);  // 4.6 standard errors
  EXPECT_NEAR(sum_sq / kDraws, 1 / 3.0, 0.003);
}

TEST(Random, NormalHasItsMoments) {
  Random random(4);
  constexpr int kDraws = 200000;
  double moments[5] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.normal();
    double power = 1;
    for (double& moment : moments) {
      moment += power / kDraws;
      power *= value;
    }
  }
  EXPECT_NEAR(moments[1], 0, 0.01);
  EXPECT_NEAR(moments[2], 1, 0.015);
  EXPECT_NEAR(moments[3], 0, 0.04);
  EXPECT_NEAR(moments[4], 3, 0.1);
}

TEST(Random, BallAndSphereAreEven) {
  Random random(5);
  constexpr int kDraws = 100000;
  Vec3 ball_mean = Vec3::Zero(), sphere_mean = Vec3::Zero();
  Mat3 ball_spread = Mat3::Zero(), sphere_spread = Mat3::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 in = random.in_ball(), on = random.direction();
    ASSERT_LE(in.norm(), 1);
    ASSERT_NEAR(on.norm(), 1, 1e-15);
    ball_mean += in / kDraws;
    sphere_mean += on / kDraws;
    ball_spread += in * in.transpose() / kDraws;
    sphere_spread += on * on.transpose() / kDraws;
  }
  EXPECT_LT(ball_mean.norm(), 0.01);
  EXPECT_LT(sphere_mean.norm(), 0.01);
  EXPECT_LT((ball_spread - Mat3::Identity() / 5).norm(), 0.01);
  EXPECT_LT((sphere_spread - Mat3::Identity() / 3).norm(), 0.01);
}

TEST(Random, BelowTakesEveryValueEvenly) {
  Random random(6);
  int counts[7] = {};
  for (int i = 0; i < 70000; ++i) {
    const auto value = random.below(7);
    ASSERT_LT(value, 7U);
    ++counts[value];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000, 450);  // 4.9 standard deviations
}

}  // namespace
}  // namespace kappa
