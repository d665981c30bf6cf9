// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/mesh/ball_sum.hpp"

namespace kappa {

/// Most times a face is split in four.
inline constexpr int kMostRefinements = 6;

/// The triangles of `mesh` as `measure_triangles` gives them, each split in 4^levels that lie on a curved patch through
/// its corners, orthogonal to the normals there; parts keep the weight of their face. A polygon of four corners or more
/// is split at its barycentre first, whose normal is as flat as the polygon says: it gains less.
///
/// Every level puts a vertex in the middle of every edge: on the cubic whose ends are the ends of the edge and whose
/// tangents there are the edge projected to the tangent planes, x = (xi + xj) / 2 - (<e, ni> ni - <e, nj> nj) / 8 with
/// e = xj - xi, and with the normal ni + nj - v e, v = 2 <e, ni + nj> / |e|^2, made a unit (PN triangles; Vlachos,
/// Peters, Boyd, Mitchell 2001). Both depend on the ends of the edge alone and not on their order, to the last bit:
/// what was watertight stays so.
///
/// On a smooth surface with exact normals the patch is nearer to it than the face by two orders of the edge length.
/// Noise of the normals it follows instead of averaging: see `normal_roughness`. Curvature gains on irregular
/// samplings; where the errors of plain faces cancel (spheres, aligned grids) it loses some: docs/accuracy.md.
/// Nothing but the parts is stored:
/// 4^levels times the memory of `measure_triangles`, and up to three times as many vertices as the mesh would have,
/// since faces do not share the new ones. x[0..#V) are the vertices of the mesh.
/// @throws Error InvalidArgument if levels is not 0 to kMostRefinements or there would be 2^31 parts or more; and as
/// `measure_triangles` does.
MeasuredTriangles measure_refined(const Mesh& mesh, const Normals& normals, int levels, const Execution& run = {});

/// How far the normals are from those of a smooth surface through the vertices: the median over the edges of
/// |<e, ni + nj>| / (|e| |nj - ni|), in [0, 2]. A cubic through two points and their normals needs an edge that leans
/// at both ends alike: the sum is of third order in the length of the edge, the difference of first. NaN without edges
/// along which the normal turns.
double normal_roughness(const Mesh& mesh, const Normals& normals);

/// Roughness above which refinement follows noise.
inline constexpr double kRoughNormals = 0.25;

}  // namespace kappa
