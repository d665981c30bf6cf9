// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/view_data.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

constexpr std::array kShownFirst = {"mean_curvature", "gaussian_curvature", "k_min", "k_max", "coverage"};
constexpr std::array kTellASet = {"mean_curvature", "gaussian_curvature", "k_min", "k_max", "label"};
constexpr std::array kShownOtherwise = {"label",     "status",    "dir_min_x", "dir_min_y",
                                        "dir_min_z", "dir_max_x", "dir_max_y", "dir_max_z"};

template <std::size_t kSize>
bool holds(const std::array<const char*, kSize>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The number in a suffix such as "_r0.5".
std::optional<double> radius_of(const std::string& suffix) {
  if (!starts_with(suffix, "_r")) return {};
  double radius = 0;
  const char* const end = suffix.data() + suffix.size();
  const auto read = std::from_chars(suffix.data() + 2, end, radius);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(radius) || radius < 0) return {};
  return radius;
}

/// The set a field tells of by its name, if it does.
std::optional<StoredSet> set_of(const std::string& name) {
  for (const std::string start : kTellASet) {
    if (name == start) return StoredSet{"", kNaN};
    if (!starts_with(name, start)) continue;
    const std::string suffix = name.substr(start.size());
    if (const auto radius = radius_of(suffix)) return StoredSet{suffix, *radius};
  }
  return {};
}

bool has_suffix(const std::vector<StoredSet>& sets, const std::string& suffix) {
  return std::any_of(sets.begin(), sets.end(), [&](const StoredSet& set) { return set.suffix == suffix; });
}

/// Whether a field belongs to one of `sets` that has a suffix.
bool belongs_to_one(const std::string& name, const std::vector<StoredSet>& sets) {
  return std::any_of(sets.begin(), sets.end(),
                     [&](const StoredSet& set) { return !set.suffix.empty() && ends_with(name, set.suffix); });
}

NamedValues named_values(const Field& field, const std::string& name) {
  NamedValues named{field_style(field), field.values};
  named.style.name = name;
  std::replace(named.style.name.begin(), named.style.name.end(), '_', ' ');
  return named;
}

std::vector<PointStatus> field_status(const Field& field) {
  std::vector<PointStatus> status;
  status.reserve(field.values.size());
  for (const double value : field.values) {
    const bool known = value >= 0 && value <= static_cast<double>(PointStatus::Border) && value == std::floor(value);
    status.push_back(known ? static_cast<PointStatus>(static_cast<int>(value)) : PointStatus::Invalid);
  }
  return status;
}

void add_other_fields(ViewData& data, const Scan& scan, const StoredSet& set, const std::vector<StoredSet>& sets) {
  for (const Field& field : scan.fields) {
    std::string name = field.name;
    if (belongs_to_one(name, sets)) {
      if (set.suffix.empty() || !ends_with(name, set.suffix)) continue;
      name.resize(name.size() - set.suffix.size());
    }
    if (!holds(kShownFirst, name) && !holds(kShownOtherwise, name)) data.fields.push_back(named_values(field, name));
  }
}

}  // namespace

ScalarStyle field_style(const Field& field, const std::string& length_unit) {
  ScalarStyle style;
  style.name = field.name;
  std::replace(style.name.begin(), style.name.end(), '_', ' ');
  const bool gaussian = starts_with(field.name, "gaussian");
  const bool curvature = gaussian || starts_with(field.name, "mean_curvature") || starts_with(field.name, "k_m");
  if (curvature) style.unit = "1/" + length_unit + (gaussian ? "\u00b2" : "");
  const bool has_sign = std::any_of(field.values.begin(), field.values.end(), [](double v) { return v < 0; });
  style.map = curvature || has_sign ? ColourMap::Diverging : ColourMap::Sequential;
  return style;
}

std::vector<Label> field_labels(const Field& field) {
  std::vector<Label> labels;
  labels.reserve(field.values.size());
  for (const double value : field.values) {
    const bool known = value >= 0 && value < kLabelCount && value == std::floor(value);
    labels.push_back(known ? static_cast<Label>(static_cast<int>(value)) : Label::Undefined);
  }
  return labels;
}

std::vector<StoredSet> stored_sets(const Scan& scan) {
  std::vector<StoredSet> sets;
  for (const Field& field : scan.fields) {
    const auto set = set_of(field.name);
    if (set && !has_suffix(sets, set->suffix)) sets.push_back(*set);
  }
  return sets;
}

ViewData stored_data(const Scan& scan, const StoredSet& set) {
  const std::vector<StoredSet> sets = stored_sets(scan);
  if (!has_suffix(sets, set.suffix))
    throw Error(ErrorCode::InvalidArgument, "the scan holds no curvatures with the suffix '" + set.suffix + "'");
  ViewData data;
  data.radius = set.radius;
  for (const char* const name : kShownFirst) {
    if (const Field* field = scan.field(name + set.suffix)) data.fields.push_back(named_values(*field, name));
  }
  add_other_fields(data, scan, set, sets);
  const Field* const label = scan.field("label" + set.suffix);
  if (label != nullptr) data.labels = field_labels(*label);
  if (label != nullptr && data.fields.empty()) data.fields.push_back(named_values(*label, "label"));
  if (const Field* const status = scan.field("status" + set.suffix)) data.status = field_status(*status);
  data.directions = direction_fields(scan, set.suffix);
  return data;
}

}  // namespace kappa
