// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "kappa/balls/ball_sum.hpp"

namespace kappa {

namespace kernels {
struct Table;
}

/// Ball sums over a hierarchy: a node whose box lies in the ball adds the sum of its triangles and is never opened, so
/// that a query costs about the rim of the ball instead of its area.
///
/// The tree is implicit: eight children a node, over triangles ordered by median splits, eight triangles a leaf.
/// Several radii of a query are served by one walk. Queries run in spatial order, whatever order they come in. The
/// order of the additions of a query depends on its centre and its radii alone: any number of threads gives the same
/// bits, as do radii common to all centres and the same radii given for each. Processors with fused multiply-add and
/// those without agree to a few roundings. Triangles may have any size, also zero, and any topology. Cost: of a query,
/// about the square root of the number of triangles in the ball; of building, n log n. `bytes()` is the memory beside
/// the triangles: with measures at most 130 bytes a triangle in double; in fast, which keeps no measures, at most 110.
class MeasureTree final : public BallSum {
 public:
  /// On the threads of `run`, which change no bit of it.
  /// @throws Cancelled
  explicit MeasureTree(Triangles triangles, Precision precision = Precision::Double, const Execution& run = {});
  /// With the kernels of one instruction set instead of the best that the processor has: for tests.
  MeasureTree(Triangles triangles, Precision precision, const kernels::Table& table, const Execution& run = {});
  ~MeasureTree() override;
  /// In the order of the tree, not of the faces.
  const Triangles& triangles() const override;
  MeasureSum measures_of(std::size_t triangle) const override;

  /// Memory that the tree holds beside triangles().
  std::size_t bytes() const;

 private:
  void do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
              const Sink& sink) const override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kappa
