// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/labels.hpp"

#include <array>
#include <cmath>

namespace kappa {
namespace {

/// In the order of the labels.
constexpr std::array<Rgb, kLabelCount> kColours = {{
    {128, 128, 128},
    {255, 255, 255},
    {214, 39, 40},
    {31, 90, 200},
    {44, 160, 44},
    {250, 210, 30},
    {30, 200, 220},
}};

int sign_beyond(double k, double threshold) {
  if (std::abs(k) < threshold || k == 0) return 0;
  return k > 0 ? 1 : -1;
}

}  // namespace

Label classify(double k_min, double k_max, double threshold) {
  if (std::isnan(k_min) || std::isnan(k_max)) return Label::Undefined;
  // Row: sign of k_min, column: sign of k_max; k_min <= k_max leaves three entries out.
  static constexpr Label kTable[3][3] = {
      {Label::Concave, Label::Valley, Label::Saddle},
      {Label::Valley, Label::Flat, Label::Ridge},
      {Label::Saddle, Label::Ridge, Label::Convex},
  };
  return kTable[sign_beyond(k_min, threshold) + 1][sign_beyond(k_max, threshold) + 1];
}

const std::vector<Named<Label>>& names_of(Label) {
  static const std::vector<Named<Label>> names = {
      {Label::Undefined, "undefined", "the point has no curvature"},
      {Label::Flat, "flat", "both principal curvatures count as 0"},
      {Label::Convex, "convex", "both principal curvatures are positive"},
      {Label::Concave, "concave", "both principal curvatures are negative"},
      {Label::Saddle, "saddle", "the principal curvatures have different signs"},
      {Label::Ridge, "ridge", "one principal curvature is positive, the other counts as 0"},
      {Label::Valley, "valley", "one principal curvature is negative, the other counts as 0"},
  };
  return names;
}

Rgb label_colour(Label label) {
  return kColours.at(static_cast<std::size_t>(label));
}

}  // namespace kappa
