// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// Faces of any number of corners, as lists of vertex indices; no condition on their topology.
class Faces {
 public:
  /// Corners of one face.
  struct View {
    const Index* first;
    std::size_t count;
    const Index* begin() const { return first; }
    const Index* end() const { return first + count; }
    std::size_t size() const { return count; }
    Index operator[](std::size_t i) const { return first[i]; }
  };

  std::size_t size() const { return offsets_.size() - 1; }
  bool empty() const { return size() == 0; }
  View operator[](std::size_t face) const {
    return {corners_.data() + offsets_[face], offsets_[face + 1] - offsets_[face]};
  }
  /// Corners of all faces, one after the other.
  const std::vector<Index>& corners() const { return corners_; }
  /// Position of a face's first corner in corners().
  std::size_t offset(std::size_t face) const { return offsets_[face]; }

  void add(const Index* corners, std::size_t count);
  void add(Index a, Index b, Index c);
  void add(const std::vector<Index>& corners) { add(corners.data(), corners.size()); }
  void reserve(std::size_t faces, std::size_t corners);
  void clear();

 private:
  std::vector<Index> corners_;
  std::vector<std::size_t> offsets_ = {0};
};

/// An indexed face set in doubles relative to a local origin.
///
/// Any topology: several sheets on an edge, bow ties, holes, loose triangles, opposite
/// orientations. A face turns counter-clockwise seen from the side its normal points to.
struct Mesh {
  Vec3 origin = Vec3::Zero();  ///< position of the local origin in the coordinates of the data
  std::vector<Vec3> vertices;  ///< relative to origin; a vertex may be NaN (no return)
  Faces faces;                 ///< corners in [0, vertices.size())
  /// Weight of each face, empty for all 1: it lets a cloud be a surface too (see umbrella.hpp).
  std::vector<double> weights;

  double weight(std::size_t face) const { return weights.empty() ? 1.0 : weights[face]; }
};

/// One more attribute of each point, as found in or meant for a file.
struct Field {
  enum class Type : std::uint8_t { Float64, Float32, Int32, UInt32, UInt16, UInt8 };
  std::string name;
  Type type = Type::Float64;   ///< how it is stored in files that have types
  std::vector<double> values;  ///< one a point
};

struct LasFile;

/// What a file of points or of a mesh holds.
struct Scan {
  Vec3 origin = Vec3::Zero();     ///< position of the local origin in the coordinates of the file
  std::vector<Vec3> points;       ///< relative to origin; NaN where the scanner got no return
  Normals normals;                ///< as in the file, not normalised; empty if it has none
  Faces faces;                    ///< empty for a cloud
  std::size_t width = 0;          ///< columns of an organised cloud, points.size() otherwise
  std::size_t height = 1;         ///< rows of an organised cloud, 1 otherwise
  std::optional<Vec3> viewpoint;  ///< of the scanner, in the coordinates of the file
  std::vector<Field> fields;      ///< all other attributes, one value a point
  /// All that its LAS file holds (io/las.hpp), so that it leaves bit for bit; null if it came from no LAS file.
  std::shared_ptr<const LasFile> las;

  bool is_mesh() const { return !faces.empty(); }
  bool is_organised() const { return height > 1; }
  /// The field of that name, or null.
  const Field* field(const std::string& name) const;
};

struct Bounds {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
  bool empty() const { return !(min.x() <= max.x()); }
  double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
};

/// Bounds of the finite points.
Bounds bounds(const std::vector<Vec3>& points);

/// A local origin for points given in the coordinates of a file: 0 on an axis along which the data
/// is not far from 0 for its extent, else a round number among them. Subtracting it, and adding it
/// back, is exact in double.
Vec3 choose_origin(const Bounds& bounds);

/// Moves the points of `scan` to `choose_origin` of their bounds. Idempotent.
void move_to_local_origin(Scan& scan);

/// The mesh of a scan that has faces. Loose copies, origin kept.
/// @throws Error InvalidData if it has no face.
Mesh mesh_of(const Scan& scan);

/// Checks that every corner is below vertices.size(), that faces have at least three corners, and
/// that weights, if any, are finite, positive and as many as the faces.
/// @throws Error InvalidData that names the first face at fault.
void validate(const Mesh& mesh);

/// Median length of the edges of the faces, a measure of the sampling; NaN without faces.
double median_edge_length(const Mesh& mesh);

}  // namespace kappa
