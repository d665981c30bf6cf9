// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// What the query kernels see of a measure tree: plain pointers alone. The kernels are compiled once for each
// instruction set, so nothing here or there may instantiate a function that other files share.

namespace kappa::kernels {

inline constexpr int kWidth = 8;       ///< children of a node, triangles of a leaf
inline constexpr int kMaxLevels = 12;  ///< 8^12 nodes are more than indices can count
inline constexpr int kSums = 9;        ///< doubles of a MeasureSum: area, mu0, mu2, sym mu
inline constexpr int kBuffer = 64;     ///< sums waiting to be added
inline constexpr int kRim = 32;        ///< triangles waiting to be measured, a multiple of the lanes

/// Boxes of 8 nodes side by side; those that do not exist have lo = infinity, hi = -infinity.
struct alignas(64) BoxBlock {
  double lo[3][kWidth], hi[3][kWidth];
};

/// Corners of 8 triangles side by side, coordinate by coordinate; infinity where there is no triangle.
template <class Real>
struct Leaf;

template <>
struct alignas(64) Leaf<double> {
  double x[9][kWidth];
};

/// In floats the corners are relative to a point of the leaf.
template <>
struct Leaf<float> {
  float x[9][kWidth];
  double origin[3];
};

/// One level: nodes 8 j to 8 j + 7 are the children of node j of the level above. Level 0 are the leaves.
struct Level {
  const BoxBlock* boxes;  ///< one a block of 8 nodes
  const double* sums;     ///< kSums a node
};

template <class Real>
struct TreeView {
  int levels;
  Level level[kMaxLevels];
  const Leaf<Real>* leaves;
  const std::uint32_t* order;  ///< triangle at each place in the leaves
  std::size_t triangles;

  // Of the triangles in their own order.
  const double* measures;        ///< kSums each
  const std::uint32_t* corners;  ///< 3 each
  const double* normals;         ///< 3 a vertex
  const double* weights;
};

/// What a ball has got so far.
struct alignas(64) BallAccumulator {
  double sum[12];       ///< kSums used
  double excess[8][8];  ///< mu0, mu2, sym mu that cut faces have over their share, a lane each
  std::uint64_t faces;
  const double* whole[kBuffer];  ///< sums of nodes and triangles inside, to be added
  int whole_count;
  double rim[9][kRim];  ///< corners of triangles that the sphere may cut, relative to the centre
  std::uint32_t rim_triangle[kRim];
  int rim_count;
};

/// One query.
struct BallQuery {
  double centre[3];
  const double* radii;  ///< increasing
  const double* radii_sq;
  int count;
  bool exact_density;
  BallAccumulator* balls;  ///< one a radius
  /// Receives a triangle whose share in the ball of the radius needs the forms of triangle_ball.hpp.
  void (*careful)(void* context, std::uint32_t triangle, int radius);
  void* context;
};

void query_baseline(const TreeView<double>& tree, const BallQuery& query);
void query_baseline(const TreeView<float>& tree, const BallQuery& query);
void query_avx2(const TreeView<double>& tree, const BallQuery& query);
void query_avx2(const TreeView<float>& tree, const BallQuery& query);

}  // namespace kappa::kernels
