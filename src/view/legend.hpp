// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/labels.hpp"
#include "kappa/view/colour_map.hpp"
#include "panel.hpp"

namespace kappa::view_detail {

/// Where a legend is drawn, in pixels, and how large its text is (1 = text of 22 pixels).
struct LegendPlace {
  int width, height;
  double scale;
  Rgb text{30, 32, 36};
};

/// What a colour bar tells about a field beside its colours.
struct FieldFacts {
  double min = 0, max = 0;   ///< of the finite values
  std::size_t values = 0;    ///< finite
  std::size_t no_value = 0;  ///< points drawn without a value
};
/// Facts of the values at the points with finite coordinates.
FieldFacts field_facts(const std::vector<double>& values, const std::vector<Vec3>& points);

/// A colour bar with title, unit and ticks. An end is pointed where values lie beyond it, and the extreme is told.
void draw_colour_bar(Panel& panel, const LegendPlace& place, const ScalarStyle& style, const ColourRange& range,
                     const FieldFacts& facts);

/// The labels that occur, with colours, names and shares.
void draw_label_legend(Panel& panel, const LegendPlace& place, const std::vector<Label>& labels);

/// "12.3 %", "< 0.1 %".
std::string percent(std::size_t part, std::size_t whole);

}  // namespace kappa::view_detail
