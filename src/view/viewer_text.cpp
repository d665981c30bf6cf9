// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::view_detail {
namespace {

const char* status_name(PointStatus status) {
  switch (status) {
    case PointStatus::Valid:
      return "valid";
    case PointStatus::Empty:
      return "empty ball";
    case PointStatus::Degenerate:
      return "degenerate: the corrected area vanishes";
    case PointStatus::Invalid:
      return "invalid point or normal";
    case PointStatus::Border:
      return "border: too little of the ball is covered";
  }
  return "unknown";
}

/// Decimals that tell positions a millionth of the scan's extent apart.
int coordinate_decimals(const Scan& scan) {
  const double diagonal = bounds(scan.points).diagonal();
  if (!(diagonal > 0)) return 6;
  return std::clamp(static_cast<int>(std::ceil(5 - std::log10(diagonal))), 0, 15);
}

/// "1 234 567".
std::string count_text(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, " ");
  return text;
}

std::string radius_text(const ViewerState& state) {
  if (std::isnan(state.radius)) return "values of the file";
  return "radius " + number_text(state.radius) + (state.stored ? " of the file" : "");
}

}  // namespace

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string status_text(const Scan& scan, const std::string& file, const ViewerState& state, const std::string& unit,
                        double progress) {
  const std::string name = std::filesystem::path(file).filename().string();
  std::string text = name.empty() ? "" : name + "  |  ";
  text += count_text(scan.points.size()) + " points";
  if (scan.is_mesh()) text += ", " + count_text(scan.faces.size()) + " faces";
  if (!state.field.empty()) {
    text += "  |  " + radius_text(state) + "  |  ";
    if (state.labels) {
      text += "labels";
    } else {
      text += state.field + "  " + number_text(state.range.low) + " ... " + number_text(state.range.high);
      if (!unit.empty()) text += " " + unit;
    }
  }
  if (state.computing) {
    text += "  |  computing ...";
    if (progress > 0) text += " " + std::to_string(static_cast<int>(100 * progress)) + " %";
  }
  return text;
}

std::string pick_text(const Scan& scan, const ViewData& data, Index point) {
  const Vec3 x = scan.points[point] + scan.origin;
  char coordinates[256];
  const int decimals = coordinate_decimals(scan);
  std::snprintf(coordinates, sizeof coordinates, "x  %.*f\ny  %.*f\nz  %.*f", decimals, x.x(), decimals, x.y(),
                decimals, x.z());
  std::string text = "point " + std::to_string(point) + "\n" + coordinates;
  if (!data.status.empty()) text += std::string("\nstatus: ") + status_name(data.status[point]);
  if (!data.labels.empty()) text += std::string("\nlabel: ") + name(data.labels[point]);
  for (const NamedValues& field : data.fields) {
    const double value = field.values[point];
    text += "\n" + field.style.name + "  ";
    text += std::isfinite(value) ? number_text(value) + (field.style.unit.empty() ? "" : " " + field.style.unit)
                                 : "no value";
  }
  return text;
}

}  // namespace kappa::view_detail
