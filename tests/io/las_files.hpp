// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// LAS files put together byte by byte from the tables of the standard, by code that shares nothing with the library.
namespace kappa::test {

/// Appends a number in the order of this machine (little-endian on all that run the tests).
template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Overwrites the number at `at`.
template <class T>
void patch(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

inline constexpr std::array<std::size_t, 11> kLasPointSize = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

inline std::string padded(std::string text, std::size_t size) {
  text.resize(size);
  return text;
}

inline std::string las_record(const std::string& user, std::uint16_t id, const std::string& data) {
  std::string bytes;
  append<std::uint16_t>(bytes, 0xaabb);
  bytes += padded(user, 16);
  append(bytes, id);
  append(bytes, static_cast<std::uint16_t>(data.size()));
  return bytes + padded("a record", 32) + data;
}

inline std::string las_extended(const std::string& user, std::uint16_t id, const std::string& data) {
  std::string bytes;
  append<std::uint16_t>(bytes, 0);
  bytes += padded(user, 16);
  append(bytes, id);
  append(bytes, static_cast<std::uint64_t>(data.size()));
  return bytes + padded("an extended record", 32) + data;
}

/// A descriptor of extra bytes: type 1 to 10 for one number, 11 to 30 for pairs and triples, 0 for bytes without
/// meaning.
inline std::string las_descriptor(const std::string& name, std::uint8_t type, std::uint8_t options = 0) {
  std::string bytes(192, '\0');
  patch(bytes, 2, type);
  patch(bytes, 3, options);
  return bytes.replace(4, name.size(), name);
}

struct LasSpec {
  std::uint8_t minor = 2, format = 0;
  std::uint16_t encoding = 0;
  std::size_t points = 5, extra = 0;           ///< extra bytes a point
  std::vector<std::string> records, extended;  ///< ready made; LAS 1.3 takes one extended as its waveforms
  std::string gap;                             ///< between the records and the points
  bool waveform = false;                       ///< the first extended record holds waveforms
  std::array<double, 3> scale = {0.01, 0.01, 0.001}, offset = {500000, 5400000, 0};
};

/// Position of point `i` as stored.
inline std::array<std::int32_t, 3> las_stored(std::size_t i) {
  const auto k = static_cast<std::int32_t>(i);
  return {1234567 + 211 * k, -765432 + (k * k) % 1009, 4321 - 17 * k};
}

/// Point records of which every bit but those of the position is arbitrary.
inline std::string las_points(const LasSpec& spec) {
  std::string bytes;
  std::uint32_t state = 12345u + spec.format;
  for (std::size_t i = 0; i < spec.points; ++i) {
    for (const std::int32_t coordinate : las_stored(i)) append(bytes, coordinate);
    for (std::size_t k = 12; k < kLasPointSize[spec.format] + spec.extra; ++k) {
      state = state * 1664525u + 1013904223u;
      bytes += static_cast<char>(state >> 24);
    }
  }
  return bytes;
}

inline std::size_t las_header_size(unsigned minor) {
  return minor >= 4 ? 375 : minor == 3 ? 235 : 227;
}

inline std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

inline void patch_counts(std::string& header, const LasSpec& spec, std::size_t points_start, std::size_t length) {
  const std::uint64_t end = points_start + spec.points * length;
  const bool legacy = spec.format < 6;
  patch(header, 107, static_cast<std::uint32_t>(legacy ? spec.points : 0));
  if (spec.minor >= 3 && spec.waveform) patch<std::uint64_t>(header, 227, end);
  if (spec.minor < 4) return;
  patch<std::uint64_t>(header, 235, spec.extended.empty() ? 0 : end);
  patch(header, 243, static_cast<std::uint32_t>(spec.extended.size()));
  patch(header, 247, static_cast<std::uint64_t>(spec.points));
}

inline std::string las_file(const LasSpec& spec) {
  const std::string before = joined(spec.records) + spec.gap;
  std::string header = padded("LASF", las_header_size(spec.minor));
  const std::size_t start = header.size() + before.size(), length = kLasPointSize[spec.format] + spec.extra;
  patch<std::uint16_t>(header, 4, 4711);
  patch(header, 6, spec.encoding);
  for (std::size_t i = 8; i < 24; ++i) header[i] = static_cast<char>(17 * i);  // GUID
  header[24] = 1;
  header[25] = static_cast<char>(spec.minor);
  header.replace(26, 6, "SYSTEM").replace(58, 8, "SOFTWARE");
  patch<std::uint16_t>(header, 90, 321);
  patch<std::uint16_t>(header, 92, 2019);
  patch(header, 94, static_cast<std::uint16_t>(header.size()));
  patch(header, 96, static_cast<std::uint32_t>(start));
  patch(header, 100, static_cast<std::uint32_t>(spec.records.size()));
  header[104] = static_cast<char>(spec.format);
  patch(header, 105, static_cast<std::uint16_t>(length));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    patch(header, 131 + 8 * axis, spec.scale[axis]);
    patch(header, 155 + 8 * axis, spec.offset[axis]);
  }
  patch_counts(header, spec, start, length);
  return header + before + las_points(spec) + joined(spec.extended);
}

/// A file of each version with each format that it allows, with records, extra bytes and waveforms.
inline std::vector<LasSpec> las_matrix() {
  constexpr int kLastFormat[] = {1, 1, 3, 5, 10};
  std::vector<LasSpec> specs;
  for (std::uint8_t minor = 0; minor <= 4; ++minor) {
    for (std::uint8_t format = 0; format <= kLastFormat[minor]; ++format) {
      LasSpec spec;
      spec.minor = minor;
      spec.format = format;
      spec.extra = 5;
      spec.records = {las_record("LASF_Spec", 4, las_descriptor("height", 9)), las_record("someone", 77, "abc")};
      spec.gap = minor == 0 ? "\xdd\xcc" : "";
      const bool waves = format == 4 || format == 5 || format == 9 || format == 10;
      if (waves) spec.extended.push_back(las_extended("LASF_Spec", 65535, "waveform packets"));
      spec.waveform = waves;
      if (minor == 4) spec.extended.push_back(las_extended("someone", 78, "further data"));
      specs.push_back(spec);
    }
  }
  return specs;
}

}  // namespace kappa::test
