// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/colour_map.hpp"

namespace kappa {

/// The axis that points up in a picture.
/// The axis that points up; NegativeY is that of a depth camera's own frame (x right, y down, z forward).
enum class UpAxis { Y, Z, NegativeY };

/// Where a figure is seen from. The picture is always filled with the data.
struct Camera {
  /// Degrees, growing counter-clockwise seen from above; 0 = from the south (-y, or +z where y is up, or from
  /// the depth camera itself, -z, where -y is).
  double azimuth = 0;
  double elevation = 45;  ///< degrees above the horizon, in [-90, 90]
  double zoom = 1;        ///< 1 = all of the data, 2 = twice as large
  UpAxis up = UpAxis::Z;
};

/// The view of a figure that names none. Terrain (low for its extent in plan, or a cloud of which nine of ten normals
/// lean up): oblique, from the south, 45 to 50 degrees up. A cloud in the frame of a depth camera (within 45 degrees of
/// the z axis, normals towards the origin): from near the camera. Anything else: three-quarter view. Up is z for clouds
/// and for whatever is low in z, y for other meshes, as modellers have it.
Camera automatic_camera(const Scan& scan);

enum class Shading {
  None,   ///< the colour of a value is exactly that of the colour bar
  Gentle  ///< light from the upper left shows the shape, hues stay readable
};

enum class Edges { Hidden, Shown };

/// Which principal directions are drawn as short lines.
enum class Directions { None, Min, Max, Both };

/// Unit vectors one a point (NaN for none), as in `Curvatures`.
struct DirectionFields {
  std::vector<Vec3> dir_min, dir_max;
};

/// The fields dir_min_x<suffix> ... dir_max_z<suffix> of a scan; empty vectors if they are not all there.
DirectionFields direction_fields(const Scan& scan, const std::string& suffix = "");

struct FigureOptions {
  int width = 1600, height = 1000;  ///< pixels, in [64, 8192]
  Rgb background{237, 240, 244};    ///< light, but not the white of flat surfaces
  /// Diameter of the points of a cloud in pixels; 0 draws discs in the tangent planes, each as large as the gap to
  /// its neighbours asks for, so that a cloud looks like a surface.
  double point_size = 0;
  std::optional<Camera> camera;  ///< empty for `automatic_camera`
  std::string title;
  /// Empty for Gentle on meshes and on clouds with normals, else None.
  std::optional<Shading> shading;
  Edges edges = Edges::Hidden;
  Directions directions = Directions::None;
  DirectionFields direction_fields;  ///< needed for the directions that are drawn
};

/// Draws a scan (its faces if it has any, else its points) coloured by `values`, one a point, with a colour bar, into
/// the PNG file `path`.
///
/// Points that are not finite are skipped, NaN values drawn in `kNoValueColour` and named in the legend. Needs no
/// display: a VirtualDisplay is started where there is none. The file is complete or not there. The same input
/// gives the same bytes on the same machine.
/// @throws Error InvalidArgument (sizes, options), InvalidData (no finite point), FileWrite, Unavailable (no display
/// and no Xvfb).
void draw_scalar(const std::string& path, const Scan& scan, const std::vector<double>& values, const ScalarStyle& style,
                 const FigureOptions& options = {});

/// The same with the colours of `label_colour`, one label a point, and a legend of the labels that occur with their
/// shares of the points. A face is divided between its corners at the midpoints of its edges.
void draw_labels(const std::string& path, const Scan& scan, const std::vector<Label>& labels,
                 const FigureOptions& options = {});

}  // namespace kappa
