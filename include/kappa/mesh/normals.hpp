// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// The weight of a face in the normal of a vertex (Section 5 of the paper that `Measures` names). The edges a and b of
/// the face leave the vertex.
enum class NormalWeights {
  Uniform,  ///< 1, the paper's GEOM
  Area,     ///< the area of the face
  Angle,    ///< the angle between a and b
  Max       ///< |a x b| / (|a|^2 |b|^2), which is exact on spheres (Max, J. Graphics Tools 4(2), 1999); GEOM-MAX
};

/// The words for the weights: geometric, area, angle, max.
const std::vector<Named<NormalWeights>>& names_of(NormalWeights);

/// The vector area of a face: half the sum of the cross products of its edges from the first corner. Its length is the
/// area of a plane face, and it points along the normal.
Vec3 polygon_vector_area(const Mesh& mesh, std::size_t face);

/// The unit normals of the vertices: the sum of the unit normals of the faces around a vertex, each multiplied by the
/// weight of the face and by `weights`, made a unit vector. The result has one normal for each vertex.
///
/// A face that has no area, or a corner that is not finite, does not vote. The normal is the zero vector where no face
/// votes, and where the votes cancel each other to 1e-12 of the sum of their sizes.
/// @throws Error InvalidData as `validate` does; Cancelled.
Normals vertex_normals(const Mesh& mesh, NormalWeights weights, const Execution& run = {});

/// Averages normals over the mesh: `passes` times, all vertices at once, u_i becomes u_i + sum of u_j, made a unit
/// vector, where j are the neighbours of vertex i along edges.
///
/// A normal that is zero or not finite stays as it is and does not vote. A normal also stays where the sum cancels to
/// 1e-12 of the sum of the sizes.
/// @throws Error InvalidArgument if `passes` is negative or there is not one normal for each vertex, InvalidData as
/// `validate` does; Cancelled.
Normals average_normals(const Mesh& mesh, const Normals& normals, int passes, const Execution& run = {});

/// The unit vectors along `normals`. A normal that is zero or not finite gives the zero vector.
/// @throws Cancelled.
Normals normalised(const Normals& normals, const Execution& run = {});

/// The opposite normals.
/// @throws Cancelled.
Normals flipped(const Normals& normals, const Execution& run = {});

}  // namespace kappa
