// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kappa/scan/scan.hpp"
#include "kappa/shapes/truth.hpp"

namespace kappa {

// Shapes with their true normals and curvatures.
//
// Every function returns a Scan with points on the surface to rounding, unit outward (on height fields: upward)
// normals, the ten truth fields of `add_truth_fields`, and faces that turn counter-clockwise seen from outside.
// Lengths are in any unit, curvatures in its inverse. All throw Error InvalidArgument that names the parameter,
// its value and its range. No shape has more than 10^8 vertices.

/// How a grid of quads becomes faces.
enum class GridFaces {
  Triangles,      ///< each quad split along the diagonal from its first corner
  OtherDiagonal,  ///< along the other diagonal
  Quads           ///< left whole; triangles remain at poles and on caps
};

/// Radius `radius` around 0 along parallels and meridians, poles on the z axis: slices * (rings - 1) + 2
/// vertices. Umbilic everywhere: directions NaN.
struct SphereOptions {
  double radius = 1;
  int slices = 64;  ///< meridians, at least 3
  int rings = 32;   ///< bands between parallels, poles included, at least 2
  GridFaces faces = GridFaces::Triangles;
};
Scan sphere(const SphereOptions& options);

/// Icosahedron whose triangles are split in four `subdivisions` times, pushed to the sphere:
/// 10 * 4^subdivisions + 2 vertices, nearly even. Directions NaN.
struct IcosphereOptions {
  double radius = 1;
  int subdivisions = 4;  ///< 0 to 11
};
Scan icosphere(const IcosphereOptions& options);

/// Torus around the z axis, ((R + r cos b) cos a, (R + r cos b) sin a, r sin b), slices * sides vertices.
///
/// With `twist` != 0 vertex (i, j) lies at a = 2 pi i / slices, b = 2 pi j / sides + twist a: edges wind
/// around the tube `twist` times and follow no principal direction (the SGP 2020 paper's twisted
/// torus has 4 turns).
struct TorusOptions {
  double major_radius = 3;  ///< R, above the minor radius
  double minor_radius = 1;  ///< r
  int slices = 100;         ///< around the axis, at least 3
  int sides = 100;          ///< around the tube, at least 3
  int twist = 0;            ///< turns, -100 to 100
  GridFaces faces = GridFaces::Triangles;
};
Scan torus(const TorusOptions& options);

/// What closes the ends of a cylinder.
enum class CylinderCaps {
  None,  ///< a tube with two borders
  Flat   ///< discs with vertices of their own on the rims, flat (k = 0) up to there: normals are exact on both sides
};

/// Cylinder of `radius` around the z axis, 0 <= z <= height. The normal is radial on the side;
/// k_min = 0 along the axis, k_max = 1 / radius around it.
struct CylinderOptions {
  double radius = 1;
  double height = 2;
  int slices = 64;  ///< around the axis, at least 3
  int rings = 16;   ///< bands along the axis, at least 1
  CylinderCaps caps = CylinderCaps::None;
  GridFaces faces = GridFaces::Triangles;
};
Scan cylinder(const CylinderOptions& options);

/// z = (a x^2 + b y^2) / 2 over the square |x|, |y| <= size / 2: normals upward, so that at the apex
/// k = (-a, -b). A dome of radius of curvature R at its top is a = b = -1 / R; a = b = 0 is the plane
/// (directions NaN, as at the apex wherever a = b).
struct QuadricOptions {
  double a = 1;   ///< 1/length
  double b = -1;  ///< 1/length
  double size = 2;
  int cells = 64;  ///< quads along each side, at least 1
  GridFaces faces = GridFaces::Triangles;
};
Scan quadric(const QuadricOptions& options);

/// z = (x^2 - y^2) / (2 a) over the square of side `size`: curvatures -1/a along x and 1/a along y at 0.
struct SaddleOptions {
  double a = 1;  ///< radius of curvature at 0
  double size = 2;
  int cells = 64;  ///< quads along each side, at least 1
  GridFaces faces = GridFaces::Triangles;
};
Scan saddle(const SaddleOptions& options);

/// Square of side `size` in z = 0, normals (0, 0, 1).
struct PlaneOptions {
  double size = 2;
  int cells = 32;  ///< quads along each side, at least 1
  GridFaces faces = GridFaces::Triangles;
};
Scan plane(const PlaneOptions& options);

/// Schwarz lantern: rings + 1 regular polygons of `slices` corners on the cylinder of `radius`,
/// 0 <= z <= height, each turned by half a step from the one below; triangles between them.
/// Normals and truth are the cylinder's: the triangles do not converge to them as rings / slices^2 grows.
struct LanternOptions {
  double radius = 1;
  double height = 2;
  int slices = 20;  ///< at least 3
  int rings = 40;   ///< bands, at least 1
};
Scan lantern(const LanternOptions& options);

/// How the triangles of a level set are got from a grid.
enum class Extraction {
  MarchingCubes,  ///< a vertex where a grid edge crosses the surface; many slivers, the usual thing
  SurfaceNets     ///< a vertex a cell, pushed to the surface, two triangles a crossed edge; well-shaped
};

/// Goursat's surface 3 (x^4 + y^4 + z^4) - 200 (x^2 + y^2 + z^2) = 800: a rounded cube with hollow sides,
/// |x| < 9.7, sampled on a grid of step `step`; a closed manifold mesh of genus 0. Directions are NaN
/// at its umbilics alone, isolated points such as those on the axes and the diagonals.
struct GoursatOptions {
  double step = 0.5;  ///< 0.02 to 2
  Extraction extraction = Extraction::MarchingCubes;
};
Scan goursat(const GoursatOptions& options);

/// Random points in place of the vertices, without faces: independent and uniform by area.
struct SampleOptions {
  std::size_t points = 10000;  ///< 1 to 10^8
  std::uint64_t seed = 0;
};
Scan sample_sphere(double radius, const SampleOptions& sampling);
Scan sample_torus(double major_radius, double minor_radius, const SampleOptions& sampling);
/// The side alone.
Scan sample_cylinder(double radius, double height, const SampleOptions& sampling);
Scan sample_quadric(double a, double b, double size, const SampleOptions& sampling);
/// The points are drawn on a fine mesh and pushed to the surface: uniform within about 2 %.
Scan sample_goursat(const SampleOptions& sampling);

/// The names that `kappa generate` takes: those of the functions above that make a mesh, and the
/// scans of scanner.hpp.
const std::vector<std::string>& shape_names();

}  // namespace kappa
