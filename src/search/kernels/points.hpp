// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "balls/kernels/lanes.hpp"
#include "views.hpp"

// Points in balls and sums over them. Included by kernel files alone.

namespace kappa::kernels {
namespace {

constexpr std::size_t kStep = Lanes<double>::kCount;

/// What is nothing is infinitely far, and not to be found.
inline double finite(double distance_sq) {
  constexpr double kMost = 1.7976931348623157e308;
  return distance_sq < kMost ? distance_sq : kMost;
}

/// Zero in the other lanes.
inline VD only(MD mask, VD v) {
  return reinterpret_cast<VD>(mask & reinterpret_cast<MD>(v));
}

/// A box in all lanes.
struct SpreadBox {
  VD low[3], high[3];
  SpreadBox(const double* from, const double* to)
      : low{spread(from[0]), spread(from[1]), spread(from[2])}, high{spread(to[0]), spread(to[1]), spread(to[2])} {}
};

/// Squared distances of four boxes from another one. No distance of their points is rounded to less: it is computed
/// from differences that are as large, in the same order.
inline VD gaps_sq(const PointBoxes& boxes, std::size_t at, const SpreadBox& box) {
  const auto gap = [&](int axis) {
    const VD below = load<VD>(boxes.low[axis] + at) - box.high[axis];
    const VD above = box.low[axis] - load<VD>(boxes.high[axis] + at);
    return max(max(below, above), VD{});
  };
  const Vector3<VD> d = {gap(0), gap(1), gap(2)};
  return dot(d, d);
}

/// Which of 8 boxes come within a distance of another one.
inline unsigned met_boxes(const PointBoxes& boxes, const SpreadBox& box, const VD& distance_sq) {
  const auto met = [&](std::size_t at) { return bits(gaps_sq(boxes, at, box) <= distance_sq) << at; };
  return met(0) | met(kStep);
}

/// Keeps those of 8 names that a mask has; how many they are. Without a branch: how many are met is hard to foresee.
inline std::size_t keep_names(VF names, unsigned mask, std::uint32_t* to) {
  store(to, Compression<VF>(mask)(names));
  return static_cast<std::size_t>(__builtin_popcount(mask));
}

inline std::size_t open_nodes(const PointBoxes* level, const std::uint32_t* nodes, std::size_t count, const double* low,
                              const double* high, double distance_sq, std::uint32_t* children) {
  const SpreadBox box(low, high);
  const VD most = spread(finite(distance_sq));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found += keep_names(numbers_from(8 * nodes[i]), met_boxes(level[nodes[i]], box, most), children + found);
  return found;
}

inline std::size_t meet_boxes(const NamedBoxes* boxes, std::size_t count, const double* centre, double distance_sq,
                              std::uint32_t* met) {
  const SpreadBox place(centre, centre);
  const VD most = spread(finite(distance_sq));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found += keep_names(load<VF>(boxes[i].names), met_boxes(boxes[i].boxes, place, most), met + found);
  return found;
}

/// Four places of a block: where they lie relative to the centre of a ball, their squared distances, and which are
/// inside.
struct Four {
  Vector3<VD> d;
  VD distance_sq;
  MD is_inside;
  unsigned inside;

  std::size_t count() const { return static_cast<std::size_t>(__builtin_popcount(inside)); }
};

/// Calls `use` for four places after the other, with the index of the first.
template <class Use>
[[gnu::always_inline]] inline void for_each_four(const ChosenBlocks& from, const double* centre, double radius_sq,
                                                 const Use& use) {
  const VD cx = spread(centre[0]), cy = spread(centre[1]), cz = spread(centre[2]);
  const VD most = spread(finite(radius_sq));
  const PointBlock* const blocks = from.blocks;
  for (const std::uint32_t *chosen = from.chosen, *end = chosen + from.count; chosen != end; ++chosen) {
    const auto four = [&](std::size_t at) {
      const PointBlock& block = blocks[*chosen];
      const Vector3<VD> d = {load<VD>(block.x[0] + at) - cx, load<VD>(block.x[1] + at) - cy,
                             load<VD>(block.x[2] + at) - cz};
      const VD distance_sq = dot(d, d);
      const MD is_inside = distance_sq <= most;
      return Four{d, distance_sq, is_inside, bits(is_inside)};
    };
    const std::size_t first = std::size_t{kBlockPoints} * *chosen;
    const Four a = four(0), b = four(kStep);  // both before anything is stored
    use(a, first);
    use(b, first + kStep);
  }
}

inline double total(const VD& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

/// Adds up the terms of four points after the other.
template <std::size_t kTerms>
struct Sums {
  VD of[kTerms] = {};

  void add(const VD (&terms)[kTerms]) {
    for (std::size_t term = 0; term < kTerms; ++term) of[term] += terms[term];
  }
  void to(double* sums) const {
    for (std::size_t term = 0; term < kTerms; ++term) sums[term] = total(of[term]);
  }
};

inline void add_for_plane(const Vector3<VD>& d, Sums<kPlaneSums>& sums) {
  sums.add({d.x, d.y, d.z, d.x * d.x, d.x * d.y, d.x * d.z, d.y * d.y, d.y * d.z, d.z * d.z});
}

inline Vector3<VD> points_of(const FourPoints& four) {
  return {load<VD>(four.x[0]), load<VD>(four.x[1]), load<VD>(four.x[2])};
}

/// Whole fours are kept if one of their points is inside: to move the points together would cost more than it saves.
inline Selected select_points(const ChosenBlocks& from, const double* centre, double radius_sq, FourPoints* to,
                              double* sums) {
  Selected selected{0, 0};
  Sums<kPlaneSums> of_plane;
  for_each_four(from, centre, radius_sq, [&](const Four& four, std::size_t) {
    const Vector3<VD> d = {only(four.is_inside, four.d.x), only(four.is_inside, four.d.y),
                           only(four.is_inside, four.d.z)};
    FourPoints& place = to[selected.fours];
    store(place.x[0], d.x);
    store(place.x[1], d.y);
    store(place.x[2], d.z);
    add_for_plane(d, of_plane);
    selected.count += four.count();
    selected.fours += four.inside != 0;
  });
  of_plane.to(sums);
  return selected;
}

inline std::size_t measure_points(const ChosenBlocks& from, const double* centre, double radius_sq, double* points,
                                  double* distances_sq) {
  std::size_t count = 0;
  for_each_four(from, centre, radius_sq, [&](const Four& four, std::size_t first) {
    const Compression<VD> compressed(four.inside);
    store(points + count, compressed(spread(static_cast<double>(first)) + VD{0, 1, 2, 3}));
    store(distances_sq + count, compressed(four.distance_sq));
    count += four.count();
  });
  return count;
}

inline void rank_values(const double* values, std::size_t count, std::uint32_t* ranks) {
  for (std::size_t i = 0; i < count; i += 2 * kStep) {
    const VD four = load<VD>(values + i), next = load<VD>(values + i + kStep);
    MD smaller{}, than_next{};  // a lane of a comparison is -1 where it holds
    for (std::size_t j = 0; j < count; ++j) {
      const VD value = spread(values[j]);
      smaller -= value < four;
      than_next -= value < next;
    }
    for (int lane = 0; lane < static_cast<int>(kStep); ++lane) {
      ranks[i + lane] = static_cast<std::uint32_t>(smaller[lane]);
      ranks[i + kStep + lane] = static_cast<std::uint32_t>(than_next[lane]);
    }
  }
}

inline void sum_for_plane(const FourPoints* points, std::size_t fours, double* sums) {
  Sums<kPlaneSums> of_plane;
  for (std::size_t i = 0; i < fours; ++i) add_for_plane(points_of(points[i]), of_plane);
  of_plane.to(sums);
}

inline void sum_for_quadric(const FourPoints* points, std::size_t fours, const double* matrix, double* sums) {
  VD rows[9];
  for (int i = 0; i < 9; ++i) rows[i] = spread(matrix[i]);
  Sums<kQuadricSums> of_quadric;
  for (std::size_t i = 0; i < fours; ++i) {
    const Vector3<VD> d = points_of(points[i]);
    const auto row = [&](int r) { return rows[3 * r] * d.x + rows[3 * r + 1] * d.y + rows[3 * r + 2] * d.z; };
    const VD x = row(0), y = row(1), z = row(2), xx = x * x, xy = x * y, yy = y * y;
    of_quadric.add(
        {z * z, z * xx, z * xy, z * yy, xx * x, xx * y, x * yy, yy * y, xx * xx, xx * xy, xx * yy, xy * yy, yy * yy});
  }
  of_quadric.to(sums);
}

constexpr PointTable kPointTable = {open_nodes,  meet_boxes,    select_points,  measure_points,
                                    rank_values, sum_for_plane, sum_for_quadric};

}  // namespace
}  // namespace kappa::kernels
