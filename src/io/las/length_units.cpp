// SPDX-License-Identifier: BSD-3-Clause
#include "length_units.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "bytes.hpp"
#include "coordinate_system.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

constexpr const char* kUser = "LASF_Projection";

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_usable(double metres) {
  return std::isfinite(metres) && metres > 0;
}

/// Walks through the nodes of a WKT text, KEYWORD[item,...], brackets of either kind.
class WktUnits {
 public:
  explicit WktUnits(std::string_view text) : text_(text) {}

  LengthUnits read() {
    std::size_t word = 0;  // begin of the last keyword
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') {
        skip_quoted();
      } else if (c == '[' || c == '(') {
        open(trimmed(text_.substr(word, at_ - word)));
      } else if (c == ']' || c == ')') {
        if (!nodes_.empty()) nodes_.pop_back();
      }
      if (c == ',' || c == '[' || c == '(') word = at_ + 1;
    }
    return units_;
  }

 private:
  void skip_quoted() { at_ = std::min(text_.find('"', at_ + 1), text_.size()); }

  void open(std::string_view keyword) {
    if (is_one_of(keyword, {"UNIT", "LENGTHUNIT"})) take_unit();
    nodes_.push_back(keyword);
  }

  /// Whose unit it is: that of the node around, or in WKT 2 around its axis.
  void take_unit() {
    const bool of_axis = !nodes_.empty() && nodes_.back() == "AXIS";
    const std::size_t depth = nodes_.size() - (of_axis ? 1 : 0);
    if (depth == 0) return;
    const std::string_view system = nodes_[depth - 1];
    const double metres = factor();
    if (!is_usable(metres)) return;
    if (is_one_of(system, {"PROJCS", "PROJCRS", "PROJECTEDCRS"})) units_.horizontal = metres;
    if (is_one_of(system, {"VERT_CS", "VERTCRS", "VERTICALCRS"})) units_.vertical = metres;
  }

  /// The number in UNIT["name",number...], which begins at the bracket here.
  double factor() const {
    const std::size_t open_quote = text_.find('"', at_), close_quote = text_.find('"', open_quote + 1);
    if (open_quote == text_.npos || close_quote == text_.npos) return kNaN;
    const std::size_t comma = text_.find(',', close_quote);
    if (comma == text_.npos) return kNaN;
    const std::size_t end = text_.find_first_of(",])", comma + 1);
    double value = kNaN;
    parse_number(trimmed(text_.substr(comma + 1, end == text_.npos ? end : end - comma - 1)), value);
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string_view> nodes_;
  LengthUnits units_;
};

const LasRecord* find_record(const LasFile& las, std::uint16_t id) {
  for (const std::vector<LasRecord>* records : {&las.records, &las.extended}) {
    for (const LasRecord& record : *records) {
      if (record.is(kUser, id)) return &record;
    }
  }
  return nullptr;
}

/// Metres in the unit of that EPSG code.
std::optional<double> unit_of_code(unsigned code) {
  constexpr unsigned kMetre = 9001, kFoot = 9002, kSurveyFoot = 9003;
  if (code == kMetre) return 1.0;
  if (code == kFoot) return 0.3048;
  if (code == kSurveyFoot) return 12 / 39.37;
  return std::nullopt;
}

LengthUnits units_by_keys(const LasFile& las, const std::string& keys) {
  constexpr std::uint16_t kLinearUnits = 3076, kLinearUnitSize = 3077, kVerticalUnits = 4099;
  const LasRecord* doubles = find_record(las, kGeoDoubles);
  LengthUnits units;
  for (std::size_t at = 8; at + 8 <= keys.size(); at += 8) {
    const auto key = get<std::uint16_t>(keys, at), place = get<std::uint16_t>(keys, at + 2),
               value = get<std::uint16_t>(keys, at + 6);
    if (key == kLinearUnits && place == 0 && !units.horizontal) units.horizontal = unit_of_code(value);
    if (key == kVerticalUnits && place == 0) units.vertical = unit_of_code(value);
    const std::size_t stored = std::size_t{8} * value;
    if (key != kLinearUnitSize || place != kGeoDoubles || !doubles || stored + 8 > doubles->data.size()) continue;
    const double metres = get_double(doubles->data, stored);
    if (is_usable(metres)) units.horizontal = metres;
  }
  return units;
}

}  // namespace

LengthUnits length_units(const LasFile& las) {
  if (const LasRecord* wkt = find_record(las, kWkt)) return WktUnits(wkt->data).read();
  if (const LasRecord* keys = find_record(las, kGeoKeys)) return units_by_keys(las, keys->data);
  return {};
}

}  // namespace kappa::io
