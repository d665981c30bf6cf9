// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../../mesh/kernels/lanes.hpp"
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

inline std::size_t open_nodes(const PointBoxes* level, const std::uint32_t* nodes, std::size_t count, const double* low,
                              const double* high, double distance_sq, std::uint32_t* children) {
  const SpreadBox box(low, high);
  const VD most = spread(finite(distance_sq));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto met = [&](std::size_t at) { return bits(gaps_sq(level[nodes[i]], at, box) <= most) << at; };
    const unsigned all = met(0) | met(kStep);
    // Without a branch: how many are met is hard to foresee.
    store(children + found, Compression<VF>(all)(numbers_from(8 * nodes[i])));
    found += static_cast<std::size_t>(__builtin_popcount(all));
  }
  return found;
}

/// Four places of a block: where they lie relative to the centre of a ball, their squared distances, and a mask of
/// those inside.
struct Four {
  Vector3<VD> d;
  VD distance_sq;
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
      return Four{d, distance_sq, bits(distance_sq <= most)};
    };
    const std::size_t first = std::size_t{kBlockPoints} * *chosen;
    const Four a = four(0), b = four(kStep);  // both before anything is stored
    use(a, first);
    use(b, first + kStep);
  }
}

inline std::size_t select_points(const ChosenBlocks& from, const double* centre, double radius_sq,
                                 const PointColumns& to) {
  const PointColumns columns = to;
  std::size_t count = 0;
  for_each_four(from, centre, radius_sq, [&](const Four& four, std::size_t) {
    const Compression<VD> compressed(four.inside);
    store(columns.x + count, compressed(four.d.x));
    store(columns.y + count, compressed(four.d.y));
    store(columns.z + count, compressed(four.d.z));
    count += four.count();
  });
  return count;
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

inline double total(const VD& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

/// Points at the origin add nothing to a sum: with them the last four are whole.
inline void fill_up(const PointColumns& points, std::size_t count) {
  store(points.x + count, VD{});
  store(points.y + count, VD{});
  store(points.z + count, VD{});
}

inline void sum_for_plane(const PointColumns& points, std::size_t count, double* sums) {
  fill_up(points, count);
  VD m[kPlaneSums] = {};
  for (std::size_t i = 0; i < count; i += kStep) {
    const VD x = load<VD>(points.x + i), y = load<VD>(points.y + i), z = load<VD>(points.z + i);
    const VD terms[kPlaneSums] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (std::size_t term = 0; term < kPlaneSums; ++term) m[term] += terms[term];
  }
  for (std::size_t term = 0; term < kPlaneSums; ++term) sums[term] = total(m[term]);
}

constexpr std::size_t kLow = 12, kHigh = kQuadricSums - kLow;

inline void sum_low_powers(const PointColumns& points, std::size_t count, const double* matrix, double* sums) {
  VD m[kLow] = {}, rows[9];
  for (int i = 0; i < 9; ++i) rows[i] = spread(matrix[i]);
  for (std::size_t i = 0; i < count; i += kStep) {
    const Vector3<VD> d = {load<VD>(points.x + i), load<VD>(points.y + i), load<VD>(points.z + i)};
    const auto row = [&](int r) { return rows[3 * r] * d.x + rows[3 * r + 1] * d.y + rows[3 * r + 2] * d.z; };
    const VD x = row(0), y = row(1), z = row(2), xx = x * x, xy = x * y, yy = y * y;
    store(points.x + i, x);
    store(points.y + i, y);
    const VD terms[kLow] = {x, y, xx, xy, yy, z, z * x, z * y, z * xx, z * xy, z * yy, z * z};
    for (std::size_t term = 0; term < kLow; ++term) m[term] += terms[term];
  }
  for (std::size_t term = 0; term < kLow; ++term) sums[term] = total(m[term]);
}

inline void sum_high_powers(const PointColumns& points, std::size_t count, double* sums) {
  VD m[kHigh] = {};
  for (std::size_t i = 0; i < count; i += kStep) {
    const VD x = load<VD>(points.x + i), y = load<VD>(points.y + i), xx = x * x, xy = x * y, yy = y * y;
    const VD terms[kHigh] = {xx * x, xx * y, x * yy, yy * y, xx * xx, xx * xy, xx * yy, xy * yy, yy * yy};
    for (std::size_t term = 0; term < kHigh; ++term) m[term] += terms[term];
  }
  for (std::size_t term = 0; term < kHigh; ++term) sums[term] = total(m[term]);
}

/// In two passes, so that the sums of each stay in registers.
inline void sum_for_quadric(const PointColumns& points, std::size_t count, const double* matrix, double* sums) {
  fill_up(points, count);
  sum_low_powers(points, count, matrix, sums);
  sum_high_powers(points, count, sums + kLow);
}

constexpr PointTable kPointTable = {open_nodes,  select_points, measure_points,
                                    rank_values, sum_for_plane, sum_for_quadric};

}  // namespace
}  // namespace kappa::kernels
