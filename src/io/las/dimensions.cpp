// SPDX-License-Identifier: BSD-3-Clause
#include "dimensions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/pace.hpp"
#include "io/safe_name.hpp"
#include "kappa/scan/scan.hpp"
#include "layout.hpp"

namespace kappa::io {

namespace {

constexpr double kScanAngleStep = 0.006;  // degrees, of formats 6 to 10

using Dimensions = std::vector<LasDimension>;

void add(Dimensions& dimensions, const char* name, Scalar type, std::size_t offset, bool common = true) {
  LasDimension d;
  d.name = name;
  d.type = type;
  d.offset = offset;
  d.common = common;
  dimensions.push_back(std::move(d));
}

void add_bits(Dimensions& dimensions, const char* name, std::size_t offset, unsigned first, unsigned bits,
              bool common = false) {
  add(dimensions, name, Scalar::UInt8, offset, common);
  dimensions.back().first_bit = first;
  dimensions.back().bits = bits;
}

void add_point_of_first_formats(Dimensions& d) {
  add(d, "intensity", Scalar::UInt16, 12);
  add_bits(d, "return_number", 14, 0, 3, true);
  add_bits(d, "number_of_returns", 14, 3, 3, true);
  add_bits(d, "scan_direction", 14, 6, 1);
  add_bits(d, "edge_of_flight_line", 14, 7, 1);
  add_bits(d, "classification", 15, 0, 5, true);
  add_bits(d, "synthetic", 15, 5, 1);
  add_bits(d, "key_point", 15, 6, 1);
  add_bits(d, "withheld", 15, 7, 1);
  add(d, "scan_angle", Scalar::Int8, 16);
  add(d, "user_data", Scalar::UInt8, 17, false);
  add(d, "point_source_id", Scalar::UInt16, 18);
}

void add_point_of_formats_14(Dimensions& d) {
  add(d, "intensity", Scalar::UInt16, 12);
  add_bits(d, "return_number", 14, 0, 4, true);
  add_bits(d, "number_of_returns", 14, 4, 4, true);
  add_bits(d, "synthetic", 15, 0, 1);
  add_bits(d, "key_point", 15, 1, 1);
  add_bits(d, "withheld", 15, 2, 1);
  add_bits(d, "overlap", 15, 3, 1);
  add_bits(d, "scanner_channel", 15, 4, 2);
  add_bits(d, "scan_direction", 15, 6, 1);
  add_bits(d, "edge_of_flight_line", 15, 7, 1);
  add(d, "classification", Scalar::UInt8, 16);
  add(d, "user_data", Scalar::UInt8, 17, false);
  add(d, "scan_angle", Scalar::Int16, 18);
  d.back().scale = kScanAngleStep;
  add(d, "point_source_id", Scalar::UInt16, 20);
}

void add_colour(Dimensions& d, std::size_t offset) {
  add(d, "red", Scalar::UInt16, offset);
  add(d, "green", Scalar::UInt16, offset + 2);
  add(d, "blue", Scalar::UInt16, offset + 4);
}

void add_waveform(Dimensions& d, std::size_t offset) {
  add(d, "wave_descriptor", Scalar::UInt8, offset, false);
  add(d, "wave_offset", Scalar::UInt64, offset + 1, false);
  add(d, "wave_size", Scalar::UInt32, offset + 9, false);
  add(d, "wave_location", Scalar::Float32, offset + 13, false);
  add(d, "wave_dx", Scalar::Float32, offset + 17, false);
  add(d, "wave_dy", Scalar::Float32, offset + 21, false);
  add(d, "wave_dz", Scalar::Float32, offset + 25, false);
}

Dimensions described_dimensions(const std::vector<ExtraBytes>& descriptors, std::size_t offset) {
  Dimensions dimensions;
  for (std::size_t k = 0; k < descriptors.size(); ++k) {
    const ExtraBytes& extra = descriptors[k];
    for (std::size_t i = 0; extra.type && i < extra.values; ++i) {
      LasDimension d;
      d.name = safe_name(extra.name.empty() ? "extra" + std::to_string(k) : extra.name);
      if (extra.values > 1) d.name += "_" + std::to_string(i);
      d.type = *extra.type;
      d.offset = offset + i * size_of(d.type);
      d.scale = extra.scale[i];
      d.shift = extra.offset[i];
      d.no_data = extra.no_data[i];
      d.descriptor = k;
      dimensions.push_back(std::move(d));
    }
    offset += extra.bytes();
  }
  return dimensions;
}

/// Names that no field may have; those of a normal are its own where all three are there.
std::set<std::string> reserved_names(const std::set<std::string>& present) {
  std::set<std::string> names = {"x", "y", "z", "normal_x", "normal_y", "normal_z"};
  if (present.count("nx") + present.count("ny") + present.count("nz") < 3) names.insert({"nx", "ny", "nz"});
  return names;
}

void make_unique(const LasFile& las, Dimensions& standard, Dimensions& extra, const Execution& run) {
  std::set<std::string> present;
  for (const LasDimension& d : extra) present.insert(d.name);
  const auto gives_way = [&](const LasDimension& d) { return present.count(d.name) != 0 && !is_used(las, d, run); };
  standard.erase(std::remove_if(standard.begin(), standard.end(), gives_way), standard.end());
  std::set<std::string> names = reserved_names(present);
  for (const LasDimension& d : standard) names.insert(d.name);
  for (LasDimension& d : extra) {
    while (!names.insert(d.name).second) d.name += "_extra";
  }
}

template <class T>
bool in_range(double value) {
  // The largest 64-bit integers are no doubles: their successor, a power of two, is.
  const double end = std::ldexp(1.0, std::numeric_limits<T>::digits);
  return value >= static_cast<double>(std::numeric_limits<T>::min()) && value < end;
}

bool is_storable(double value, Scalar type) {
  if (type == Scalar::Float64) return true;
  if (type == Scalar::Float32) return fits(value, Field::Type::Float32);
  if (value != std::floor(value)) return false;
  if (type == Scalar::Int8) return in_range<std::int8_t>(value);
  if (type == Scalar::Int16) return in_range<std::int16_t>(value);
  if (type == Scalar::Int64) return in_range<std::int64_t>(value);
  if (type == Scalar::UInt64) return in_range<std::uint64_t>(value);
  return fits(value, field_type(type));
}

/// What is stored for `value`; on integers the nearest, if a scale stands between them.
double stored_for(const LasDimension& d, double value) {
  if (std::isnan(value) && d.no_data) return *d.no_data;
  if (d.scale == 1 && d.shift == 0) return value;
  const double stored = (value - d.shift) / d.scale;
  return is_floating(d.type) ? stored : std::round(stored);
}

}  // namespace

Field::Type LasDimension::field_type() const {
  if (scale != 1 || shift != 0 || no_data) return Field::Type::Float64;
  return io::field_type(type);
}

Dimensions standard_dimensions(int format) {
  Dimensions d;
  if (format >= las::kFirstFormat14) {
    add_point_of_formats_14(d);
    add(d, "gps_time", Scalar::Float64, 22);
    if (format == 7 || format == 8 || format == 10) add_colour(d, 30);
    if (format == 8 || format == 10) add(d, "nir", Scalar::UInt16, 36);
  } else {
    add_point_of_first_formats(d);
    if (format == 1 || format >= 3) add(d, "gps_time", Scalar::Float64, 20);
    if (format == 2) add_colour(d, 20);
    if (format == 3 || format == 5) add_colour(d, 28);
  }
  constexpr std::size_t kWaveformSize = 29;
  if (las::has_waveform(format)) add_waveform(d, las::point_size(format) - kWaveformSize);
  return d;
}

Dimensions dimensions_of(const std::string& path, const LasFile& las, const Execution& run) {
  Dimensions standard = standard_dimensions(las.format);
  Dimensions extra = described_dimensions(parse_extra_bytes(path, las), las::point_size(las.format));
  if (!extra.empty()) make_unique(las, standard, extra, run);
  standard.insert(standard.end(), std::make_move_iterator(extra.begin()), std::make_move_iterator(extra.end()));
  return standard;
}

LasDimension extra_dimension(const std::string& name, Scalar type, std::size_t offset) {
  LasDimension d;
  d.name = name;
  d.type = type;
  d.offset = offset;
  return d;
}

double load(const char* record, const LasDimension& d) {
  const char* bytes = record + d.offset;
  if (d.bits != 0) return (static_cast<unsigned char>(*bytes) >> d.first_bit) & ((1u << d.bits) - 1);
  const double stored = load(bytes, d.type, ByteOrder::Little);
  if (d.no_data && stored == *d.no_data) return kNaN;
  return d.scale == 1 && d.shift == 0 ? stored : stored * d.scale + d.shift;
}

bool is_used(const LasFile& las, const LasDimension& d, const Execution& run) {
  const char* const points = las.points.data();
  return any_row(las.point_count(), run, [&](std::size_t i) { return load(points + i * las.record_length, d) != 0; });
}

bool store(char* record, const LasDimension& d, double value) {
  char* bytes = record + d.offset;
  if (d.bits != 0) {
    const unsigned mask = ((1u << d.bits) - 1) << d.first_bit;
    if (!(value >= 0 && value <= mask >> d.first_bit && value == std::floor(value))) return false;
    const unsigned kept = static_cast<unsigned char>(*bytes) & ~mask;
    *bytes = static_cast<char>(kept | static_cast<unsigned>(value) << d.first_bit);
    return true;
  }
  const double stored = stored_for(d, value);
  if (!is_storable(stored, d.type)) return false;
  std::string encoded;
  append(encoded, stored, d.type);
  encoded.copy(bytes, encoded.size());
  return true;
}

}  // namespace kappa::io
