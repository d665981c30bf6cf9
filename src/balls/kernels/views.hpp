// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

// What the kernels see: plain pointers alone. They are compiled once for each instruction set, so nothing here or there
// may instantiate a function that other files share.

namespace kappa::kernels {

inline constexpr int kWidth = 8;       ///< children of a node, triangles of a leaf
inline constexpr int kMaxLevels = 12;  ///< 8^12 nodes are more than indices can count
inline constexpr int kSums = 9;        ///< doubles of a MeasureSum: area, mu0, mu2, sym mu
inline constexpr int kWaiting = 64;    ///< sums waiting to be added
inline constexpr int kStart = 128;     ///< nodes that queries may start from, a multiple of kWidth
inline constexpr int kRim = 32;        ///< triangles waiting to be measured, a multiple of the lanes

/// The arrays of a MeasuredTriangles.
struct TriangleView {
  std::size_t count;
  const double* measures;        ///< kSums each; null if they are not kept
  const std::uint32_t* corners;  ///< 3 each
  const double* positions;       ///< 3 a vertex
  const double* normals;         ///< 3 a vertex
  const double* weights;         ///< null if all are 1
  const double* beside;          ///< kSums each that they have beside the integral of their density; null if 0
};

/// Boxes of 8 nodes side by side in the unit of the tree, rounded outward; those that do not exist have
/// lo = infinity, hi = -infinity.
struct alignas(64) BoxBlock {
  float lo[3][kWidth], hi[3][kWidth];
};

/// Eight triangles side by side, coordinate by coordinate.
template <class Real>
struct Leaf;

/// For doubles, corners in whole steps from an origin in the unit of the tree: they tell triangles inside and outside
/// from those near the sphere, which are then taken from the mesh.
template <>
struct alignas(16) Leaf<double> {
  std::int16_t x[9][kWidth];
  double origin[3];
  float steps_a_unit;
  float third_of_longest_sq;  ///< edge, in steps, rounded up
};

/// For floats, in the unit of the tree, all that is needed of them: the first corner from an origin nearby, and the
/// ways from it to the other two; the first normal from a normal nearby, and the ways likewise. Ways keep their digits
/// whatever lies in the same leaf. Where there is no triangle, the first corner is infinitely far and all else 0.
template <>
struct alignas(32) Leaf<float> {
  float x[3][kWidth], e1[3][kWidth], e2[3][kWidth];
  float u[3][kWidth], d1[3][kWidth], d2[3][kWidth];
  float origin[3], normal[3];
  float third_of_longest_sq;  ///< edge, rounded up
};

/// One level: nodes 8 j to 8 j + 7 are the children of node j of the level above. Level 0 are the leaves.
struct Level {
  const BoxBlock* boxes;  ///< one a block of 8 nodes
  const double* sums;     ///< kSums a node
  std::size_t nodes;
};

/// The nodes of a tree.
struct NodeView {
  std::size_t triangles;
  int levels;
  Level level[kMaxLevels];
  double middle[3], unit;  ///< boxes hold (x - middle) * unit, within [-1, 1]
};

/// A tree; its triangles in the order of the leaves.
template <class Real>
struct TreeView {
  TriangleView triangles;
  NodeView nodes;
  const Leaf<Real>* leaves;
};

/// Nodes of one level, increasing, that hold whatever the balls of some queries may meet; no ball holds a node above
/// whole. Their boxes stand side by side; places up to the next multiple of 8 are empty boxes.
struct Start {
  int level, count;
  float lo[3][kStart + kWidth], hi[3][kStart + kWidth];
  std::uint32_t nodes[kStart + kWidth];
};

/// Numbers of the radii [first, last) that a node is opened for.
struct Range {
  int first, last;
};

/// What a walk needs: the nodes that it visits on two levels, and for several radii the radii that it visits them for.
/// Room for kWidth more than a level has nodes, of the leaves.
struct Visits {
  Start start;
  std::uint32_t* nodes[2];
  Range* ranges[2];
};

/// Names of triangles that wait to be measured together.
struct Names {
  static constexpr int kPlaces = kRim + kWidth;
  std::uint32_t triangle[kPlaces];
  int count;
};

/// Triangles of the mesh near the sphere.
template <class Real>
struct Waiting : Names {};

/// Triangles that take the general form, in doubles whatever the precision.
template <class Real>
struct Irregular : Names {};

/// Those of leaves of floats: corners relative to the centre, and what their normals are, as they wait. The mesh is far
/// from where a walk goes.
template <>
struct Irregular<float> : Names {
  alignas(32) double x[3][kPlaces], e1[3][kPlaces], e2[3][kPlaces];
  double u[3][kPlaces], d1[3][kPlaces], d2[3][kPlaces];
};

/// Triangles of leaves of floats near the sphere, as they stand there but relative to the centre.
template <>
struct Waiting<float> : Names {
  alignas(32) float x[3][kPlaces], e1[3][kPlaces], e2[3][kPlaces];
  float u[3][kPlaces], d1[3][kPlaces], d2[3][kPlaces];
  float power[kPlaces];                         ///< |first corner|^2 - radius^2
  float to_second[kPlaces], to_third[kPlaces];  ///< by how much that of the other corners is more
};

/// What a ball has got so far.
template <class Real>
struct alignas(64) Gathering {
  double sum[12];          ///< kSums used
  double lanes[kSums][4];  ///< of triangles measured together, a lane each, in the unit of the walk
  double longest_sq[4];    ///< sum over the triangles that were measured together, a lane each; in doubles alone
  std::uint64_t measured;  ///< how many these are
  std::uint64_t faces;     ///< met
  std::uint32_t whole[kWaiting + kWidth];  ///< nodes of one level or triangles inside, whose sums are to be added
  int whole_count;
  float out_sq, in_sq;       ///< in the unit of the tree: boxes farther away are out, nearer ones in
  double unit;               ///< of the walk: lengths in `waiting` and `lanes` are multiplied by it
  double radius, radius_sq;  ///< in it
  double to_tree;            ///< what makes lengths of the walk those of the tree
  Waiting<Real> waiting;
  Irregular<Real> irregular;
};

/// One query.
template <class Real>
struct BallQuery {
  double centre[3];
  const double* radii;  ///< increasing
  const double* radii_sq;
  int count;
  bool exact_density;
  bool all_careful;        ///< every triangle on the rim goes to `careful`
  Gathering<Real>* balls;  ///< one a radius
  /// Receives a triangle whose share in the ball of the radius needs the forms of triangle_ball.hpp.
  void (*careful)(void* context, std::uint32_t triangle, int radius);
  void* context;
};

/// The kernels of one instruction set. Measures have the same bits in all; sums over balls agree to a few roundings,
/// for some fuse products and sums.
struct Table {
  const char* name;  ///< of the instruction set
  /// Where queries with centres between `lo` and `hi` and radii up to `radius` start. It changes no bit of them.
  void (*approach)(const NodeView& tree, const double* lo, const double* hi, double radius, Start& start);
  /// Everything that a tree has in the balls of a query.
  void (*query_double)(const TreeView<double>& tree, const BallQuery<double>& query, const Visits& visits);
  void (*query_float)(const TreeView<float>& tree, const BallQuery<float>& query, const Visits& visits);
  /// What `count` triangles have in the ball number `radius`, and, once all are given, what still waits.
  void (*add)(const TriangleView& triangles, const BallQuery<double>& query, int radius, const std::uint32_t* chosen,
              std::size_t count);
  void (*finish)(const TriangleView& triangles, const BallQuery<double>& query, int radius);
  /// Measures of the whole triangles [begin, end), times their weights, to `out`, kSums each from the first on.
  void (*measure)(const TriangleView& triangles, std::size_t begin, std::size_t end, double* out);
};

const Table& baseline_table();
#if defined(KAPPA_X86_KERNELS)
/// With fused multiply-add.
const Table& avx2_table();
/// With AVX-512 besides.
const Table& avx512_table();
/// Their measures, without: an area of nothing is to be 0.
void measure_avx2(const TriangleView& triangles, std::size_t begin, std::size_t end, double* out);
void measure_avx512(const TriangleView& triangles, std::size_t begin, std::size_t end, double* out);
#endif

/// The tables that this processor can use, from the slowest on.
struct Tables {
  int count = 0;
  const Table* of[3] = {};

  const Table* const* begin() const { return of; }
  const Table* const* end() const { return of + count; }
};
Tables usable_tables();

/// The fastest of them.
const Table& best_table();

}  // namespace kappa::kernels
