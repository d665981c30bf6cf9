// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/balls/ball_sum.hpp"

/// Surfaces of about a million triangles and the queries that the benchmarks put to them.
namespace kappa::bench {

struct Surface {
  Mesh mesh;
  Normals normals;
};

/// "torus" (R = 3, r = 1, jittered), "terrain" (2.5D), "huge" (the torus and one face 10^4 times the others), "pareto"
/// (the torus and one per cent more faces, their sizes Pareto(1.2)) or "shuffled" (the torus, its vertices and faces in
/// random order). Made once.
const Surface& surface(const std::string& name);

/// The triangles of a surface. Made once.
const Triangles& triangles(const std::string& name);

/// Radius of a disc of `faces` average triangles of the torus or terrain that the surface is made of.
double radius_for(const std::string& name, double faces);

/// About `count` vertices of the torus or terrain, in runs that are consecutive in spatial order, as in a whole run.
std::vector<Vec3> queries(const std::string& name, std::size_t count);

}  // namespace kappa::bench
