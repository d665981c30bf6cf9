// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace kappa {
namespace {

/// Several distributions, as trees like or dislike them.
std::vector<std::pair<std::string, std::vector<Vec3>>> distributions() {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto cloud = [&](std::size_t n, auto make) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(make(i));
    return points;
  };
  const auto anywhere = [&](std::size_t) { return Vec3(uniform(random), uniform(random), uniform(random)); };
  const auto on_line = [&](std::size_t) { return Vec3(uniform(random), 0, 0); };
  const auto on_grid = [&](std::size_t i) { return Vec3(static_cast<double>(i % 20), static_cast<double>(i / 20), 0); };
  const auto far_away = [&](std::size_t) {
    return Vec3(500000 + uniform(random), 5400000 + uniform(random), uniform(random));
  };
  const auto repeated = [&](std::size_t i) { return Vec3(static_cast<double>(i % 3), 0, 0); };
  return {{"uniform", cloud(700, anywhere)},
          {"line", cloud(500, on_line)},
          {"grid", cloud(400, on_grid)},
          {"far", cloud(500, far_away)},
          {"duplicates", cloud(900, repeated)},
          {"one", cloud(1, anywhere)},
          {"none", {}}};
}

std::vector<double> all_distances_sq(const std::vector<Vec3>& points, const Vec3& query) {
  std::vector<double> distances;
  for (const Vec3& p : points) {
    if (is_finite(p)) distances.push_back((p - query).squaredNorm());
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST(NeighbourSearch, NearestAreThoseOfAFullScan) {
  for (const auto& [name, points] : distributions()) {
    const NeighbourSearch search(points);
    std::vector<Index> found;
    std::vector<double> distances_sq;
    for (std::size_t q = 0; q < points.size(); q += 13) {
      const std::vector<double> expected = all_distances_sq(points, points[q]);
      search.nearest(points[q], 17, found, distances_sq);
      ASSERT_EQ(found.size(), std::min<std::size_t>(17, points.size())) << name;
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_DOUBLE_EQ(distances_sq[i], expected[i]) << name << " query " << q;
        EXPECT_EQ((points[found[i]] - points[q]).squaredNorm(), distances_sq[i]) << name;
      }
    }
  }
}

TEST(NeighbourSearch, WithinIsTheClosedBall) {
  for (const auto& [name, points] : distributions()) {
    const NeighbourSearch search(points);
    std::vector<Index> found;
    std::vector<double> distances_sq;
    for (std::size_t q = 0; q < points.size(); q += 17) {
      // On the grid many points lie at distance 2 exactly.
      search.within(points[q], 2.0, found, distances_sq);
      const std::vector<double> all = all_distances_sq(points, points[q]);
      const auto expected = std::upper_bound(all.begin(), all.end(), 4.0) - all.begin();
      EXPECT_EQ(static_cast<std::ptrdiff_t>(found.size()), expected) << name << " query " << q;
      std::sort(found.begin(), found.end());
      EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << name;
    }
  }
}

TEST(NeighbourSearch, PointsThatAreNotFiniteAreNeverFound) {
  const std::vector<Vec3> points = {
      {0, 0, 0}, {kNaN, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
  const NeighbourSearch search(points);
  EXPECT_EQ(search.size(), 2u);
  std::vector<Index> found;
  std::vector<double> distances_sq;
  search.nearest({0.1, 0, 0}, 4, found, distances_sq);
  EXPECT_EQ(found, (std::vector<Index>{0, 2}));
}

TEST(MedianSpacing, IsTheStepOfAGridWhateverIsStoredTwice) {
  std::vector<Vec3> points;
  for (int copy = 0; copy < 3; ++copy) {
    for (int i = 0; i < 400; ++i) points.emplace_back(0.25 * (i % 20), 0.25 * (i / 20), 0.0);
  }
  EXPECT_DOUBLE_EQ(median_spacing(points), 0.25);
  EXPECT_TRUE(std::isnan(median_spacing({{1, 2, 3}, {1, 2, 3}})));
  EXPECT_TRUE(std::isnan(median_spacing({})));
}

}  // namespace
}  // namespace kappa
