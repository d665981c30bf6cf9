// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// Weight of a face in the normal of its vertices (section 5 of the SGP 2020 paper).
enum class NormalWeights {
  Uniform,  ///< plain average of the unit normals, the paper's GEOM
  Area,     ///< area of the face
  Angle,    ///< angle of the face at the vertex
  Max       ///< |a x b| / (|a|^2 |b|^2), exact on spheres (Max 1999), the paper's GEOM-MAX
};

/// Vector area of a polygon: half the sum of the cross products of its corners relative to the first.
Vec3 polygon_vector_area(const Mesh& mesh, std::size_t face);

/// Unit normals of the vertices from those of the faces around them, #V. A face counts with its
/// weight; a face of zero area does not vote; a vertex that no face votes for, or whose votes
/// cancel to 1e-12 of their sum, gets the zero vector. Faces with a corner that is not finite are left out.
/// @throws Error InvalidData as `validate` does.
Normals vertex_normals(const Mesh& mesh, NormalWeights weights, const Execution& run = {});

/// `passes` passes of u_i <- normalise(u_i + sum of u_j over the edge neighbours j), all at once
/// (Jacobi). Zero and non-finite normals do not vote and stay as they are, as does a normal that its neighbours cancel
/// to 1e-12.
/// @throws Error InvalidArgument if passes is negative or normals.size() differs from #V, InvalidData as `validate`.
Normals average_normals(const Mesh& mesh, const Normals& normals, int passes, const Execution& run = {});

/// Unit vectors along `normals`; the zero vector for those that are zero or not finite.
Normals normalised(const Normals& normals);

/// Opposite normals.
Normals flipped(const Normals& normals);

}  // namespace kappa
