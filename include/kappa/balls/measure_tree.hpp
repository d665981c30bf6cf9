// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "kappa/balls/ball_sum.hpp"

namespace kappa {

namespace kernels {
struct Table;
}

/// What the corners of the triangles on the rim of a ball are computed in; sums are always in double.
enum class Precision {
  Double,  ///< sums equal to those of BruteForceBallSum to 1e-11 of the sum of absolute values in the ball
  Fast     ///< floats relative to a point nearby: measures within 1e-6 relative, mean curvature 5e-6 of its largest,
           ///< for balls of a few triangles and more; single triangles up to 64 times as large as the ball, or as far
           ///< from others, within 2e-5 radius^2; larger or sparser ones are measured as in Double
};

/// Ball sums over a hierarchy: a node whose box lies in the ball adds the sum of its triangles and is never opened, so
/// that a query costs about the rim of the ball instead of its area.
///
/// An implicit tree of eight children a node over triangles ordered by median splits; eight triangles a leaf. All
/// radii of a query are served by one walk. Queries are run in spatial order, whatever order they come in. The order
/// of the additions of a query depends on its centre and the radii alone: any number of threads gives the same bits.
/// Processors with fused multiply-add and those without agree to a few roundings. Triangles of any size, also zero, and
/// any topology.
/// Cost: a query, about the square root of the number of triangles in the ball; building, n log n. Memory beside the
/// triangles: `bytes()`, about 36 a triangle in double, and 90 in fast, where in return the triangles give up their
/// measures, 72 a triangle.
class MeasureTree final : public BallSum {
 public:
  /// On the threads of `run`, which change no bit of it.
  /// @throws Cancelled
  explicit MeasureTree(MeasuredTriangles triangles, Precision precision = Precision::Double, const Execution& run = {});
  /// With the kernels of one instruction set instead of the best that the processor has: for tests.
  MeasureTree(MeasuredTriangles triangles, Precision precision, const kernels::Table& table, const Execution& run = {});
  ~MeasureTree() override;
  /// In the order of the tree, not of the faces; in fast without stored measures (see measures_of()).
  const MeasuredTriangles& triangles() const override;

  /// Memory that the tree holds beside triangles().
  std::size_t bytes() const;

 private:
  void do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
              const Execution& run, const Sink& sink) const override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kappa
