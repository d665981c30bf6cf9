// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// How a face of four corners is measured.
enum class QuadMeasures {
  Split,    ///< in four triangles at its barycentre, as any other polygon
  Bilinear  ///< as a bilinear patch (Appendix B)
};

/// The faces of a surface as triangles with their measures: what every ball sum works on.
///
/// A polygon of four corners or more is split at its barycentre. Faces with a corner whose position
/// or normal is not finite, or whose normal is zero, are left out and counted.
struct MeasuredTriangles {
  std::vector<Vec3> x;  ///< vertices of the mesh, then the barycentres
  Normals u;            ///< normals there
  /// Of a polygon split at its barycentre: two neighbouring vertices and the barycentre. Where a face has several
  /// parts, each of its vertices is the first corner of one of them.
  std::vector<std::array<Index, 3>> corners;
  std::vector<double> weights;       ///< of each triangle, empty for all 1
  std::vector<MeasureSum> measures;  ///< of each whole triangle, times its weight; if empty, see measures_of()
  /// What the measures have beside the integral of the density over the triangle, as those of the parts of bilinear
  /// quads do; empty if nothing.
  std::vector<MeasureSum> beside;
  std::vector<Index> faces;  ///< face of the mesh that each triangle is of, increasing
  std::size_t vertices = 0;  ///< of the mesh; x[i] with i >= vertices is a barycentre
  std::size_t dropped_faces = 0;

  std::size_t size() const { return corners.size(); }
  double weight(std::size_t triangle) const { return weights.empty() ? 1.0 : weights[triangle]; }
};

/// @throws Error InvalidData if the mesh is not valid, or InvalidArgument if normals.size() is not #V.
MeasuredTriangles measure_triangles(const Mesh& mesh, const Normals& normals, QuadMeasures quads = QuadMeasures::Split,
                                    const Execution& run = {});

/// The same for MeasureTree: without measures that follow from the rest, which the tree makes when it has the triangles
/// in its order. With bilinear quads they do not, and are there.
/// @throws as measure_triangles()
MeasuredTriangles triangles_for_tree(const Mesh& mesh, const Normals& normals, QuadMeasures quads = QuadMeasures::Split,
                                     const Execution& run = {});

/// Measures of whole triangle `t`, times its weight: the stored ones if there are any, else computed.
MeasureSum measures_of(const MeasuredTriangles& triangles, std::size_t t);

/// Number of parts of every face of the mesh up to the last one that has any. The triangles may stand in any order.
std::vector<Index> parts_of_faces(const MeasuredTriangles& triangles);

}  // namespace kappa
