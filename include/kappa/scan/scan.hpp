// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kappa/core/types.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// One more attribute of each point, as found in or meant for a file.
struct Field {
  enum class Type : std::uint8_t { Float64, Float32, Int32, UInt32, UInt16, UInt8 };
  std::string name;
  Type type = Type::Float64;   ///< how it is stored in files that have types
  std::vector<double> values;  ///< one a point
};

/// What a reader keeps of a file beside points and fields, so that a writer of the same format can write it again.
class FileRecords {
 public:
  virtual ~FileRecords() = default;
  /// Number of points that there are records of.
  virtual std::size_t point_count() const = 0;
  /// The records of the points `kept` (indices below point_count()), in that order.
  virtual std::shared_ptr<const FileRecords> picked(const std::vector<Index>& kept) const = 0;
};

/// Units of length, in metres; none where it is not known.
struct LengthUnits {
  std::optional<double> horizontal;  ///< of x and y
  std::optional<double> vertical;

  /// What heights must be multiplied by to be in the unit of x and y; 1 where that is not known, or the units differ by
  /// less than 1e-4 (feet by two definitions).
  double z_scale() const;
};

/// What a file of points or of a mesh holds.
struct Scan {
  Vec3 origin = Vec3::Zero();      ///< position of the local origin in the coordinates of the file
  std::vector<Vec3> points;        ///< relative to origin; NaN where the scanner got no return
  Normals normals;                 ///< as in the file, not normalised; empty if it has none
  Faces faces;                     ///< empty for a cloud
  std::size_t width = 0;           ///< columns of an organised cloud, points.size() otherwise
  std::size_t height = 1;          ///< rows of an organised cloud, 1 otherwise
  std::optional<Vec3> viewpoint;   ///< of the scanner, in the coordinates of the file
  std::vector<Field> fields;       ///< all other attributes, one value a point
  LengthUnits units;               ///< that the coordinate system of the file states
  std::optional<bool> geographic;  ///< whether x and y are degrees, where the coordinate system of the file states it
  /// Records of the file, one a point, so that they leave bit for bit; null if its format has none.
  std::shared_ptr<const FileRecords> records;

  bool is_mesh() const { return !faces.empty(); }
  bool is_organised() const { return height > 1; }
  /// The field of that name, or null.
  const Field* field(const std::string& name) const;
};

/// Moves the points of `scan` to `choose_origin` of their bounds. Idempotent.
void move_to_local_origin(Scan& scan);

/// The mesh of a scan that has faces. Loose copies, origin kept.
/// @throws Error InvalidData if it has no face.
Mesh mesh_of(const Scan& scan);

/// @throws Error InvalidArgument if the scan has records of another number of points.
void check_records(const Scan& scan);

/// Keeps the points `kept` (indices, in the order wanted) of a cloud, with normals, fields and records; a grid becomes
/// a list.
/// @throws Error InvalidArgument if the scan has faces, if an index is not below the number of points, or if the
/// records are not one a point.
void keep_points(Scan& scan, const std::vector<Index>& kept);

}  // namespace kappa
