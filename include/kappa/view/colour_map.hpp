// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/core/labels.hpp"

namespace kappa {

/// How values become colours.
enum class ColourMap {
  Diverging,  ///< blue below 0, light grey at 0, red above: signed fields such as curvatures
  Sequential  ///< dark violet over green to yellow: fields without a sign
};

/// Values that get the colours at the ends of a map; those beyond are clipped to them.
struct ColourRange {
  double low = 0, high = 1;
};

/// What a field is called and how it is coloured.
struct ScalarStyle {
  std::string name;  ///< title of the colour bar, for instance "mean curvature"
  std::string unit;  ///< shown after the name, for instance "1/m"; may be empty
  ColourMap map = ColourMap::Diverging;
  /// Empty for an automatic range, see `colour_range`.
  std::optional<ColourRange> range;
  /// Percentile in (50, 100] the automatic range is clipped at, so that a few outliers do not bleach the picture.
  double percentile = 98;
};

/// Colour of the faces and points that have no value (NaN).
inline constexpr Rgb kNoValueColour{120, 120, 126};

/// Colour at `t` in [0, 1], clamped. Both maps are even steps to the eye (made in CIELAB); the diverging one has
/// its neutral colour at 0.5.
Rgb map_colour(ColourMap map, double t);

/// Range of the colours of `values`: `style.range` if given, else from the finite values: [-m, m] with m the
/// percentile of |values| for a diverging map, [100 - p, p] percentiles for a sequential one. A range of zero width
/// is widened about its value; without a finite value it is [-1, 1] or [0, 1].
/// @throws Error InvalidArgument if a given range is not finite or not low < high, or the percentile out of range.
ColourRange colour_range(const std::vector<double>& values, const ScalarStyle& style);

/// Between 4 and 11 round values (1, 2 or 5 times a power of ten apart) in the range, 0 among them if it is inside.
std::vector<double> round_ticks(const ColourRange& range);

/// Shortest texts that tell the ticks apart, all with the same number of decimals, or of significant digits with an
/// exponent where the values are above 1e5 or below 1e-3.
std::vector<std::string> tick_texts(const std::vector<double>& ticks);

}  // namespace kappa
