// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/scan/scan.hpp"
#include "kappa/shapes/terrain.hpp"

namespace kappa {

/// How the mirror of an airborne scanner lays its beams on the ground.
enum class ScanPattern {
  Oscillating,  ///< to and fro: a zigzag
  Parallel      ///< always in one sense: parallel lines
};

/// Whether a simulated scan carries the true normals as its normals.
enum class ScanNormals { None, True };

/// A survey from the air over [0, width] x [0, depth] of an analytic scene, in metres.
///
/// The aircraft flies straight strips along y, alternately north and south, at `altitude` above z = 0. Beams
/// are spaced evenly on the mean ground; each is followed to the first surface it meets. Beams that end on a
/// wall give no return, so a building casts a shadow and has points on its roof alone.
struct AirborneOptions {
  Scene scene = default_scene();
  double width = 160, depth = 160;  ///< m, > 0
  double density = 2.3;             ///< points per m^2 on the mean ground, all strips together, > 0
  ScanPattern pattern = ScanPattern::Oscillating;
  double altitude = 600;                 ///< m above z = 0; well above the scene
  double half_angle = 0.105;             ///< rad, largest angle of a beam from the vertical, 0.01 to 1
  double overlap = 0.2;                  ///< part of a strip's width that the next one covers again, 0 to 0.9
  double jitter = 0.25;                  ///< random displacement of each beam, in spacings, 0 to 1
  double range_noise = 0.03;             ///< m, standard deviation along the beam, >= 0
  double duplicates = 0;                 ///< share of points stored twice, one after the other, 0 to 1
  Vec3 origin = {512000, 5403000, 300};  ///< of the south-west corner, as a projected coordinate system has it
  /// Truth is NaN within this distance (m, in plan) of the edges of a building: no curvature is defined on
  /// an edge, and no ball across one measures that of a face. >= 0.
  double crease_margin = 1;
  ScanNormals normals = ScanNormals::None;
  std::uint64_t seed = 1;
};

/// The scan in order of acquisition: coordinates relative to `origin`, truth fields of the point
/// that the beam met before noise, and the fields `classification` (2 ground, 6 building: the codes of
/// LAS), `strip` (from 0) and `crease_distance` (m in plan to the nearest edge of a building, for
/// comparisons that leave out balls of a larger radius; absent in a scene without buildings).
/// About density * width * depth points, less the shadows.
/// @throws Error InvalidArgument that names the option, its value and its range.
Scan airborne_scan(const AirborneOptions& options);

/// Random points on the terrain z = amplitude sin(x / x_length) cos(y / y_length) over
/// [0, width] x [0, depth], uniform in plan, with noise along z as of a scanner far above.
struct WavesOptions {
  std::size_t points = 100000;        ///< 1 to 10^8
  double width = 1000, depth = 1000;  ///< > 0
  double amplitude = 20;
  double x_length = 60, y_length = 80;  ///< > 0
  double range_noise = 0;               ///< standard deviation, >= 0
  Vec3 origin = Vec3::Zero();
  ScanNormals normals = ScanNormals::True;
  std::uint64_t seed = 1;
};

/// Truth fields and, if asked, normals are those of the point before noise.
/// @throws Error InvalidArgument that names the option, its value and its range.
Scan waves_scan(const WavesOptions& options);

}  // namespace kappa
