// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

/// Turns every normal by the toss of a coin.
Normals scrambled(Normals u, std::uint64_t seed) {
  Random random(seed);
  for (Vec3& v : u) {
    if (random.below(2) == 1) v = -v;
  }
  return u;
}

std::size_t count_wrong(const Normals& u, const Normals& truth) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < u.size(); ++i) wrong += u[i].dot(truth[i]) < 0;
  return wrong;
}

TEST(OrientConsistently, TurnsFittedNormalsOfATorusOutward) {
  const auto cloud = clouds::torus(5000, 1);
  const std::vector<Vec3> x = clouds::positions(cloud);
  Normals u = scrambled(fitted_normals(x, {}), 2);
  const Normals before = u;
  EXPECT_GT(normal_agreement(x, u).opposed_share(), 0.4);
  const ConsistentOrientation result = orient_consistently(x, u);
  EXPECT_EQ(count_wrong(u, clouds::normals(cloud)), 0u);
  EXPECT_EQ(result.parts, 1u);
  EXPECT_EQ(result.turned, count_wrong(u, before));
  EXPECT_EQ(result.agreement.opposed, 0u);
  EXPECT_EQ(normal_agreement(x, u).opposed, 0u);
  EXPECT_EQ(orient_consistently(x, u).turned, 0u) << "a second run changes nothing";
}

/// Two spheres far apart, one inside a third: every part is outward, whatever the others are.
TEST(OrientConsistently, EachPartIsOutward) {
  std::vector<Vec3> x;
  Normals truth;
  const std::vector<std::pair<Vec3, double>> spheres = {
      {Vec3(0, 0, 0), 1.0}, {Vec3(100, 0, -50), 2.0}, {Vec3(100, 0, -50), 20.0}};
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    for (const SurfacePoint& p : clouds::sphere(spheres[s].second, 1500, 10 + s)) {
      x.push_back(spheres[s].first + p.x);
      truth.push_back(p.normal);
    }
  }
  Normals u = scrambled(truth, 3);
  EXPECT_EQ(orient_consistently(x, u).parts, 3u);
  EXPECT_EQ(count_wrong(u, truth), 0u);
}

TEST(OrientConsistently, TerrainIsUpAndAWallLooksAwayFromTheRest) {
  Random random(4);
  std::vector<Vec3> x;
  for (int i = 0; i < 4000; ++i) {
    const double a = random.uniform(-20, 20), b = random.uniform(-20, 20);
    x.emplace_back(a, b, 3 * std::sin(a / 4) * std::cos(b / 5));
  }
  Normals u = scrambled(fitted_normals(x, {}), 5);
  orient_consistently(x, u);
  for (const Vec3& v : u) EXPECT_GT(v.z(), 0);

  std::vector<Vec3> wall;
  for (int i = 0; i < 900; ++i) wall.emplace_back(7 - 0.01 * std::pow(i % 30 - 15, 2), i % 30, i / 30);
  Normals w = scrambled(fitted_normals(wall, {}), 6);
  orient_consistently(wall, w);
  for (const Vec3& v : w) EXPECT_GT(v.x(), 0) << "it bulges towards +x";
}

TEST(OrientConsistently, IsTheSameForAnyNumberOfThreads) {
  const auto cloud = clouds::torus(3000, 7);
  const std::vector<Vec3> x = clouds::positions(cloud);
  const Normals start = scrambled(clouds::normals(cloud), 8);
  Normals one = start, three = start;
  Execution run;
  orient_consistently(x, one, {}, run);
  run.threads = 3;
  orient_consistently(x, three, {}, run);
  EXPECT_EQ(one, three);
}

TEST(OrientConsistently, DuplicatesMissingAndLonelyPoints) {
  const auto cloud = clouds::sphere(1, 400, 9);
  std::vector<Vec3> x = clouds::positions(cloud);
  Normals truth = clouds::normals(cloud);
  x.insert(x.end(), x.begin(), x.begin() + 400);
  truth.insert(truth.end(), truth.begin(), truth.begin() + 400);
  Normals u = scrambled(truth, 10);
  x.push_back(Vec3::Constant(kNaN));
  u.push_back(-Vec3::UnitX());
  x.emplace_back(0.5, 0, 0);
  u.push_back(Vec3::Zero());
  EXPECT_EQ(orient_consistently(x, u).parts, 1u);
  EXPECT_EQ(u[800], -Vec3::UnitX());
  EXPECT_EQ(u[801], Vec3::Zero());
  u.resize(800);
  EXPECT_EQ(count_wrong(u, truth), 0u);

  Normals none;
  EXPECT_EQ(orient_consistently({}, none).parts, 0u);
  Normals single = {-Vec3::UnitZ()};
  EXPECT_EQ(orient_consistently({Vec3(1, 2, 3)}, single).parts, 1u);
  EXPECT_EQ(single.front(), Vec3::UnitZ());
  EXPECT_EQ(normal_agreement({Vec3(1, 2, 3)}, single).opposed_share(), 0);
}

/// Four points, two of them turned round: of the six pairs the four mixed ones are opposed.
TEST(NormalAgreement, CountsEachPairOnce) {
  const std::vector<Vec3> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.1}};
  const Normals u = {Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitZ(), -Vec3::UnitZ()};
  const NormalAgreement agreement = normal_agreement(x, u, {3});
  EXPECT_EQ(agreement.pairs, 6u);
  EXPECT_EQ(agreement.opposed, 4u);
  EXPECT_DOUBLE_EQ(agreement.opposed_share(), 4.0 / 6.0);
}

TEST(NormalAgreement, RefusesByName) {
  Normals u(3, Vec3::UnitZ());
  const std::vector<Vec3> x(2, Vec3::Zero());
  EXPECT_NE(clouds::refusal([&] { orient_consistently(x, u); }).message.find("3 normals for 2 points"),
            std::string::npos);
  u.resize(2);
  EXPECT_NE(clouds::refusal([&] { normal_agreement(x, u, {0}); }).message.find("neighbours = 0: give 1 to 255"),
            std::string::npos);
}

}  // namespace
}  // namespace kappa
