// SPDX-License-Identifier: BSD-3-Clause
#include "thinning.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;

/// Of each point of `level`: the place of the one that stands for it among those that are kept, which go to `kept`.
std::vector<Index> clusters(const ThinnedGraph& level, const std::vector<Index>& order, std::vector<Index>& kept) {
  std::vector<Index> cluster(level.size(), kNoIndex);
  for (const Index i : order) {
    if (cluster[i] != kNoIndex) continue;
    const auto place = static_cast<Index>(kept.size());
    kept.push_back(i);
    cluster[i] = place;
    for (const Index* j = level.neighbours.begin(i); j != level.neighbours.end(i); ++j)
      if (cluster[*j] == kNoIndex) cluster[*j] = place;
  }
  return cluster;
}

/// Which clusters touch.
Adjacency touching(const Adjacency& neighbours, const std::vector<Index>& cluster, std::size_t clusters) {
  std::vector<std::vector<Index>> lists(clusters);
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    for (const Index* j = neighbours.begin(i); j != neighbours.end(i); ++j)
      if (cluster[*j] != cluster[i]) lists[cluster[i]].push_back(cluster[*j]);
  }
  Adjacency graph;
  for (std::vector<Index>& list : lists) {
    std::sort(list.begin(), list.end());
    graph.items.insert(graph.items.end(), list.begin(), std::unique(list.begin(), list.end()));
    graph.offsets.push_back(graph.items.size());
  }
  return graph;
}

ThinnedGraph whole(Adjacency neighbours) {
  ThinnedGraph level;
  level.points.resize(neighbours.size());
  std::iota(level.points.begin(), level.points.end(), Index{0});
  level.cluster = level.points;
  level.neighbours = std::move(neighbours);
  return level;
}

ThinnedGraph thinned(const ThinnedGraph& fine, const std::function<bool(std::size_t)>& preferred) {
  std::vector<Index> order(fine.size()), kept;
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_partition(order.begin(), order.end(), [&](Index i) { return preferred(fine.points[i]); });
  const std::vector<Index> cluster = clusters(fine, order, kept);
  ThinnedGraph level;
  for (const Index i : kept) level.points.push_back(fine.points[i]);
  for (const Index i : fine.cluster) level.cluster.push_back(cluster[i]);
  level.neighbours = touching(fine.neighbours, cluster, kept.size());
  return level;
}

}  // namespace

std::vector<ThinnedGraph> thin(Adjacency neighbours, const std::function<bool(std::size_t)>& preferred,
                               const Execution& run) {
  std::vector<ThinnedGraph> levels;
  levels.push_back(whole(std::move(neighbours)));
  for (;;) {
    check_cancelled(run);
    ThinnedGraph next = thinned(levels.back(), preferred);
    if (3 * next.size() > 2 * levels.back().size()) return levels;
    levels.push_back(std::move(next));
  }
}

void average(std::vector<double>& values, const Adjacency& neighbours, int passes, const Execution& run) {
  std::vector<double> before;
  for (int pass = 0; pass < passes; ++pass) {
    before = values;
    parallel_for(values.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        if (std::isnan(before[i])) continue;
        double sum = before[i];
        int count = 1;
        for (const Index* j = neighbours.begin(i); j != neighbours.end(i); ++j) {
          if (std::isnan(before[*j])) continue;
          sum += before[*j];
          ++count;
        }
        values[i] = sum / count;
      }
    });
  }
}

}  // namespace kappa
