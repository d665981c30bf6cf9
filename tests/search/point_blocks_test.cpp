// SPDX-License-Identifier: BSD-3-Clause
#include "search/point_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kappa/search/fitted_normals.hpp"

namespace kappa {
namespace {

using Found = std::vector<std::pair<double, Index>>;  // by distance, of equally far ones by index

std::vector<Vec3> sorted_distinct(const std::vector<Vec3>& points) {
  const std::vector<Index> first = find_duplicates(points);
  std::vector<Vec3> sorted;
  for (const Index i : spatial_order(points)) {
    if (first[i] == i) sorted.push_back(points[i]);
  }
  return sorted;
}

/// Clouds along the curve: even, dense beside sparse with points far away, a lattice of equal distances, few.
std::vector<std::pair<std::string, std::vector<Vec3>>> clouds() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> even, uneven, lattice, far;
  for (int i = 0; i < 3000; ++i) even.emplace_back(uniform(random), uniform(random), 0.1 * uniform(random));
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10.0, i % 5 - 3);
    uneven.emplace_back(size * uniform(random), size * uniform(random), size * uniform(random));
  }
  for (int i = 0; i < 20; ++i) uneven.emplace_back(1000 * uniform(random), 1000 * uniform(random), 0);
  for (int i = 0; i < 2500; ++i) lattice.emplace_back(i % 50, i / 50, 0);
  for (int i = 0; i < 1000; ++i) far.emplace_back(500000 + uniform(random), 5400000 + uniform(random), 0);
  return {{"even", sorted_distinct(even)},
          {"uneven", sorted_distinct(uneven)},
          {"lattice", sorted_distinct(lattice)},
          {"far", sorted_distinct(far)},
          {"one", {Vec3(1, 2, 3)}},
          {"few", {Vec3(0, 0, 0), Vec3(1, 0, 0)}}};
}

Found all_by_distance(const std::vector<Vec3>& points, const Vec3& query) {
  Found all;
  for (Index i = 0; i < points.size(); ++i) all.emplace_back((points[i] - query).squaredNorm(), i);
  std::sort(all.begin(), all.end());
  return all;
}

Found found_of(const std::vector<Index>& indices, const std::vector<double>& distances_sq) {
  Found found;
  for (std::size_t i = 0; i < indices.size(); ++i) found.emplace_back(distances_sq[i], indices[i]);
  return found;
}

TEST(PointBlocks, NearestAreThoseOfAFullScan) {
  PointBlocks::Work work;
  for (const auto& [name, points] : clouds()) {
    const PointBlocks blocks(points);
    std::vector<Index> indices;
    std::vector<double> distances_sq;
    for (std::size_t q = 0; q < points.size(); q += 37) {
      const Vec3 query = points[q] + Vec3(0.01, 0, q % 2 ? 0.3 : 0);
      Found expected = all_by_distance(points, query);
      expected.resize(std::min<std::size_t>(expected.size(), 17));
      blocks.nearest(query, 17, indices, distances_sq);
      ASSERT_EQ(found_of(indices, distances_sq), expected) << name << " query " << q;
      for (const double guess : {0.0, 0.1, 3.0}) {
        blocks.nearest(query, 17, guess, indices, distances_sq, work);
        ASSERT_EQ(found_of(indices, distances_sq), expected) << name << " query " << q << " guess " << guess;
      }
    }
  }
}

TEST(PointBlocks, WithinAreThoseOfAFullScan) {
  PointBlocks::Work work;
  for (const auto& [name, points] : clouds()) {
    const PointBlocks blocks(points);
    std::vector<Index> indices;
    std::vector<double> distances_sq;
    for (std::size_t q = 0; q < points.size(); q += 97) {
      for (const double radius : {0.0, 0.05, 5.0, 1e200}) {  // 5 holds points of the lattice on its rim
        Found expected = all_by_distance(points, points[q]);
        const auto outside = [&](const auto& p) { return p.first > radius * radius; };
        expected.erase(std::find_if(expected.begin(), expected.end(), outside), expected.end());
        blocks.within(points[q], radius, indices, distances_sq, work);
        EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
        Found found = found_of(indices, distances_sq);
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << name << " query " << q << " radius " << radius;
      }
    }
  }
}

/// Among the blocks near a run they are those that a search for the ball alone finds.
TEST(PointBlocks, BlocksNearABallOfARun) {
  PointBlocks::Work of_run, alone;
  for (const auto& [name, points] : clouds()) {
    const PointBlocks blocks(points);
    for (const double radius : {0.0, 0.05, 5.0, 1e200}) {
      for (std::size_t q = 0; q < points.size(); q += 97) {
        const PointRun run(blocks, q, 32, radius);
        blocks.near_run(run.low, run.high, radius, of_run);
        for (std::size_t i = q; i < run.end; ++i) {
          const kernels::ChosenBlocks chosen = blocks.near_ball(points[i], radius, of_run);
          const std::vector<std::uint32_t> found(chosen.chosen, chosen.chosen + chosen.count);
          blocks.near_box(points[i], points[i], radius, alone);
          ASSERT_EQ(found, alone.blocks) << name << " point " << i << " radius " << radius;
        }
      }
    }
  }
}

TEST(PointBlocks, NothingIsFoundAmongNoPoints) {
  const PointBlocks blocks{std::vector<Vec3>()};
  PointBlocks::Work work;
  std::vector<Index> indices = {1};
  std::vector<double> distances_sq = {1};
  blocks.nearest(Vec3::Zero(), 3, indices, distances_sq);
  EXPECT_TRUE(indices.empty());
  blocks.within(Vec3::Zero(), 1, indices, distances_sq, work);
  EXPECT_TRUE(indices.empty() && distances_sq.empty());
  blocks.near_run(Vec3::Zero(), Vec3::Zero(), 1, work);
  EXPECT_EQ(blocks.near_ball(Vec3::Zero(), 1, work).count, 0U);
}

TEST(PointBlocks, RunsFindWhatEachPointFindsAlone) {
  for (const auto& [name, points] : clouds()) {
    const PointBlocks blocks(points);
    for (const std::size_t k : {1, 2, 17, 100}) {
      NearestInRuns nearest(blocks, k);
      std::vector<Index> alone;
      std::vector<double> distances_sq;
      std::size_t next = 0;
      nearest.for_each(0, points.size(), [&](std::size_t i, const auto& indices, const auto& in_run) {
        ASSERT_EQ(i, next++);
        blocks.nearest(points[i], k, alone, distances_sq);
        ASSERT_EQ(found_of(indices, in_run), found_of(alone, distances_sq)) << name << " point " << i << " of " << k;
      });
      EXPECT_EQ(next, points.size());
    }
  }
}

const double kMatrix[9] = {0.8, 0.6, 0, -0.6, 0.8, 0.1, 0, -0.1, 1};

/// What the kernels of one instruction set find in a ball around a point, and the sums over it.
struct InBall {
  std::vector<kernels::FourPoints> points;
  kernels::Selected selected;
  std::array<double, kernels::kPlaneSums> while_selecting, of_plane;
  std::array<double, kernels::kQuadricSums> of_quadric;

  InBall(const kernels::PointTable& table, const PointBlocks& blocks, const Vec3& centre, double radius) {
    PointBlocks::Work work;
    blocks.near_box(centre, centre, radius, work);
    const kernels::ChosenBlocks from{blocks.blocks(), work.blocks.data(), work.blocks.size()};
    points.resize(from.places() / 4);
    selected = table.select(from, centre.data(), radius * radius, points.data(), while_selecting.data());
    table.plane_sums(points.data(), selected.fours, of_plane.data());
    table.quadric_sums(points.data(), selected.fours, kMatrix, of_quadric.data());
  }
};

/// Every instruction set gives the bits of the baseline, which the tests of normals compare with plain fits.
TEST(PointKernels, GiveTheBitsOfTheBaseline) {
  const std::vector<Vec3> points = clouds().front().second;
  const PointBlocks blocks(points);
  for (const double radius : {0.0, 0.02, 0.1, 0.5}) {
    const InBall best(kernels::best_point_table(), blocks, points[100], radius);
    const InBall baseline(kernels::baseline_point_table(), blocks, points[100], radius);
    EXPECT_EQ(best.selected.count, baseline.selected.count) << radius;
    EXPECT_EQ(best.while_selecting, baseline.while_selecting) << radius;
    EXPECT_EQ(best.of_plane, baseline.of_plane) << radius;
    EXPECT_EQ(best.of_quadric, baseline.of_quadric) << radius;
  }
}

TEST(PointKernels, SelectThePointsOfABall) {
  for (const auto& [name, points] : clouds()) {
    const PointBlocks blocks(points);
    const Vec3 centre = points[points.size() / 3];
    for (const double radius : {0.0, 0.3, 5.0}) {
      std::vector<std::array<double, 3>> expected, found;
      Vec3 sum = Vec3::Zero();
      for (const Vec3& x : points) {
        const Vec3 d = x - centre;
        if (d.squaredNorm() > radius * radius) continue;
        sum += d;
        if (!d.isZero(0)) expected.push_back({d.x(), d.y(), d.z()});
      }
      const InBall ball(kernels::best_point_table(), blocks, centre, radius);
      EXPECT_EQ(ball.selected.count, expected.size() + 1) << name << " radius " << radius;
      for (std::size_t i = 0; i < 4 * ball.selected.fours; ++i) {
        const auto& x = ball.points[i / 4].x;
        if (x[0][i % 4] != 0 || x[1][i % 4] != 0 || x[2][i % 4] != 0)
          found.push_back({x[0][i % 4], x[1][i % 4], x[2][i % 4]});
      }
      EXPECT_EQ(found, expected) << name << " radius " << radius;
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(ball.while_selecting[std::size_t(axis)], sum[axis], 1e-12 * radius * double(points.size()));
      for (std::size_t i = 0; i < kernels::kPlaneSums; ++i)
        EXPECT_NEAR(ball.while_selecting[i], ball.of_plane[i], 1e-12 * (1 + radius * radius) * double(points.size()));
    }
  }
}

TEST(PointKernels, OpenTheBoxesThatAreMet) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<kernels::PointBoxes> level(5);
  const std::vector<std::uint32_t> nodes = {0, 3, 4};
  std::vector<std::uint32_t> expected;
  const double low[3] = {-0.2, -0.3, -0.1}, high[3] = {0.1, 0, 0.2}, distance_sq = 0.25;
  for (std::size_t i = 0; i < 8 * level.size(); ++i) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const bool nothing = i % 8 > 5;
      const double a = uniform(random), b = a + 0.3;
      level[i / 8].low[axis][i % 8] = nothing ? kInfinity : a;
      level[i / 8].high[axis][i % 8] = nothing ? -kInfinity : b;
      sum += nothing ? kInfinity : std::pow(std::max({a - high[axis], low[axis] - b, 0.0}), 2);
    }
    const auto node = static_cast<std::uint32_t>(i / 8);
    if (sum <= distance_sq && std::count(nodes.begin(), nodes.end(), node)) expected.push_back(std::uint32_t(i));
  }
  EXPECT_GT(expected.size(), 3U);
  for (const auto* table : {&kernels::best_point_table(), &kernels::baseline_point_table()}) {
    std::vector<std::uint32_t> found(8 * nodes.size() + 8);
    found.resize(table->open(level.data(), nodes.data(), nodes.size(), low, high, distance_sq, found.data()));
    EXPECT_EQ(found, expected);
  }
}

TEST(PointKernels, SumPowersOfTurnedPoints) {
  std::array<kernels::FourPoints, 2> given{};  // the last place stays at the origin
  std::array<double, kernels::kPlaneSums> of_plane, plane_expected{};
  std::array<double, kernels::kQuadricSums> of_quadric, quadric_expected{};
  for (std::size_t i = 0; i < 7; ++i) {
    const double t = static_cast<double>(i) - 2.5;
    const Vec3 d(0.3 * t, t * t - 4, 1 - t);
    for (int axis = 0; axis < 3; ++axis) given[i / 4].x[axis][i % 4] = d[axis];
    const double plane[] = {d[0],        d[1],        d[2],        d[0] * d[0], d[0] * d[1],
                            d[0] * d[2], d[1] * d[1], d[1] * d[2], d[2] * d[2]};
    const Vec3 q = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(kMatrix) * d;
    const double x = q[0], y = q[1], z = q[2];
    const double quadric[] = {z * z,         z * x * x,     z * x * y,    z * y * y,     x * x * x,
                              x * x * y,     x * y * y,     y * y * y,    x * x * x * x, x * x * x * y,
                              x * x * y * y, x * y * y * y, y * y * y * y};
    for (std::size_t term = 0; term < plane_expected.size(); ++term) plane_expected[term] += plane[term];
    for (std::size_t term = 0; term < quadric_expected.size(); ++term) quadric_expected[term] += quadric[term];
  }
  kernels::best_point_table().plane_sums(given.data(), 2, of_plane.data());
  kernels::best_point_table().quadric_sums(given.data(), 2, kMatrix, of_quadric.data());
  for (std::size_t term = 0; term < of_plane.size(); ++term)
    EXPECT_NEAR(of_plane[term], plane_expected[term], 1e-13 * (1 + std::abs(plane_expected[term]))) << term;
  for (std::size_t term = 0; term < of_quadric.size(); ++term)
    EXPECT_NEAR(of_quadric[term], quadric_expected[term], 1e-13 * (1 + std::abs(quadric_expected[term]))) << term;
}

}  // namespace
}  // namespace kappa
