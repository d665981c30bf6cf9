// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace kappa {

/// Kind of a surface at a point (Figure 13 of the SGP 2020 paper). The values are those of the
/// output field `label`.
enum class Label : std::uint8_t {
  Undefined = 0,
  Flat = 1,
  Convex = 2,
  Concave = 3,
  Saddle = 4,
  ConvexCylinder = 5,  ///< ridge
  ConcaveCylinder = 6  ///< valley
};
inline constexpr int kLabelCount = 7;

/// Label of a pair of principal curvatures (1/length) of which any below `threshold` in size
/// counts as 0. `Undefined` if one is NaN.
Label classify(double k_min, double k_max, double threshold);

/// "flat", "convex", "concave", "saddle", "convex cylinder", "concave cylinder", "undefined".
const char* label_name(Label label);

/// 8-bit red, green, blue: red, blue, green, yellow and cyan for the curved kinds, white for flat,
/// grey for undefined.
struct Rgb {
  std::uint8_t r, g, b;
};
Rgb label_colour(Label label);

}  // namespace kappa
