// SPDX-License-Identifier: BSD-3-Clause
#include "coordinate_system.hpp"

#include <initializer_list>
#include <string>

#include "bytes.hpp"

namespace kappa::io {

namespace {

// GeoTIFF: key of the kind of coordinates, and its values.
constexpr std::uint16_t kModelType = 1024, kProjected = 1, kGeographic = 2, kGeocentric = 3;
// GeoTIFF: keys of a geographic and of a projected system, which older files have without the first.
constexpr std::uint16_t kGeographicSystem = 2048, kProjectedSystem = 3072;

bool holds_any(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) {
    if (text.find(word) != std::string::npos) return true;
  }
  return false;
}

std::optional<bool> geographic_by_wkt(const std::string& text) {
  if (holds_any(text, {"PROJCS", "PROJCRS", "PROJECTEDCRS", "LOCAL_CS", "ENGCRS", "GEOCCS"})) return false;
  if (holds_any(text, {"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS"})) return true;
  return std::nullopt;
}

std::optional<bool> geographic_by_keys(const std::string& keys) {
  std::optional<bool> by_system;
  for (std::size_t at = 8; at + 8 <= keys.size(); at += 8) {
    const auto key = get<std::uint16_t>(keys, at), value = get<std::uint16_t>(keys, at + 6);
    if (key == kModelType && (value == kProjected || value == kGeocentric)) return false;
    if (key == kModelType && value == kGeographic) return true;
    if (key == kProjectedSystem) by_system = false;
    if (key == kGeographicSystem && !by_system) by_system = true;
  }
  return by_system;
}

std::optional<bool> geographic_by_record(const LasFile& las, std::uint16_t id) {
  for (const std::vector<LasRecord>* records : {&las.records, &las.extended}) {
    for (const LasRecord& record : *records) {
      if (!record.is("LASF_Projection", id)) continue;
      const auto verdict = id == kWkt ? geographic_by_wkt(record.data) : geographic_by_keys(record.data);
      if (verdict) return verdict;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<bool> states_degrees(const LasFile& las) {
  for (const std::uint16_t id : {kWkt, kGeoKeys}) {
    if (const auto verdict = geographic_by_record(las, id)) return verdict;
  }
  return std::nullopt;
}

}  // namespace kappa::io
