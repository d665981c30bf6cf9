// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kappa/scan/scan.hpp"

namespace kappa {

/// A variable length record of a LAS file, or an extended one.
struct LasRecord {
  std::uint16_t reserved = 0;  ///< first two bytes, a signature in LAS 1.0
  std::string user_id;         ///< 16 bytes, filled up with zeros
  std::uint16_t id = 0;
  std::string description;  ///< 32 bytes, filled up with zeros
  std::string data;

  /// Whether it is record `wanted` of the user that `user` (without zeros) names.
  bool is(const std::string& user, std::uint16_t wanted) const;
};

/// All bytes of a LAS file (1.0 to 1.4, point formats 0 to 10) in their parts, as read.
struct LasFile final : FileRecords {
  std::string header;                   ///< with what follows the part that its version defines
  int format = 6;                       ///< of the points
  std::size_t record_length = 30;       ///< bytes of a point
  Vec3 scale = Vec3::Constant(1e-3);    ///< coordinate = integer * scale + offset
  Vec3 offset = Vec3::Zero();           ///< in the coordinates of the file
  std::vector<LasRecord> records;       ///< before the points
  std::string gap;                      ///< between those and the first point
  std::string points;                   ///< one record of `record_length` bytes after the other
  std::vector<LasRecord> extended;      ///< after the points
  std::optional<std::size_t> waveform;  ///< which of `extended` holds the waveform packets

  std::size_t point_count() const override { return points.size() / record_length; }
  std::shared_ptr<const FileRecords> picked(const std::vector<Index>& kept, const Execution& run) const override;
};

/// The LAS file that a scan came from, null if it came from none.
const LasFile* las_of(const Scan& scan);

}  // namespace kappa
