// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/balls/triangles.hpp"

namespace kappa {

/// Of each vertex, the derivative of the normal as a symmetric matrix, du = S dx: eigenvalues k_min and k_max on the
/// tangent plane, and 0 along the normal. NaN where it is not known. Units: 1/length.
using ShapeOperators = std::vector<Mat3>;

/// The triangles of `mesh` as `triangles_of` gives them, each split in 4^levels on a curved patch through its
/// corners; parts keep the weight of their face. A polygon of four corners or more is first split where the
/// curves below between its corners have their middle: of four, in the middle of the curve between those of the
/// diagonals, hence as near to the surface as the points of edges are.
///
/// Every level puts a vertex in the middle of every edge e = xj - xi, on the quintic that has the positions and the
/// first and second derivatives of both ends (Hermite), which along the edge are
///   ti = e projected to the tangent plane at i, made |e| (1 + ki^2 |e|^2 / 24) long, ki = normal curvature along it,
///   ai = -<ti, Si ti> ui: hence
///   x = (xi + xj) / 2 + 5/32 (ti - tj) + (ai + aj) / 64, with derivative T = 15/8 e - 7/16 (ti + tj) + (aj - ai) / 32;
/// its normal is that of the cubic that has the normals and their derivatives at both ends, made a unit,
///   u = (ui + uj) / 2 + b, b = (Si ti - Sj tj) / 8;
/// its S the mean of Si and Sj on the tangent plane, corrected to the derivative of that cubic along T.
/// On exact data the quintic knows the part d of u along T better: it is taken away, d / (1 + (d / 0.2 |b|)^2) of it. A
/// large d beside b comes from noise of the positions, and the normals are to be believed: noise enters as with the
/// plain faces and is not amplified.
///
/// An edge of which less than half lies in the tangent plane of an end, or along which the normal would turn by more
/// than 2 at the rate of an end, stays straight, with the mean of the normals. One with an end whose S is not known has
/// the midpoint of PN triangles (Vlachos, Peters, Boyd, Mitchell 2001): x = (xi + xj) / 2 - (<e, ui> ui - <e, uj> uj)
/// / 8, normal ui + uj - v e with v = 2 <e, ui + uj> / |e|^2, no S; unlike the rest, that amplifies noise.
/// All depends on the ends of the edge alone and not on their order, to the last bit: what was watertight stays so.
///
/// On a smooth surface with exact S, points are off by O(|e|^4), on spheres by O(|e|^6), and normals by O(|e|^4) at the
/// first level and, by the mean of S, O(|e|^3) at the others.
/// Nothing but the parts is stored: 4^levels times the memory of `triangles_of`, and up to three times as many
/// vertices as the mesh would have, since faces do not share the new ones. x[0..#V) are the vertices of the mesh.
/// @throws Error InvalidArgument if levels is not 0 to kMostRefinements, there would be 2^31 parts or more, or shapes
/// are not one a vertex; and as `triangles_of` does.
Triangles refined_triangles(const Mesh& mesh, const Normals& normals, const ShapeOperators& shapes, int levels,
                            const Execution& run = {});

/// Checks a number of levels for faces with `corners` corners in all.
/// @throws Error InvalidArgument if levels is not 0 to kMostRefinements or there would be 2^31 parts or more.
void check_refinement(int levels, std::size_t corners);

/// How far the normals are from those of a smooth surface through the vertices: the median over the edges of
/// |<e, ni + nj>| / (|e| |nj - ni|), in [0, 2]. A cubic through two points and their normals needs an edge that leans
/// at both ends alike: the sum is of third order in the length of the edge, the difference of first. NaN without edges
/// along which the normal turns.
double normal_roughness(const Mesh& mesh, const Normals& normals, const Execution& run = {});

/// Roughness above which noise is more than what refinement could gain.
inline constexpr double kRoughNormals = 0.25;

}  // namespace kappa
