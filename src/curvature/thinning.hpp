// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/mesh/topology.hpp"

namespace kappa {

/// Part of the points of a graph, spread evenly: each stands for the cluster of points around it.
struct ThinnedGraph {
  std::vector<Index> points;   ///< that were kept, as points of the graph
  std::vector<Index> cluster;  ///< of each point of the graph: place in `points` of the one that stands for it
  Adjacency neighbours;        ///< places of clusters that touch

  std::size_t size() const { return points.size(); }

  /// Place here of the point at `place` of a level further up.
  Index place_of(const ThinnedGraph& coarser, std::size_t place) const { return cluster[coarser.points[place]]; }
};

/// The whole graph, then ever fewer of its points while a level has at most 2/3 of those below: a point is kept unless
/// it is next to one that is, and stands for the neighbours that none before it took. Points that `preferred` holds for
/// are looked at first. What is kept depends on the graph alone, not on where its points are.
std::vector<ThinnedGraph> thin(Adjacency neighbours, const std::function<bool(std::size_t)>& preferred,
                               const Execution& run);

/// Replaces every value by the mean of those of its point and of the neighbours, `passes` times. NaN stay and do not
/// count.
void average(std::vector<double>& values, const Adjacency& neighbours, int passes, const Execution& run);

}  // namespace kappa
