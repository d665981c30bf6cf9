// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "kappa/core/names.hpp"
#include "kappa/surface/random_triangles.hpp"

namespace kappa {

/// Where the faces of a surface come from.
///
/// Auto takes the first of these that fits the scan:
/// (a) Faces: the scan has faces.
/// (b) Grid: the scan is organised in rows, and its viewpoint is credible (see Orientation).
/// (c) Spinning: its viewpoint is credible, and it has a field "ring".
/// (d) Spinning: its viewpoint is credible, one point in a thousand lies at the viewpoint or is not finite, and the
///     others lie on the rings of at most 128 lasers.
/// (e) Umbrella.
enum class SurfaceKind {
  Auto,
  Faces,     ///< the faces of the scan
  Umbrella,  ///< `umbrella_surface` of the points
  Grid,      ///< `grid_surface` of an organised cloud
  Delaunay,  ///< `delaunay_surface` of the points
  Spinning,  ///< `spinning_surface` of a sweep, by its field "ring" if it has one
  Greedy,    ///< `SurfaceOptions::greedy` of the points
  // No faces: the curvatures are those of `random_triangle_curvatures` by the scheme of this name.
  Uniform,
  Independent,
  Hexagram,
  AveragedHexagram
};
const std::vector<Named<SurfaceKind>>& names_of(SurfaceKind);

/// The scheme of a kind that has no faces, none of the others.
std::optional<TriangleScheme> triangle_scheme(SurfaceKind kind);

/// Whether the faces of this kind have a side of their own: Faces, Grid, Delaunay, Spinning. Those of Umbrella and
/// Greedy turn to the side of the normals that they are made from.
bool has_turned_faces(SurfaceKind kind);

/// Where the corrected normals come from.
///
/// Auto takes the first of these that fits the scan:
/// (a) Input: the scan has normals.
/// (b) Quadric: the surface is Faces, and the vertices are so noisy that, in a ball of five spacings, the expected
/// error
///     of the mean curvature is smaller with quadrics of 24 vertices than with normals of the faces (`curvature_noise`,
///     `curvature_bias`). These quadrics are fitted within 3.5 spacings or more.
/// (c) Max: the surface is Faces.
/// (d) Area: the surface is Spinning.
/// (e) Quadric.
enum class NormalsKind {
  Auto,
  Input,      ///< the normals of the scan
  Geometric,  ///< NormalWeights::Uniform of the faces
  Area,       ///< NormalWeights::Area of the faces
  Angle,      ///< NormalWeights::Angle of the faces
  Max,        ///< NormalWeights::Max of the faces
  Pca,        ///< NormalFit::Plane of the points
  Quadric,    ///< NormalFit::Quadric of the points
  Robust      ///< NormalFit::Robust of the points
};
const std::vector<Named<NormalsKind>>& names_of(NormalsKind);

/// Whether normals of this kind come from the faces of the surface: Geometric, Area, Angle, Max.
bool from_faces(NormalsKind kind);

/// How the sign of the normals is chosen.
///
/// Auto takes the first of these that fits:
/// (a) Input: the normals are those of the scan.
/// (b) AsFaces: the surface is Faces, or the normals come from faces that have a side of their own.
/// (c) Up: the surface is Delaunay.
/// (d) Viewpoint: a viewpoint is given, or that of the scan is credible.
/// (e) Up: most fitted normals are less than 45 degrees from the z axis.
/// (f) Consistent.
///
/// The viewpoint of a scan is credible in these cases:
/// - The file states it: it is not (0, 0, 0), or the scan is organised, or all points lie within 45 degrees of the z
///   axis, as those of a depth camera do. Then it must lie within ten diagonals of the points.
/// - It is (0, 0, 0), which files hold that know none. Then it must lie within one diagonal of the points, and not
/// below
///   the middle of terrain. Points steeply above and below it are a room, and no terrain.
enum class Orientation {
  Auto,
  Input,      ///< as the normals of the scan are
  AsFaces,    ///< the side from which the faces turn counter-clockwise
  Up,         ///< z is not negative
  Viewpoint,  ///< towards the scanner
  Consistent  ///< `orient_consistently`
};
const std::vector<Named<Orientation>>& names_of(Orientation);

}  // namespace kappa
