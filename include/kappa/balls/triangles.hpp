// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/balls/measure_options.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// The faces of a surface as triangles with corrected normals: what every ball sum is made of.
///
/// A polygon of four corners or more is split at its barycentre. A face is left out, and counted, if a corner has no
/// finite position, or no finite normal other than zero.
struct Triangles {
  std::vector<Vec3> x;  ///< the vertices of the mesh, then the points that splitting added; length
  Normals u;            ///< normals there
  /// Corners of each triangle, indices into `x`. Of a polygon split at its barycentre: two neighbouring vertices and
  /// the barycentre. Where a face has several parts, each of its vertices is the first corner of one of them.
  std::vector<std::array<Index, 3>> corners;
  std::vector<double> weights;  ///< of each triangle; empty if all are 1
  /// What the measures of each triangle have beside the integral of its density, such as the share of a bilinear quad
  /// that its four parts lack; empty if nothing.
  std::vector<MeasureSum> beside;
  std::vector<Index> faces;  ///< face of the mesh that each triangle is a part of, increasing
  std::size_t vertices = 0;  ///< of the mesh; x[i] with i >= vertices was added
  std::size_t dropped_faces = 0;

  std::size_t size() const { return corners.size(); }
  double weight(std::size_t triangle) const { return weights.empty() ? 1.0 : weights[triangle]; }
};

/// The triangles of a mesh with corrected normals `normals`, one a vertex.
/// @throws Error InvalidData if the mesh is not valid, InvalidArgument if normals.size() is not #V; Cancelled.
Triangles triangles_of(const Mesh& mesh, const Normals& normals, QuadMeasures quads = QuadMeasures::Split,
                       const Execution& run = {});

/// Measures of every whole triangle, times its weight, in the order of the triangles (Property 1 of the paper, four
/// triangles at a time). Equal to `measures_of` to a few roundings, and to the bit on every processor.
std::vector<MeasureSum> measure_triangles(const Triangles& triangles, const Execution& run = {});

/// Measures of whole triangle `t`, times its weight.
MeasureSum measures_of(const Triangles& triangles, std::size_t t);

/// Number of parts of every face of the mesh up to the last one that has any. The triangles may stand in any order.
std::vector<Index> parts_of_faces(const Triangles& triangles);

}  // namespace kappa
