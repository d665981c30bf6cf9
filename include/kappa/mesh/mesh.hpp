// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// Checks that every corner is below vertices.size(), that faces have at least three corners, and
/// that weights, if any, are finite, positive and as many as the faces.
/// @throws Error InvalidData that names the first face at fault.
void validate(const Mesh& mesh);

/// Median length of the edges of the faces, a measure of the sampling; NaN without faces.
double median_edge_length(const Mesh& mesh);

}  // namespace kappa
