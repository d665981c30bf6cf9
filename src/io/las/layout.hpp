// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

/// Positions of the public header of LAS, and sizes that its versions define.
namespace kappa::io::las {

inline constexpr std::size_t kGlobalEncoding = 6;
inline constexpr std::size_t kMajor = 24, kMinor = 25;
inline constexpr std::size_t kSoftware = 58, kTextSize = 32;
inline constexpr std::size_t kHeaderSize = 94;
inline constexpr std::size_t kPointsStart = 96;
inline constexpr std::size_t kRecordCount = 100;
inline constexpr std::size_t kFormat = 104;
inline constexpr std::size_t kRecordLength = 105;
inline constexpr std::size_t kLegacyCount = 107, kLegacyReturns = 111;
inline constexpr std::size_t kScale = 131, kOffset = 155, kBounds = 179;
inline constexpr std::size_t kWaveformStart = 227;
inline constexpr std::size_t kExtendedStart = 235, kExtendedCount = 243;
inline constexpr std::size_t kPointCount = 247, kReturns = 255;

inline constexpr std::size_t kSmallestHeader = 227;
inline constexpr std::size_t kHeader14 = 375;
inline constexpr std::size_t kRecordHeader = 54, kExtendedHeader = 60;
inline constexpr int kLastFormat = 10;
inline constexpr int kFirstFormat14 = 6;  ///< of those that LAS 1.4 brought
inline constexpr std::size_t kMaxReturns = 15;

/// Bytes of the header of LAS 1.`minor`.
constexpr std::size_t header_size(unsigned minor) {
  return minor >= 4 ? kHeader14 : minor == 3 ? 235 : kSmallestHeader;
}

/// Bytes of a point of `format` without extra bytes.
constexpr std::size_t point_size(int format) {
  constexpr std::size_t kSizes[kLastFormat + 1] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  return kSizes[format];
}

constexpr bool has_waveform(int format) {
  return format == 4 || format == 5 || format == 9 || format == 10;
}

}  // namespace kappa::io::las
