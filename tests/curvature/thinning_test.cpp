// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/thinning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kappa/core/types.hpp"

namespace kappa {
namespace {

/// Rows of points, each next to those left, right, above and below.
Adjacency grid_graph(int rows, int columns) {
  Adjacency graph;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto add = [&](int row, int column) {
        if (row < 0 || row >= rows || column < 0 || column >= columns) return;
        graph.items.push_back(static_cast<Index>(row * columns + column));
      };
      add(r - 1, c);
      add(r, c - 1);
      add(r, c + 1);
      add(r + 1, c);
      graph.offsets.push_back(graph.items.size());
    }
  }
  return graph;
}

bool all(std::size_t) {
  return true;
}

bool are_neighbours(const Adjacency& graph, Index a, Index b) {
  return std::find(graph.begin(a), graph.end(a), b) != graph.end(a);
}

TEST(Thinning, KeepsEverFewerPoints) {
  const auto levels = thin(grid_graph(30, 40), all, {});
  ASSERT_GT(levels.size(), 3u);
  EXPECT_EQ(levels[0].size(), 1200u);
  for (std::size_t l = 1; l < levels.size(); ++l) {
    EXPECT_LE(3 * levels[l].size(), 2 * levels[l - 1].size());
    for (const Index i : levels[l].points) EXPECT_EQ(levels[l - 1].points[levels[l - 1].cluster[i]], i) << "not below";
  }
  EXPECT_EQ(levels.back().size(), 1u) << "the graph is connected";
}

TEST(Thinning, ClustersHoldTheirPointAndLieWithinReach) {
  const Adjacency graph = grid_graph(20, 20);
  const auto levels = thin(graph, all, {});
  for (const ThinnedGraph& level : levels) {
    ASSERT_EQ(level.cluster.size(), graph.size());
    for (std::size_t place = 0; place < level.size(); ++place)
      EXPECT_EQ(level.cluster[level.points[place]], static_cast<Index>(place));
  }
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const Index centre = levels[1].points[levels[1].cluster[i]];
    if (centre == static_cast<Index>(i)) {
      for (const Index* j = graph.begin(i); j != graph.end(i); ++j)
        EXPECT_NE(levels[1].points[levels[1].cluster[*j]], *j);
    }
    EXPECT_TRUE(centre == static_cast<Index>(i) || are_neighbours(graph, static_cast<Index>(i), centre)) << i;
  }
}

TEST(Thinning, NeighboursAreClustersThatTouch) {
  const Adjacency graph = grid_graph(12, 17);
  const auto levels = thin(graph, all, {});
  const ThinnedGraph& level = levels[1];
  for (std::size_t a = 0; a < level.size(); ++a) {
    std::vector<Index> expected;
    for (std::size_t i = 0; i < graph.size(); ++i) {
      if (level.cluster[i] != static_cast<Index>(a)) continue;
      for (const Index* j = graph.begin(i); j != graph.end(i); ++j)
        if (level.cluster[*j] != static_cast<Index>(a)) expected.push_back(level.cluster[*j]);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(std::vector<Index>(level.neighbours.begin(a), level.neighbours.end(a)), expected) << a;
  }
}

TEST(Thinning, PreferredPointsStandForTheOthers) {
  const auto second = [](std::size_t i) { return i == 1; };
  EXPECT_EQ(thin(grid_graph(1, 3), all, {})[1].points, (std::vector<Index>{0, 2}));
  EXPECT_EQ(thin(grid_graph(1, 3), second, {})[1].points, (std::vector<Index>{1}));
}

TEST(Thinning, PointsAloneAreLeftAlone) {
  Adjacency lonely;
  lonely.offsets.assign(6, 0);
  EXPECT_EQ(thin(lonely, all, {}).size(), 1u);
}

TEST(Averaging, KeepsWhatIsConstantAndSpreadsWhatIsNot) {
  const Adjacency graph = grid_graph(9, 9);
  std::vector<double> constant(81, 3.5), peak(81, 0.0);
  peak[40] = 1;
  average(constant, graph, 5, {});
  for (const double v : constant) EXPECT_NEAR(v, 3.5, 1e-15);
  average(peak, graph, 1, {});
  for (const Index i : {40, 31, 39, 41, 49}) EXPECT_DOUBLE_EQ(peak[i], 0.2);
  EXPECT_EQ(std::count_if(peak.begin(), peak.end(), [](double v) { return v > 0; }), 5);
}

TEST(Averaging, LeavesOutWhatIsNotKnown) {
  std::vector<double> values = {1, kNaN, 5};
  average(values, grid_graph(1, 3), 4, {});
  EXPECT_EQ(values[0], 1);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(values[2], 5);
}

}  // namespace
}  // namespace kappa
