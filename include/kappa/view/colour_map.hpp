// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/core/labels.hpp"

namespace kappa {

/// How values become colours.
enum class ColourMap {
  Diverging,  ///< for fields with a sign, such as curvatures: blue at the low end, light grey in the middle, red at
              ///< the high end
  Sequential  ///< for fields without a sign: dark violet at the low end, then green, yellow at the high end
};

/// The values that get the colours at the two ends of a map. A value beyond an end gets the colour of that end.
struct ColourRange {
  double low = 0, high = 1;
};

/// What a field is called and how it is coloured.
struct ScalarStyle {
  std::string name;  ///< title of the colour bar, for instance "mean curvature"
  std::string unit;  ///< shown below the name, for instance "1/m"; may be empty
  ColourMap map = ColourMap::Diverging;
  std::optional<ColourRange> range;  ///< empty for an automatic one, see `colour_range`
  /// In (50, 100]: the automatic range ends at this percentile of the values, so that a few outliers do not bleach the
  /// picture.
  double percentile = 98;
};

/// Colour of faces and points without a value (NaN).
inline constexpr Rgb kNoValueColour{120, 120, 126};

/// Colour of a map at `t`: 0 is its low end, 1 its high end, and `t` outside [0, 1] is clamped. Equal steps of `t` look
/// equal to the eye (the maps are made in CIELAB). The diverging map has its light grey at 0.5.
Rgb map_colour(ColourMap map, double t);

/// Range of the colours for `values`: `style.range` if it is given, otherwise an automatic range from the finite
/// values.
///
/// Let p be `style.percentile`. (a) Diverging map: [-m, m], where m is the p-th percentile of |value|. If m is 0, it is
/// the largest |value|; if that is 0 too or there is no finite value, m is 1. (b) Sequential map: from the percentile
/// 100 - p to the percentile p. If both are equal, from the least to the greatest value. If all values are equal to v,
/// v - |v|/2 to v + |v|/2, or [-0.5, 0.5] for v = 0. Without a finite value, [0, 1].
/// @throws Error InvalidArgument if a given range is not finite or not low < high, or the percentile not in (50, 100].
ColourRange colour_range(const std::vector<double>& values, const ScalarStyle& style);

/// Between 4 and 11 values in a range, all multiples of one step, which is 1, 2 or 5 times a power of ten. 0 is among
/// them if it is in the range.
std::vector<double> round_ticks(const ColourRange& range);

/// The shortest texts that tell evenly spaced ticks apart. (a) If the largest |tick| is in [1e-3, 1e5), all texts have
/// the same number of decimals. (b) Otherwise they have an exponent ("2.0e-5") and decimals down to the step of the
/// ticks.
std::vector<std::string> tick_texts(const std::vector<double>& ticks);

}  // namespace kappa
