// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/names.hpp"

namespace kappa {

/// How a face of four corners is measured.
enum class QuadMeasures {
  Split,    ///< in four triangles at its barycentre, as any other polygon
  Bilinear  ///< as a bilinear patch (Appendix B of the paper)
};
const std::vector<Named<QuadMeasures>>& names_of(QuadMeasures);

/// What the corners of the triangles on the rim of a ball are computed in; sums are always in double.
enum class Precision {
  Double,  ///< sums equal to those of BruteForceBallSum to 1e-11 of the sum of absolute values in the ball
  /// Floats relative to a point nearby. Measures are within 1e-6 relative, the mean curvature within 5e-6 of its
  /// largest, for balls of a few triangles and more. Single triangles up to 64 times as large as the ball, or as far
  /// from others, are within 2e-5 radius^2; larger or sparser ones are measured as in Double.
  Fast
};
const std::vector<Named<Precision>>& names_of(Precision);

/// How the balls are summed; all engines give the same sums (see BallSum).
enum class Engine {
  Tree,  ///< MeasureTree, whose cost grows with the rim of the ball
  Flann  ///< FlannBallSum, a plain search, whose cost grows with the area of the ball
};
const std::vector<Named<Engine>>& names_of(Engine);

/// Most times a face is split in four.
inline constexpr int kMostRefinements = 6;

/// How the ball sum of a surface is built.
struct MeasureOptions {
  QuadMeasures quads = QuadMeasures::Split;
  int refine = 0;  ///< times every face is split in four on a curved patch before it is measured, 0 to kMostRefinements
  Precision precision = Precision::Double;  ///< of the tree
  Engine engine = Engine::Tree;
};

/// @throws OptionError for `refine` that is out of range, or above 0 beside bilinear quads.
void validate(const MeasureOptions& options);

}  // namespace kappa
