// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/umbrella.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "core/large_array.hpp"
#include "delaunay_star.hpp"
#include "kappa/core/curvatures.hpp"
#include "kappa/core/error.hpp"
#include "on_positions.hpp"

namespace kappa {
namespace {

constexpr Index kBlock = 256;
constexpr std::size_t kSearchBlock = 4096;

/// The triangles (p, a, b) that each point p contributes, as (a, b), in blocks of points that threads fill.
class Stars {
 public:
  using Edge = std::pair<Index, Index>;
  struct Star {
    const Edge *first, *last;
    const Edge* begin() const { return first; }
    const Edge* end() const { return last; }
    bool empty() const { return first == last; }
    bool contains(Index a, Index b) const {
      const std::uint64_t wanted = word_of({a, b});
      bool found = false;
      for (const Edge* e = first; e != last; ++e) found |= word_of(*e) == wanted;
      return found;
    }

   private:
    static std::uint64_t word_of(const Edge& e) { return std::uint64_t{e.second} << 32 | e.first; }
  };

  explicit Stars(std::size_t points) : blocks_((points + kBlock - 1) / kBlock), end_(points) {}

  /// Adds the star of `p`, the next of its block.
  void add(Index p, const std::vector<Edge>& star) {
    std::vector<Edge>& block = blocks_[p / kBlock];
    if (block.empty()) block.reserve(8 * kBlock);
    block.insert(block.end(), star.begin(), star.end());
    end_[p] = static_cast<Index>(block.size());
  }

  Star operator[](Index p) const {
    const Edge* const block = blocks_[p / kBlock].data();
    return {block + (p % kBlock == 0 ? 0 : end_[p - 1]), block + end_[p]};
  }

  std::size_t size() const { return end_.size(); }

 private:
  std::vector<std::vector<Edge>> blocks_;
  std::vector<Index> end_;  ///< of each star in its block
};

/// A number in [-1, 1] that depends on the index alone (the finaliser of MurmurHash3).
double tie_break(Index i) {
  std::uint64_t h = (static_cast<std::uint64_t>(i) + 1) * 0x9e3779b97f4a7c15ULL;
  h = (h ^ h >> 33) * 0xff51afd7ed558ccdULL;
  h = (h ^ h >> 33) * 0xc4ceb9fe1a85ec53ULL;
  h ^= h >> 33;
  return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

/// The neighbours of every position, nearest first.
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

Neighbourhoods find_neighbours(const Positions& positions, int neighbours, const Execution& run) {
  const std::size_t count = positions.x.size();
  Neighbourhoods n;
  n.k = std::min(static_cast<std::size_t>(neighbours), count - 1);
  n.items = large_vector<Index>(n.k * count, kNoIndex, run);
  n.reach.assign(count, 0.0);
  n.weights.assign(count, 0.0);
  parallel_for(count, kSearchBlock, run, [&](std::size_t begin, std::size_t end, int) {
    NearestInRuns nearest(positions.search, n.k + 1);
    nearest.for_each(begin, end, [&](std::size_t i, const std::vector<Index>& found, const auto& distances_sq) {
      Index *to = n.items.data() + i * n.k, *const last = to + n.k;
      for (const Index j : found) {
        if (j != i && to != last) *to++ = j;
      }
      n.reach[i] = std::sqrt(distances_sq.back());
      if (n.k > 0) n.weights[i] = kTieBreak * distances_sq[1] * tie_break(positions.original[i]);
    });
  });
  return n;
}

/// Makes the stars of positions, one thread's worth of memory.
class StarMaker {
 public:
  StarMaker(const Positions& positions, const Normals& normals, const Neighbourhoods& neighbourhoods)
      : positions_(positions), normals_(normals), near_(neighbourhoods) {}

  const std::vector<Stars::Edge>& make(std::size_t i) {
    star_.clear();
    const double reach = near_.reach[i];
    const Index* first = near_.items.data() + i * near_.k;
    found_.assign(first, first + near_.k);
    if (found_.size() < 3) return star_;
    tangent_basis(normals_[positions_.original[i]].normalized(), t1_, t2_);
    project_from(0, i);
    const auto* triangles = &delaunay_.compute(neighbours_, near_.weights[i], reach);
    if (2 * delaunay_.cell_radius() > reach) {
      // Points beyond the neighbourhood may still cut the cell: with all that can, the star is exact.
      add_within(i, 2 * delaunay_.cell_radius());
      project_from(near_.k, i);
      triangles = &delaunay_.extend(neighbours_, near_.k, near_.weights[i], reach);
    }
    for (const auto& [a, b] : *triangles)
      star_.emplace_back(found_[static_cast<std::size_t>(a)], found_[static_cast<std::size_t>(b)]);
    return star_;
  }

 private:
  /// Adds to found_ the points within `radius` that are not there: they are no nearer than the last one there.
  void add_within(std::size_t i, double radius) {
    constexpr double kSurely = 1 - 1e-12;
    positions_.search.within(positions_.x[i], radius, within_, distances_sq_, work_);
    const Index *first = near_.items.data() + i * near_.k, *last = first + near_.k;
    const double there = kSurely * near_.reach[i] * near_.reach[i];
    for (std::size_t n = 0; n < within_.size(); ++n) {
      if (distances_sq_[n] >= there && std::find(first, last, within_[n]) == last) found_.push_back(within_[n]);
    }
  }

  /// Sets neighbours_ to the found_ points, from `first` on, in the tangent plane of `i`.
  void project_from(std::size_t first, std::size_t i) {
    neighbours_.resize(found_.size());
    for (std::size_t n = first; n < found_.size(); ++n) {
      const Vec3 d = positions_.x[found_[n]] - positions_.x[i];
      neighbours_[n] = {Vec2(t1_.dot(d), t2_.dot(d)), near_.weights[found_[n]]};
    }
  }

  const Positions& positions_;
  const Normals& normals_;
  const Neighbourhoods& near_;
  DelaunayStar delaunay_;
  Vec3 t1_, t2_;
  std::vector<Index> found_, within_;
  std::vector<double> distances_sq_;
  PointBlocks::Work work_;
  std::vector<DelaunayStar::Neighbour> neighbours_;
  std::vector<Stars::Edge> star_;
};

Stars make_stars(const Positions& positions, const Normals& normals, int neighbours, const Execution& run) {
  const Neighbourhoods near = find_neighbours(positions, neighbours, stage(run, 0.0, 0.6));
  Stars stars(positions.x.size());
  parallel_for(stars.size(), kBlock, stage(run, 0.6, 1.0), [&](std::size_t begin, std::size_t end, int) {
    StarMaker maker(positions, normals, near);
    for (std::size_t i = begin; i < end; ++i) stars.add(static_cast<Index>(i), maker.make(i));
  });
  return stars;
}

bool has_normal(const Normals& normals, Index i) {
  return is_finite(normals[i]) && !normals[i].isZero(0);
}

void count_points(const Positions& positions, const Normals& normals, CloudSurface& surface) {
  for (Index i = 0; i < normals.size(); ++i) {
    if (positions.representative[i] == kNoIndex || !has_normal(normals, i)) {
      ++surface.invalid_points;
    } else if (positions.representative[i] != i) {
      ++surface.duplicate_points;
    }
  }
}

/// The positions whose first point has a normal, if they are not all.
std::optional<Positions> with_normals(const Positions& positions, const Normals& normals) {
  std::vector<char> keep(positions.x.size());
  std::transform(positions.original.begin(), positions.original.end(), keep.begin(),
                 [&](Index i) { return has_normal(normals, i); });
  if (std::find(keep.begin(), keep.end(), 0) == keep.end()) return std::nullopt;
  return Positions(positions, keep);
}

/// How many stars hold the triangle (p, a, b) of the star of `p`; 0 where the star of a lower corner has it too.
std::uint8_t share_of(const Stars& stars, Index p, Index a, Index b) {
  const bool a_first = a < b;  // where that star has it, the other one need not be looked at
  const bool in_lower = a_first ? stars[a].contains(b, p) : stars[b].contains(p, a);
  if (in_lower && std::min(a, b) < p) return 0;
  const bool in_higher = a_first ? stars[b].contains(p, a) : stars[a].contains(b, p);
  if (in_higher && std::max(a, b) < p) return 0;
  return static_cast<std::uint8_t>(1 + int{in_lower} + int{in_higher});
}

/// share_of every triangle of every star, by blocks of points.
std::vector<std::vector<std::uint8_t>> find_shares(const Stars& stars, const Execution& run) {
  std::vector<std::vector<std::uint8_t>> shares((stars.size() + kBlock - 1) / kBlock);
  parallel_for(stars.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<std::uint8_t>& block = shares[begin / kBlock];
    for (auto p = static_cast<Index>(begin); p < end; ++p) {
      for (const auto& [a, b] : stars[p]) block.push_back(share_of(stars, p, a, b));
    }
  });
  return shares;
}

/// Equal triangles of several stars become one face, emitted by the lowest of its corners whose star has it.
void merge_stars(const Stars& stars, const std::vector<Index>& original, const Execution& run, Mesh& mesh) {
  const std::vector<std::vector<std::uint8_t>> shares = find_shares(stars, run);
  std::ptrdiff_t faces = 0;
  for (const auto& block : shares) faces += std::count_if(block.begin(), block.end(), [](auto n) { return n > 0; });
  mesh.faces.reserve(static_cast<std::size_t>(faces), 3 * static_cast<std::size_t>(faces));
  mesh.weights.reserve(static_cast<std::size_t>(faces));
  auto share = shares.front().begin();
  for (Index p = 0; p < stars.size(); ++p) {
    if (p % kBlock == 0) share = shares[p / kBlock].begin();
    for (const auto& [a, b] : stars[p]) {
      const int stars_with_it = *share++;
      if (stars_with_it == 0) continue;
      mesh.faces.add(original[p], original[a], original[b]);
      mesh.weights.push_back(stars_with_it / 3.0);
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

CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Positions& positions,
                              const Normals& normals, const UmbrellaOptions& options, const Execution& run) {
  check(points, normals, options);
  CloudSurface surface;
  count_points(positions, normals, surface);
  const std::optional<Positions> some = with_normals(positions, normals);
  const Positions& used = some ? *some : positions;
  if (used.x.empty())
    throw Error(ErrorCode::InvalidData, "none of the " + std::to_string(points.size()) +
                                            " points is finite and has a normal: no surface can be made of them");
  const Stars stars = make_stars(used, normals, options.neighbours, stage(run, 0.0, 0.9));
  for (Index p = 0; p < stars.size(); ++p) surface.starless_points += stars[p].empty();
  surface.mesh.origin = origin;
  merge_stars(stars, used.original, stage(run, 0.9, 1.0), surface.mesh);
  surface.mesh.vertices = points;
  surface.representative = positions.representative;
  return surface;
}

CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Normals& normals,
                              const UmbrellaOptions& options, const Execution& run) {
  check(points, normals, options);
  return umbrella_surface(origin, points, Positions(points), normals, options, run);
}

}  // namespace kappa
