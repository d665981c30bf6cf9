// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

/// Whether the mesh has triangles without weights alone, all of their vertices there: told by passes that find no
/// fault.
bool is_plain(const Mesh& mesh) {
  const std::vector<Index>& corners = mesh.faces.corners();
  if (!mesh.weights.empty() || corners.size() != 3 * mesh.faces.size()) return false;
  std::size_t elsewhere = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) elsewhere |= mesh.faces.offset(f) ^ 3 * f;
  Index largest = 0;
  for (const Index v : corners) largest = std::max(largest, v);
  return elsewhere == 0 && (corners.empty() || largest < mesh.vertices.size());
}

}  // namespace

void Faces::add(const Index* corners, std::size_t count) {
  corners_.insert(corners_.end(), corners, corners + count);
  offsets_.push_back(corners_.size());
}

void Faces::add(Index a, Index b, Index c) {
  const Index corners[3] = {a, b, c};
  add(corners, 3);
}

void Faces::reserve(std::size_t faces, std::size_t corners) {
  offsets_.reserve(faces + 1);
  corners_.reserve(corners);
}

void Faces::clear() {
  corners_.clear();
  offsets_.assign(1, 0);
}

void validate(const Mesh& mesh) {
  if (is_plain(mesh)) return;
  const std::size_t faces = mesh.faces.size();
  if (!mesh.weights.empty() && mesh.weights.size() != faces)
    throw Error(ErrorCode::InvalidData, std::to_string(mesh.weights.size()) + " face weights for " +
                                            std::to_string(faces) + " faces: give one a face, or none");
  for (std::size_t f = 0; f < faces; ++f) {
    const Faces::View face = mesh.faces[f];
    const auto refuse = [f](const std::string& what) {
      throw Error(ErrorCode::InvalidData, "face " + std::to_string(f) + " has " + what);
    };
    if (face.size() < 3) refuse(std::to_string(face.size()) + " corners: at least 3 needed");
    for (const Index v : face) {
      if (v >= mesh.vertices.size())
        refuse("vertex " + std::to_string(v) + ": indices must be below " + std::to_string(mesh.vertices.size()));
    }
    if (!(mesh.weight(f) > 0 && std::isfinite(mesh.weight(f))))
      refuse("weight " + std::to_string(mesh.weight(f)) + ": weights must be positive and finite");
  }
}

double median_edge_length(const Mesh& mesh) {
  std::vector<double> lengths_sq;
  lengths_sq.reserve(mesh.faces.corners().size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Faces::View face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index to = face[i + 1 < face.size() ? i + 1 : 0];
      const double length_sq = (mesh.vertices[to] - mesh.vertices[face[i]]).squaredNorm();
      if (std::isfinite(length_sq) && length_sq > 0) lengths_sq.push_back(length_sq);
    }
  }
  return std::sqrt(percentile(lengths_sq, 50));
}

}  // namespace kappa
