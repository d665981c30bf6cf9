// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/labels.hpp"
#include "kappa/view/colour_map.hpp"
#include "panel.hpp"

namespace kappa::view_detail {

/// Where a legend is drawn.
struct LegendPlace {
  int width, height;  ///< of the strip, in pixels
  double scale;       ///< text is 22 `scale` pixels high
  Rgb text{30, 32, 36};
};

/// What a colour bar tells about a field beside its colours. Points without finite coordinates do not count.
struct FieldFacts {
  double min = 0, max = 0;   ///< of the finite values
  std::size_t values = 0;    ///< number of finite values
  std::size_t no_value = 0;  ///< number of points without a finite value
};
FieldFacts field_facts(const std::vector<double>& values, const std::vector<Vec3>& points);

/// Draws a colour bar with title, unit and ticks. Where values lie beyond an end, the bar has a point there, and the
/// extreme value is told.
void draw_colour_bar(Panel& panel, const LegendPlace& place, const ScalarStyle& style, const ColourRange& range,
                     const FieldFacts& facts);

/// Draws the labels that occur, with colours, names and shares.
void draw_label_legend(Panel& panel, const LegendPlace& place, const std::vector<Label>& labels);

/// The share of a part as text: "12.3 %", "< 0.1 %", "> 99.9 %".
std::string percent(std::size_t part, std::size_t whole);

}  // namespace kappa::view_detail
