// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// An attribute of the points beside position and normal, as a file holds it.
struct Field {
  /// How the values are stored in files that have types.
  enum class Type : std::uint8_t { Float64, Float32, Int32, UInt32, UInt16, UInt8 };
  std::string name;
  Type type = Type::Float64;
  std::vector<double> values;  ///< one for each point
};

/// What a reader keeps of a file beside points and fields, so that a writer of the same format can write it again.
class FileRecords {
 public:
  virtual ~FileRecords() = default;
  /// The number of points that have records.
  virtual std::size_t point_count() const = 0;
  /// The records of the points `kept`, in the order of `kept`. Its indices must be below point_count().
  /// @throws Cancelled.
  virtual std::shared_ptr<const FileRecords> picked(const std::vector<Index>& kept, const Execution& run) const = 0;
};

/// The units of length of a coordinate system, in metres. A unit that is not known is absent.
struct LengthUnits {
  std::optional<double> horizontal;  ///< of x and y
  std::optional<double> vertical;    ///< of heights

  /// The factor that brings heights into the unit of x and y. It is 1 if a unit is not known, and if the units differ
  /// by less than 1e-4, as the two definitions of a foot do.
  double z_scale() const;
};

/// The points of a file with their attributes, and its faces if it is a mesh.
struct Scan {
  Vec3 origin = Vec3::Zero();      ///< position of the local origin in the coordinates of the file
  std::vector<Vec3> points;        ///< relative to `origin`; NaN where the scanner got no return
  Normals normals;                 ///< one for each point as in the file, of any length; empty if it has none
  Faces faces;                     ///< their corners are indices of `points`; empty for a cloud
  std::size_t width = 0;           ///< the columns of an organised cloud, else the number of points
  std::size_t height = 1;          ///< the rows of an organised cloud, else 1
  std::optional<Vec3> viewpoint;   ///< position of the scanner, in the coordinates of the file
  std::vector<Field> fields;       ///< all other attributes
  LengthUnits units;               ///< what the coordinate system of the file states
  std::optional<bool> geographic;  ///< whether x and y are degrees; absent if the coordinate system does not state it
  /// The records of the file, one for each point, from which they are written again bit for bit. Null if the format of
  /// the file has none.
  std::shared_ptr<const FileRecords> records;

  bool is_mesh() const { return !faces.empty(); }
  /// Whether the points are a grid of rows and columns.
  bool is_organised() const { return height > 1; }
  /// The field of that name, or null.
  const Field* field(const std::string& name) const;
};

/// Moves the local origin of `scan` to a place among its points, by `choose_origin` of their bounds, so that
/// coordinates become small. The positions in the coordinates of the file stay the same, to the bit. A second call
/// changes nothing.
void move_to_local_origin(Scan& scan);

/// The mesh of a scan that has faces: copies of its origin, points and faces.
/// @throws Error InvalidData if the scan has no faces; Cancelled.
Mesh mesh_of(const Scan& scan, const Execution& run = {});

/// Checks that the records of a scan, if it has any, are one for each point.
/// @throws Error InvalidArgument if they are not.
void check_records(const Scan& scan);

/// Leaves of a cloud the points `kept`, in the order of `kept`, with their normals, values of fields, and records. A
/// grid becomes a list.
/// @throws Error InvalidArgument if the scan has faces, if an index is not below the number of points, or if the
/// records are not one for each point; Cancelled.
void keep_points(Scan& scan, const std::vector<Index>& kept, const Execution& run = {});

}  // namespace kappa
