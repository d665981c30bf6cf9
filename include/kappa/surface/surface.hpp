// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/search/noise.hpp"
#include "kappa/surface/delaunay.hpp"
#include "kappa/surface/grid.hpp"
#include "kappa/surface/kinds.hpp"
#include "kappa/surface/orientation.hpp"
#include "kappa/surface/random_triangles.hpp"
#include "kappa/surface/spinning.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa {

struct SurfaceOptions {
  SurfaceKind surface = SurfaceKind::Auto;
  NormalsKind normals = NormalsKind::Auto;
  Orientation orientation = Orientation::Auto;
  std::optional<Vec3> viewpoint;  ///< in the coordinates of the data; else that of the scan
  std::optional<int> neighbours;  ///< of the stars of an umbrella surface (16), or of random triangles (20)
  int triangles = 100;            ///< of each point for Uniform and Independent
  std::uint64_t seed = 0;         ///< of the numbers that these two draw
  GridOptions grid;               ///< cuts of Grid
  GridOptions spinning = kSpinningCuts;
  DelaunayOptions delaunay;
  /// What Greedy calls with origin, points and normals: `greedy_surface` of kappa/pcl/greedy.hpp, from a layer above.
  std::function<CloudSurface(const Vec3&, const std::vector<Vec3>&, const Normals&)> greedy;
  /// Of the fitted planes or quadrics, the point included. Unless it or the radius is given, 24, and all points within
  /// the radius at which noise and bias of the normals are equal (balanced_normal_radius) where that is larger, up to
  /// 21 spacings; 24 where residuals are more than twice the noise (NormalFitOptions::noise).
  std::optional<int> normal_neighbours;
  std::optional<double> normal_radius;    ///< of the fits; where it holds too few points, the neighbours
  std::optional<double> measured_radius;  ///< smallest radius of a ball, if known: fits are not made larger for noise
  int averaging_passes = 0;               ///< see average_normals
};

/// A scan made ready to be measured.
struct Surface {
  Mesh mesh;                 ///< its vertices are the points of the scan, in order
  Normals u;                 ///< corrected unit normals of the points; zero where there is none
  std::vector<Index> twins;  ///< of a cloud: the point that stands for each position (CloudSurface::representative)
  /// What was chosen; never Auto.
  SurfaceKind kind = SurfaceKind::Faces;
  std::string reason;  ///< why that kind, in a few words
  NormalsKind normals = NormalsKind::Input;
  Orientation orientation = Orientation::Input;
  std::size_t invalid_points = 0;                         ///< position not finite
  std::size_t normalless_points = 0;                      ///< finite, but no usable normal
  std::size_t duplicate_points = 0, starless_points = 0;  ///< see CloudSurface
  std::size_t cut_faces = 0;  ///< of Grid, Spinning and Delaunay: beyond a gap or a depth edge, or grazing
  std::size_t at_sensor = 0;  ///< see SpinningSweep
  NormalAgreement agreement;  ///< of the normals of a cloud, over the sides of its faces if it has any
  CloudScale scale;           ///< of the points that planes or quadrics were fitted to; NaN otherwise
  int normal_neighbours = 0;  ///< of those fits
  double normal_radius = 0;   ///< likewise, 0 for the nearest neighbours alone
  int averaging_passes = 0;   ///< over the normals
  double spacing = kNaN;      ///< median length of the edges of the faces; without faces that to the nearest point
};

/// Faces and normals of a scan, as the options ask.
/// @throws Error InvalidArgument if the options contradict each other or the scan lacks what they ask for
/// (faces, normals, a viewpoint); InvalidData if no point or no face is left.
Surface make_surface(const Scan& scan, const SurfaceOptions& options, const Execution& run = {});

/// What `random_triangle_curvatures` is to do for a surface of a kind that has no faces, see `triangle_scheme`.
RandomTriangleOptions random_triangle_options(TriangleScheme scheme, const SurfaceOptions& options);

/// Radius of the measuring ball where the user gives none, rounded to two digits: kAutomaticRadius times the spacing;
/// where normals were fitted to noisy points, the radius at which the noise of the mean curvature equals its bias if
/// that is larger (balanced_radius), at most kLargestRadius times the spacing. A smaller ball would be noise, a larger
/// one would blur more than it calms. NaN if the spacing is not known.
inline constexpr double kAutomaticRadius = 5, kLargestRadius = 30;
double automatic_radius(const Surface& surface);

/// Why that radius, in a few words: "5 median edges of 0.2, noise 1e-05 asks for no more".
std::string automatic_radius_reason(const Surface& surface);

}  // namespace kappa
