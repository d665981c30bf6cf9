// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/umbrella.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "delaunay_star.hpp"
#include "kappa/core/curvatures.hpp"
#include "kappa/core/error.hpp"
#include "kappa/mesh/ball_sum.hpp"
#include "kappa/search/cloud_normals.hpp"
#include "kappa/search/neighbours.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;

/// The triangles (p, a, b) that one point contributes, as (a, b).
using Star = std::vector<std::pair<Index, Index>>;

/// A number in [-1, 1] that depends on the index alone (the finaliser of MurmurHash3).
double tie_break(Index i) {
  std::uint64_t h = (static_cast<std::uint64_t>(i) + 1) * 0x9e3779b97f4a7c15ULL;
  h = (h ^ h >> 33) * 0xff51afd7ed558ccdULL;
  h = (h ^ h >> 33) * 0xc4ceb9fe1a85ec53ULL;
  h ^= h >> 33;
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

/// The points a surface is made of: one at each position, all with a normal.
struct Distinct {
  std::vector<Vec3> points;
  std::vector<Index> original;
};

/// The neighbours of every distinct point, nearest first.
struct Neighbourhoods {
  std::size_t k = 0;            ///< most neighbours of a point
  std::vector<Index> items;     ///< k a point, kNoIndex where there are fewer
  std::vector<double> reach;    ///< distance to the last
  std::vector<double> weights;  ///< see kTieBreak
};

/// The weight of a point in the Delaunay triangulations, over its squared distance to the nearest neighbour: a random
/// number of this size. It settles the diagonals of grid cells, alike in all stars, also where the tangent planes of a
/// curved surface distort each cell a little, by a part (spacing / radius of curvature)^2. No two weights differ by
/// more than twice this part of the squared distance of their points, so no point is hidden by its neighbours.
constexpr double kTieBreak = 0.1;

Neighbourhoods find_neighbours(const Distinct& distinct, const NeighbourSearch& search, const std::vector<Index>& order,
                               int neighbours, const Execution& run) {
  Neighbourhoods n;
  n.k = std::min(static_cast<std::size_t>(neighbours), std::max<std::size_t>(distinct.points.size(), 1) - 1);
  n.items.assign(n.k * distinct.points.size(), kNoIndex);
  n.reach.assign(distinct.points.size(), 0.0);
  n.weights.assign(distinct.points.size(), 0.0);
  parallel_for(distinct.points.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<Index> found;
    std::vector<double> distances_sq;
    for (std::size_t at = begin; at < end; ++at) {
      const Index i = order[at];
      search.nearest(distinct.points[i], n.k + 1, found, distances_sq);
      found.erase(std::remove(found.begin(), found.end(), i), found.end());
      std::copy_n(found.begin(), n.k, n.items.begin() + static_cast<std::ptrdiff_t>(i * n.k));
      n.reach[i] = std::sqrt(distances_sq.back());
      if (n.k > 0) n.weights[i] = kTieBreak * distances_sq[1] * tie_break(distinct.original[i]);
    }
  });
  return n;
}

/// Makes the stars of distinct points, one thread's worth of memory.
class StarMaker {
 public:
  StarMaker(const Distinct& distinct, const Normals& normals, const NeighbourSearch& search,
            const Neighbourhoods& neighbourhoods)
      : distinct_(distinct), normals_(normals), search_(search), near_(neighbourhoods) {}

  Star make(std::size_t i) {
    const double reach = near_.reach[i];
    const Index* first = near_.items.data() + i * near_.k;
    found_.assign(first, first + near_.k);
    if (found_.size() < 3) return {};
    const auto* triangles = &compute(i, reach);
    if (2 * delaunay_.cell_radius() > reach) {
      // Points beyond the neighbourhood may still cut the cell: with all that can, the star is exact.
      search_.within(distinct_.points[i], 2 * delaunay_.cell_radius(), found_, distances_sq_);
      triangles = &compute(i, reach);
    }
    Star star;
    for (const auto& [a, b] : *triangles)
      star.emplace_back(distinct_.original[found_[static_cast<std::size_t>(a)]],
                        distinct_.original[found_[static_cast<std::size_t>(b)]]);
    return star;
  }

 private:
  /// The triangles of the star of `i` among the points found_.
  const std::vector<std::pair<int, int>>& compute(std::size_t i, double reach) {
    Vec3 t1, t2;
    tangent_basis(normals_[distinct_.original[i]].normalized(), t1, t2);
    neighbours_.clear();
    for (const Index j : found_) {
      const Vec3 d = distinct_.points[j] - distinct_.points[i];
      neighbours_.push_back({Vec2(t1.dot(d), t2.dot(d)), near_.weights[j]});
    }
    return delaunay_.compute(neighbours_, near_.weights[i], reach);
  }

  const Distinct& distinct_;
  const Normals& normals_;
  const NeighbourSearch& search_;
  const Neighbourhoods& near_;
  DelaunayStar delaunay_;
  std::vector<Index> found_;
  std::vector<double> distances_sq_;
  std::vector<DelaunayStar::Neighbour> neighbours_;
};

Distinct select_points(const std::vector<Vec3>& points, const Normals& normals, CloudSurface& surface) {
  surface.representative = find_duplicates(points);
  Distinct distinct;
  for (Index i = 0; i < points.size(); ++i) {
    const bool has_normal = is_finite(normals[i]) && !normals[i].isZero(0);
    if (surface.representative[i] == kNoIndex || !has_normal) {
      ++surface.invalid_points;
    } else if (surface.representative[i] != i) {
      ++surface.duplicate_points;
    } else {
      distinct.points.push_back(points[i]);
      distinct.original.push_back(i);
    }
  }
  return distinct;
}

bool contains(const Star& star, Index a, Index b) {
  return std::find(star.begin(), star.end(), std::make_pair(a, b)) != star.end();
}

/// Equal triangles of several stars become one face, emitted by the lowest of its corners whose star has it.
void merge_stars(const std::vector<Star>& stars, Mesh& mesh) {
  for (Index p = 0; p < stars.size(); ++p) {
    for (const auto& [a, b] : stars[p]) {
      const bool in_a = contains(stars[a], b, p), in_b = contains(stars[b], p, a);
      if ((in_a && a < p) || (in_b && b < p)) continue;
      mesh.faces.add(p, a, b);
      mesh.weights.push_back((1 + int{in_a} + int{in_b}) / 3.0);
    }
  }
}

void check(const std::vector<Vec3>& points, const Normals& normals, const UmbrellaOptions& options) {
  if (normals.size() != points.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(normals.size()) + " normals for " +
                                                std::to_string(points.size()) + " points: give one a point");
  if (options.neighbours < 3 || options.neighbours > 255)
    throw Error(ErrorCode::InvalidArgument,
                "neighbours = " + std::to_string(options.neighbours) + ": give 3 to 255 for the umbrella surface");
}

}  // namespace

CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Normals& normals,
                              const UmbrellaOptions& options, const Execution& run) {
  check(points, normals, options);
  CloudSurface surface;
  const Distinct distinct = select_points(points, normals, surface);
  if (distinct.points.empty())
    throw Error(ErrorCode::InvalidData, "none of the " + std::to_string(points.size()) +
                                            " points is finite and has a normal: no surface can be made of them");
  const NeighbourSearch search(distinct.points);
  const std::vector<Index> order = spatial_order(distinct.points);
  const Neighbourhoods near = find_neighbours(distinct, search, order, options.neighbours, stage(run, 0.0, 0.6));
  std::vector<Star> stars(points.size());
  parallel_for(distinct.points.size(), kBlock, stage(run, 0.6, 1.0), [&](std::size_t begin, std::size_t end, int) {
    StarMaker maker(distinct, normals, search, near);
    for (std::size_t i = begin; i < end; ++i) stars[distinct.original[order[i]]] = maker.make(order[i]);
  });
  for (const Index i : distinct.original) surface.starless_points += stars[i].empty();
  surface.mesh.origin = origin;
  surface.mesh.vertices = points;
  merge_stars(stars, surface.mesh);
  return surface;
}

}  // namespace kappa
