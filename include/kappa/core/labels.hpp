// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kappa/core/names.hpp"

namespace kappa {

/// The kind of a surface at a point, by the signs of its principal curvatures (Figure 13 of Lachaud, Romon, Thibert,
/// Coeurjolly, "Interpolated corrected curvature measures for polygonal surfaces", CGF 39(5), 2020). The numbers are
/// the values of the field `label` in files.
enum class Label : std::uint8_t {
  Undefined = 0,  ///< the point has no curvature
  Flat = 1,       ///< both count as 0
  Convex = 2,     ///< both are positive
  Concave = 3,    ///< both are negative
  Saddle = 4,     ///< the signs differ
  Ridge = 5,      ///< k_min counts as 0 and k_max is positive; a "convex cylinder" in the paper
  Valley = 6      ///< k_min is negative and k_max counts as 0; a "concave cylinder" in the paper
};

/// The number of labels. The values of `Label` are 0 to kLabelCount - 1.
inline constexpr int kLabelCount = 7;

/// The words for the labels: undefined, flat, convex, concave, saddle, ridge, valley.
const std::vector<Named<Label>>& names_of(Label);

/// The label of the principal curvatures k_min <= k_max. A curvature with |k| < `threshold` counts as 0, and so does
/// an exact 0. Curvatures and threshold have the unit 1/length. The label is `Undefined` if a curvature is NaN.
Label classify(double k_min, double k_max, double threshold);

/// A colour as 8-bit red, green and blue.
struct Rgb {
  std::uint8_t r, g, b;
};

/// The colour in which pictures show a label: flat is white, convex red, concave blue, saddle green, ridge yellow,
/// valley cyan, and undefined grey.
/// @throws std::out_of_range for a value that is no label.
Rgb label_colour(Label label);

}  // namespace kappa
