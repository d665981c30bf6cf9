// SPDX-License-Identifier: BSD-3-Clause
#include "search/point_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "kappa/mesh/ball_sum.hpp"
#include "kappa/search/cloud_normals.hpp"

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
        blocks.near_box(run.low, run.high, radius, of_run);
        for (std::size_t i = q; i < run.end; ++i) {
          const std::size_t count = blocks.near_ball(points[i], radius, of_run);
          const std::vector<std::uint32_t> found(of_run.of_ball.begin(),
                                                 of_run.of_ball.begin() + std::ptrdiff_t(count));
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
  EXPECT_EQ(blocks.near_ball(Vec3::Zero(), 1, work), 0U);
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

/// Every instruction set gives the bits of the baseline, which the tests of normals compare with plain fits.
TEST(PointKernels, GiveTheBitsOfTheBaseline) {
  const kernels::PointTable &best = kernels::best_point_table(), &baseline = kernels::baseline_point_table();
  const std::vector<Vec3> points = clouds().front().second;
  const PointBlocks blocks(points);
  PointBlocks::Work work;
  const double matrix[9] = {0.8, 0.6, 0, -0.6, 0.8, 0.1, 0, -0.1, 1};
  const auto sums = [&](const kernels::PointTable& table, double radius) {
    std::array<std::vector<double>, 3> x;
    for (auto& axis : x) axis.resize(points.size() + 16);
    const kernels::PointColumns columns{x[0].data(), x[1].data(), x[2].data()};
    const kernels::ChosenBlocks from{blocks.blocks(), work.blocks.data(), work.blocks.size()};
    const std::size_t count = table.select(from, points[100].data(), radius * radius, columns);
    std::vector<double> result(1 + kernels::kPlaneSums + kernels::kQuadricSums, static_cast<double>(count));
    table.plane_sums(columns, count, result.data() + 1);
    table.quadric_sums(columns, count, matrix, result.data() + 1 + kernels::kPlaneSums);
    return result;
  };
  for (const double radius : {0.0, 0.02, 0.1, 0.5}) {
    blocks.near_box(points[100], points[100], radius, work);
    EXPECT_EQ(sums(best, radius), sums(baseline, radius)) << radius;
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
  std::array<std::vector<double>, 3> x;
  for (std::size_t i = 0; i < 7; ++i) {
    const double t = static_cast<double>(i) - 2.5;
    x[0].push_back(0.3 * t);
    x[1].push_back(t * t - 4);
    x[2].push_back(1 - t);
  }
  const std::array<std::vector<double>, 3> given = x;
  for (auto& axis : x) axis.resize(7 + 8, 9.0);
  const double matrix[9] = {0.8, 0.6, 0, -0.6, 0.8, 0.1, 0, -0.1, 1};
  std::array<double, kernels::kQuadricSums> sums;
  kernels::best_point_table().quadric_sums({x[0].data(), x[1].data(), x[2].data()}, 7, matrix, sums.data());
  std::array<double, kernels::kQuadricSums> expected{};
  for (std::size_t i = 0; i < 7; ++i) {
    const auto row = [&](int r) {
      return matrix[3 * r] * given[0][i] + matrix[3 * r + 1] * given[1][i] + matrix[3 * r + 2] * given[2][i];
    };
    const double a = row(0), b = row(1), c = row(2);
    const double terms[] = {a,
                            b,
                            a * a,
                            a * b,
                            b * b,
                            c,
                            c * a,
                            c * b,
                            c * a * a,
                            c * a * b,
                            c * b * b,
                            c * c,
                            a * a * a,
                            a * a * b,
                            a * b * b,
                            b * b * b,
                            a * a * a * a,
                            a * a * a * b,
                            a * a * b * b,
                            a * b * b * b,
                            b * b * b * b};
    for (std::size_t term = 0; term < expected.size(); ++term) expected[term] += terms[term];
  }
  for (std::size_t term = 0; term < expected.size(); ++term)
    EXPECT_NEAR(sums[term], expected[term], 1e-13 * (1 + std::abs(expected[term]))) << term;
}

}  // namespace
}  // namespace kappa
