// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Faces with any number of corners, as lists of indices of vertices. There is no condition on their topology.
class Faces {
 public:
  /// The corners of one face. The view ends when the faces change.
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
  /// The corners of all faces, one face after the other.
  const std::vector<Index>& corners() const { return corners_; }
  /// The place of the first corner of a face in corners().
  std::size_t offset(std::size_t face) const { return offsets_[face]; }

  /// Adds a face of `count` corners. The indices are not checked here; `validate` checks those of a mesh.
  void add(const Index* corners, std::size_t count);
  void add(Index a, Index b, Index c);
  void add(const std::vector<Index>& corners) { add(corners.data(), corners.size()); }
  /// Makes room for `faces` faces that have `corners` corners together.
  void reserve(std::size_t faces, std::size_t corners);
  void clear();

 private:
  std::vector<Index> corners_;
  std::vector<std::size_t> offsets_ = {0};
};

/// An indexed set of faces, with positions in doubles relative to a local origin.
///
/// The topology may be any: several sheets on an edge, bow ties, holes, loose triangles, opposite orientations. The
/// corners of a face turn counter-clockwise seen from the side to which its normal points.
struct Mesh {
  Vec3 origin = Vec3::Zero();  ///< position of the local origin in the coordinates of the data
  std::vector<Vec3> vertices;  ///< relative to `origin`; NaN where the scanner got no return
  Faces faces;                 ///< their corners are in [0, vertices.size())
  /// A positive weight for each face, or nothing if all weights are 1. The measures of a face count as often as its
  /// weight says: so the overlapping faces of a cloud add up to one surface (see kappa/surface/umbrella.hpp).
  std::vector<double> weights;

  /// The weight of a face.
  double weight(std::size_t face) const { return weights.empty() ? 1.0 : weights[face]; }
};

/// Checks a mesh: every face has at least three corners; every corner is below vertices.size(); the weights, if there
/// are any, are finite and positive, one for each face.
/// @throws Error InvalidData that names the first face at fault; Cancelled.
void validate(const Mesh& mesh, const Execution& run = {});

/// The median length of the edges, a measure of how dense the sampling is. An edge counts once for each face that has
/// it. Edges of length 0 and edges with an end that is not finite do not count. The result is NaN if no edge is left.
/// The mesh must be one that `validate` accepts; this is not checked.
/// @throws Cancelled. Cost: linear, 8 bytes an edge of a face.
double median_edge_length(const Mesh& mesh, const Execution& run = {});

}  // namespace kappa
