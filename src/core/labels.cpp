// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/labels.hpp"

#include <array>
#include <cmath>

namespace kappa {
namespace {

struct Entry {
  const char* name;
  Rgb colour;
};

constexpr std::array<Entry, kLabelCount> kEntries = {{
    {"undefined", {128, 128, 128}},
    {"flat", {255, 255, 255}},
    {"convex", {214, 39, 40}},
    {"concave", {31, 90, 200}},
    {"saddle", {44, 160, 44}},
    {"convex cylinder", {250, 210, 30}},
    {"concave cylinder", {30, 200, 220}},
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
      {Label::Concave, Label::ConcaveCylinder, Label::Saddle},
      {Label::ConcaveCylinder, Label::Flat, Label::ConvexCylinder},
      {Label::Saddle, Label::ConvexCylinder, Label::Convex},
  };
  return kTable[sign_beyond(k_min, threshold) + 1][sign_beyond(k_max, threshold) + 1];
}

const char* label_name(Label label) {
  return kEntries.at(static_cast<std::size_t>(label)).name;
}

Rgb label_colour(Label label) {
  return kEntries.at(static_cast<std::size_t>(label)).colour;
}

}  // namespace kappa
