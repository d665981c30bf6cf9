// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kappa/search/neighbours.hpp"
#include "search/distinct_points.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;

/// Two neighbours, a < b, among distinct points.
struct Edge {
  double weight;
  Index a, b;

  bool operator<(const Edge& other) const { return std::tie(weight, a, b) < std::tie(other.weight, other.a, other.b); }
};

/// The k nearest neighbours of each point, k a point, end to end.
struct NeighbourTable {
  std::size_t k = 0;
  std::vector<Index> items;

  const Index* begin(std::size_t i) const { return items.data() + k * i; }
  bool lists(Index i, Index j) const { return std::find(begin(i), begin(i) + k, j) != begin(i) + k; }
};

NeighbourTable find_neighbours(const std::vector<Vec3>& x, const NeighbourGraphOptions& options, const Execution& run) {
  check_range("neighbours", options.neighbours, 1, 255, "the graph of neighbours");
  NeighbourTable table;
  if (x.size() < 2) return table;
  table.k = std::min(static_cast<std::size_t>(options.neighbours), x.size() - 1);
  table.items.resize(table.k * x.size());
  const NeighbourSearch search(x);
  const std::vector<Index> order = spatial_order(x);
  parallel_for(order.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<Index> found;
    std::vector<double> distances_sq;
    for (std::size_t n = begin; n < end; ++n) {
      search.nearest(x[order[n]], table.k + 1, found, distances_sq);
      // The nearest is the point itself: no two share a position.
      std::copy(found.begin() + 1, found.end(), table.items.begin() + static_cast<std::ptrdiff_t>(table.k * order[n]));
    }
  });
  return table;
}

/// Pairs of neighbours, each once, in no particular but in a fixed order.
std::vector<Edge> neighbour_edges(const DistinctPoints& cloud, const NeighbourGraphOptions& options,
                                  const Execution& run) {
  const NeighbourTable table = find_neighbours(cloud.x, options, run);
  std::vector<Edge> edges;
  for (Index i = 0; i < cloud.x.size() && table.k > 0; ++i) {
    for (const Index* j = table.begin(i); j != table.begin(i) + table.k; ++j) {
      if (*j < i && table.lists(*j, i)) continue;
      edges.push_back({1 - std::abs(cloud.u[i].dot(cloud.u[*j])), std::min(i, *j), std::max(i, *j)});
    }
  }
  return edges;
}

NormalAgreement agreement_along(const std::vector<Edge>& edges, const Normals& u) {
  constexpr double kOpposed = -0.5;
  NormalAgreement agreement;
  agreement.pairs = edges.size();
  for (const Edge& e : edges) agreement.opposed += u[e.a].dot(u[e.b]) < kOpposed;
  return agreement;
}

/// Disjoint sets of which each member knows whether it is turned relative to the root.
class SignedSets {
 public:
  explicit SignedSets(std::size_t size) : parent_(size), turned_(size, 0), size_(size, 1) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  struct Place {
    Index root;
    bool turned;
  };

  Place find(Index i) {
    Place place{i, false};
    while (parent_[place.root] != place.root) {
      place.turned ^= turned_[place.root] != 0;
      place.root = parent_[place.root];
    }
    compress(i, place);
    return place;
  }

  /// Joins the sets of `a` and `b`, if they are two, so that `a` and `b` are turned against each other or not.
  void join(Index a, Index b, bool against) {
    Place p = find(a), q = find(b);
    if (p.root == q.root) return;
    if (size_[p.root] < size_[q.root]) std::swap(p, q);
    parent_[q.root] = p.root;
    turned_[q.root] = p.turned != (q.turned != against);
    size_[p.root] += size_[q.root];
  }

 private:
  void compress(Index i, const Place& place) {
    bool turned = place.turned;
    while (parent_[i] != place.root && i != place.root) {
      const bool own = turned_[i] != 0;
      const Index next = parent_[i];
      parent_[i] = place.root;
      turned_[i] = turned;
      turned = turned != own;
      i = next;
    }
  }

  std::vector<Index> parent_;
  std::vector<std::uint8_t> turned_;
  std::vector<Index> size_;
};

/// Turns normals to agree along the minimum spanning forest (Kruskal); returns the members of each part.
std::vector<std::vector<Index>> orient_parts(const std::vector<Edge>& edges, Normals& u) {
  SignedSets sets(u.size());
  for (const Edge& e : edges) sets.join(e.a, e.b, u[e.a].dot(u[e.b]) < 0);
  std::vector<Index> part_of_root(u.size(), kNoIndex);
  std::vector<std::vector<Index>> parts;
  for (Index i = 0; i < u.size(); ++i) {
    const auto [root, turned] = sets.find(i);
    if (turned) u[i] = -u[i];
    if (part_of_root[root] == kNoIndex) {
      part_of_root[root] = static_cast<Index>(parts.size());
      parts.emplace_back();
    }
    parts[part_of_root[root]].push_back(i);
  }
  return parts;
}

/// Average component along an axis of the normals of those points that lie farthest along it.
double outward_vote(const std::vector<Vec3>& x, const Normals& u, std::vector<Index>& part, int axis) {
  const std::size_t count = std::max<std::size_t>(1, part.size() / 100);
  std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count - 1), part.end(),
                   [&](Index a, Index b) { return x[a][axis] != x[b][axis] ? x[a][axis] > x[b][axis] : a < b; });
  // In the order of the points: what nth_element leaves in front is a set without a defined order.
  std::sort(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
  double sum = 0;
  for (std::size_t n = 0; n < count; ++n) sum += u[part[n]][axis];
  return sum / static_cast<double>(count);
}

bool looks_inward(const std::vector<Vec3>& x, const Normals& u, std::vector<Index>& part) {
  constexpr double kClear = 0.3;
  const double up = outward_vote(x, u, part, 2);
  if (std::abs(up) >= kClear) return up < 0;
  const double along_x = outward_vote(x, u, part, 0), along_y = outward_vote(x, u, part, 1);
  const double sideways = std::abs(along_y) > std::abs(along_x) ? along_y : along_x;
  return (std::abs(sideways) > std::abs(up) ? sideways : up) < 0;
}

/// Carries the signs of `u` over to the cloud; returns how many normals were turned.
std::size_t apply_signs(const DistinctPoints& cloud, Normals& normals) {
  std::size_t turned = 0;
  const auto turn_towards = [&](const Vec3& u, Vec3& normal) {
    if (!(normal.dot(u) < 0)) return;
    normal = -normal;
    ++turned;
  };
  for (std::size_t i = 0; i < cloud.x.size(); ++i) turn_towards(cloud.u[i], normals[cloud.original[i]]);
  for (Index i = 0; i < normals.size(); ++i) {
    const Index first = cloud.representative[i];
    if (first != kNoIndex && first != i) turn_towards(normals[first], normals[i]);
  }
  return turned;
}

}  // namespace

NormalAgreement normal_agreement(const std::vector<Vec3>& points, const Normals& normals,
                                 const NeighbourGraphOptions& options, const Execution& run) {
  const DistinctPoints cloud = distinct_points(points, normals);
  return agreement_along(neighbour_edges(cloud, options, run), cloud.u);
}

ConsistentOrientation orient_consistently(const std::vector<Vec3>& points, Normals& normals,
                                          const NeighbourGraphOptions& options, const Execution& run) {
  DistinctPoints cloud = distinct_points(points, normals);
  std::vector<Edge> edges = neighbour_edges(cloud, options, run);
  check_cancelled(run);
  std::sort(edges.begin(), edges.end());
  std::vector<std::vector<Index>> parts = orient_parts(edges, cloud.u);
  for (std::vector<Index>& part : parts) {
    if (!looks_inward(cloud.x, cloud.u, part)) continue;
    for (const Index i : part) cloud.u[i] = -cloud.u[i];
  }
  ConsistentOrientation result;
  result.parts = parts.size();
  result.agreement = agreement_along(edges, cloud.u);
  result.turned = apply_signs(cloud, normals);
  return result;
}

}  // namespace kappa
