// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 16384;

/// Whether all faces are triangles.
bool has_triangles_alone(const Faces& faces, const Execution& run) {
  if (faces.corners().size() != 3 * faces.size()) return false;
  std::size_t elsewhere = 0;
  serial_for(faces.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    std::size_t bits = 0;
    for (std::size_t f = begin; f < end; ++f) bits |= faces.offset(f) ^ 3 * f;
    elsewhere |= bits;
  });
  return elsewhere == 0;
}

/// Whether all corners are below `vertices`.
bool has_corners_below(std::size_t vertices, const std::vector<Index>& corners, const Execution& run) {
  Index largest = 0;
  serial_for(corners.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    Index of_block = 0;
    for (std::size_t i = begin; i < end; ++i) of_block = std::max(of_block, corners[i]);
    largest = std::max(largest, of_block);
  });
  return corners.empty() || largest < vertices;
}

/// Whether the mesh is one that passes without branches find no fault with: triangles without weights, as most are.
bool is_plain(const Mesh& mesh, const Execution& run) {
  return mesh.weights.empty() && has_triangles_alone(mesh.faces, stage(run, 0.0, 0.5)) &&
         has_corners_below(mesh.vertices.size(), mesh.faces.corners(), stage(run, 0.5, 1.0));
}

void check_face(const Mesh& mesh, std::size_t f) {
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

void validate(const Mesh& mesh, const Execution& run) {
  if (is_plain(mesh, stage(run, 0.0, 0.4))) return report_progress(run, 1.0);
  const std::size_t faces = mesh.faces.size();
  if (!mesh.weights.empty() && mesh.weights.size() != faces)
    throw Error(ErrorCode::InvalidData, std::to_string(mesh.weights.size()) + " face weights for " +
                                            std::to_string(faces) + " faces: give one a face, or none");
  serial_for(faces, kBlock, stage(run, 0.4, 1.0), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) check_face(mesh, f);
  });
}

double median_edge_length(const Mesh& mesh, const Execution& run) {
  std::vector<double> lengths_sq;
  lengths_sq.reserve(mesh.faces.corners().size());
  const auto add_edges = [&](const Faces::View& face) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index to = face[i + 1 < face.size() ? i + 1 : 0];
      const double length_sq = (mesh.vertices[to] - mesh.vertices[face[i]]).squaredNorm();
      if (std::isfinite(length_sq) && length_sq > 0) lengths_sq.push_back(length_sq);
    }
  };
  serial_for(mesh.faces.size(), kBlock, stage(run, 0.0, 0.8), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) add_edges(mesh.faces[f]);
  });
  const double of_squares = median(lengths_sq);
  report_progress(run, 1.0);
  return std::sqrt(of_squares);
}

}  // namespace kappa
