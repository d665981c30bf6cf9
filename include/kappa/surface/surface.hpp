// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "kappa/mesh/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa {

/// Where the faces of a surface come from.
enum class SurfaceKind {
  Auto,     ///< Faces if the scan has any, else Umbrella
  Faces,    ///< those of the scan
  Umbrella  ///< umbrella_surface of the points
};

/// Where the corrected normals come from.
enum class NormalsKind {
  Auto,   ///< Input if the scan has normals; else Max on a mesh, Pca on a cloud
  Input,  ///< those of the scan
  Geometric,
  Area,
  Angle,
  Max,  ///< these four from the faces, see NormalWeights
  Pca   ///< planes fitted to the neighbours
};

/// How the sign of normals is chosen.
enum class Orientation {
  Auto,      ///< Input for the scan's normals, AsFaces on a mesh; for planes fitted to a cloud Viewpoint if one is
             ///< given or the scan's lies near the points, else Up
  Input,     ///< as the scan's normals are
  AsFaces,   ///< the side from which the faces turn counter-clockwise
  Up,        ///< z not negative
  Viewpoint  ///< towards the scanner
};

struct SurfaceOptions {
  SurfaceKind surface = SurfaceKind::Auto;
  NormalsKind normals = NormalsKind::Auto;
  Orientation orientation = Orientation::Auto;
  std::optional<Vec3> viewpoint;  ///< in the coordinates of the data; else that of the scan
  int neighbours = 16;            ///< of the stars of an umbrella surface
  int normal_neighbours = 24;     ///< of the fitted planes, the point included
  int averaging_passes = 0;       ///< see average_normals
};

/// A scan made ready to be measured.
struct Surface {
  Mesh mesh;                 ///< its vertices are the points of the scan, in order
  Normals u;                 ///< corrected unit normals of the points; zero where there is none
  std::vector<Index> twins;  ///< of a cloud: the point that stands for each position (CloudSurface::representative)
  /// What was chosen; never Auto.
  SurfaceKind kind = SurfaceKind::Faces;
  NormalsKind normals = NormalsKind::Input;
  Orientation orientation = Orientation::Input;
  std::size_t invalid_points = 0;                         ///< position not finite
  std::size_t normalless_points = 0;                      ///< finite, but no usable normal
  std::size_t duplicate_points = 0, starless_points = 0;  ///< see CloudSurface
  double spacing = kNaN;                                  ///< median length of the edges of the faces
};

/// Faces and normals of a scan, as the options ask.
/// @throws Error InvalidArgument if the options contradict each other or the scan lacks what they ask for
/// (faces, normals, a viewpoint); InvalidData if no point or no face is left.
Surface make_surface(const Scan& scan, const SurfaceOptions& options, const Execution& run = {});

/// Radius of the measuring ball where the user gives none: kAutomaticRadius times the spacing, rounded to two
/// digits. NaN if the spacing is not known.
inline constexpr double kAutomaticRadius = 5;
double automatic_radius(const Surface& surface);

/// Names as on the command line: "faces", "umbrella"; "input", "geometric" ...; "up", "viewpoint" ...
const char* name(SurfaceKind kind);
const char* name(NormalsKind kind);
const char* name(Orientation orientation);

}  // namespace kappa
