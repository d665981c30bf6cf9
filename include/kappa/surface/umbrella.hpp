// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

struct UmbrellaOptions {
  int neighbours = 16;  ///< nearest points of different position each star is made of, 3 to 255
};

/// A surface through a cloud, with what could not be part of it.
struct CloudSurface {
  Mesh mesh;  ///< its vertices are the points, in order
  /// Point that stands for each position (see find_duplicates); only those are corners of faces.
  std::vector<Index> representative;
  std::size_t invalid_points = 0;    ///< not finite, or without a normal
  std::size_t duplicate_points = 0;  ///< at the position of an earlier point
  std::size_t starless_points = 0;   ///< fewer than three neighbours, or collinear ones
};

/// The umbrella surface of a cloud: every point contributes the star of triangles around it of the
/// Delaunay triangulation of its neighbours projected on its tangent plane, each with weight 1/3;
/// equal triangles of several stars are one face of weight k/3. Where the stars agree this is one
/// triangulation of weight 1, elsewhere a fair average, not manifold as it may be.
///
/// A triangle is kept if its circumcircle (in projection) is no wider than the neighbourhood, so no star
/// reaches across a gap. Faces turn counter-clockwise seen from the side of the normals.
/// `normals` fix the tangent planes and the orientation. Points without a normal make no star.
/// @throws Error InvalidArgument if sizes differ or an option is out of range; InvalidData if there
/// is no valid point.
CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Normals& normals,
                              const UmbrellaOptions& options, const Execution& run = {});

}  // namespace kappa
