// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// What the kernels of points see: plain pointers alone. They are compiled once for each instruction set, so nothing
// here or there may instantiate a function that other files share.

namespace kappa::kernels {

inline constexpr std::size_t kBlockPoints = 8;

/// Points side by side, coordinate by coordinate; places that hold none are at infinity.
struct alignas(64) PointBlock {
  double x[3][kBlockPoints];
};

/// The boxes of 8 blocks, or of 8 nodes of the level below; one of nothing reaches from infinity to -infinity.
struct alignas(64) PointBoxes {
  double low[3][8], high[3][8];
};

/// Boxes of any 8 blocks, and which they are.
struct NamedBoxes {
  PointBoxes boxes;
  std::uint32_t names[8];
};

/// Some of the blocks of a cloud.
struct ChosenBlocks {
  const PointBlock* blocks;
  const std::uint32_t* chosen;
  std::size_t count;

  std::size_t places() const { return count * kBlockPoints; }
};

/// Points side by side, relative to a centre; places that hold none are there, where they add nothing to a sum.
struct alignas(32) FourPoints {
  double x[3][4];
};

/// How many points there are, in the places of so many times four.
struct Selected {
  std::size_t fours, count;
};

inline constexpr std::size_t kPlaneSums = 9;     ///< x y z xx xy xz yy yz zz
inline constexpr std::size_t kQuadricSums = 13;  ///< zz, zxx zxy zyy, xxx xxy xyy yyy, xxxx ... yyyy

/// The kernels of one instruction set. All give the same bits.
struct PointTable {
  /// Children of some nodes of a level that come within a distance of the box from `low` to `high`, in the order of the
  /// nodes; how many they are. There is room for all, and 8 more.
  std::size_t (*open)(const PointBoxes* level, const std::uint32_t* nodes, std::size_t count, const double* low,
                      const double* high, double distance_sq, std::uint32_t* children);
  /// Names of the boxes that come within a distance of a place, in order; how many they are. There is room for all, and
  /// 8 more.
  std::size_t (*meet)(const NamedBoxes* boxes, std::size_t count, const double* centre, double distance_sq,
                      std::uint32_t* met);
  /// Points of the chosen blocks within the closed ball, relative to its centre, and sums over them as kPlaneSums has
  /// them. There is room for all places.
  Selected (*select)(const ChosenBlocks& from, const double* centre, double radius_sq, FourPoints* to, double* sums);
  /// The same points by index, block times kBlockPoints plus place, as doubles, and squared distance; how many they
  /// are. There is room for kBlockPoints more than places.
  std::size_t (*measure)(const ChosenBlocks& from, const double* centre, double radius_sq, double* points,
                         double* distances_sq);
  /// For every value how many of the others are smaller. Both have room for kBlockPoints more.
  void (*rank)(const double* values, std::size_t count, std::uint32_t* ranks);
  /// Sums over points as kPlaneSums has them.
  void (*plane_sums)(const FourPoints* points, std::size_t fours, double* sums);
  /// Sums over points turned by a matrix, row by row, as kQuadricSums has them.
  void (*quadric_sums)(const FourPoints* points, std::size_t fours, const double* matrix, double* sums);
};

const PointTable& baseline_point_table();
#if defined(KAPPA_AVX2_KERNELS)
const PointTable& avx2_point_table();
#endif

/// The table for this processor.
const PointTable& best_point_table();

}  // namespace kappa::kernels
