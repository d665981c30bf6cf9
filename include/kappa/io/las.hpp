// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kappa/mesh/mesh.hpp"

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
struct LasFile {
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

  std::size_t point_count() const { return points.size() / record_length; }
};

/// Keeps the points `kept` (indices, in the order wanted) of a cloud, with normals, fields and LAS
/// records; a grid becomes a list.
/// @throws Error InvalidArgument if the scan has faces, or an index is not below the number of points.
void keep_points(Scan& scan, const std::vector<Index>& kept);

/// Whether x and y are degrees, in which no curvature can be measured. What the coordinate system of a
/// LAS file says (WKT, else GeoTIFF keys) decides; without one, whether x and y could be longitude and
/// latitude, span less than 2, and heights span more than 100 times that.
bool looks_geographic(const Scan& scan);

/// Units of length, in metres; none where it is not known.
struct LengthUnits {
  std::optional<double> horizontal;  ///< of x and y
  std::optional<double> vertical;

  /// What heights must be multiplied by to be in the unit of x and y; 1 where that is not known, or the units differ by
  /// less than 1e-4 (feet by two definitions).
  double z_scale() const;
};

/// The units that the coordinate system of a LAS file states: a projected and a vertical one in WKT (1 or 2), else the
/// linear and vertical units of its GeoTIFF keys. None for other files.
LengthUnits length_units(const Scan& scan);

}  // namespace kappa
