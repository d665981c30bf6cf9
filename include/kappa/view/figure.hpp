// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/colour_map.hpp"

namespace kappa {

/// The axis that points up in a picture.
enum class UpAxis {
  Y,
  Z,
  NegativeY  ///< for the frame of a depth camera: x points right, y down, z forward
};

/// Where a figure is seen from. The distance to the data is chosen so that they fill the picture.
struct Camera {
  /// Direction from the data to the eye in plan, in degrees counter-clockwise seen from above. At 0 the eye is in
  /// direction (a) -y where z is up, (b) +z where y is up, (c) -z, towards the depth camera, where -y is up.
  double azimuth = 0;
  double elevation = 45;  ///< of the eye above the horizon, in degrees, in [-90, 90]
  double zoom = 1;        ///< in (0.01, 1000); 1 shows all of the data, 2 shows them twice as large
  UpAxis up = UpAxis::Z;
};

/// The view of a figure that names none. The first of these cases that applies decides:
/// (a) The scan is low in z: its height is less than 0.35 times its extent in plan. Azimuth -18, elevation 48, z is up.
/// (b) It is a cloud in the frame of a depth camera: all points lie within 45 degrees of the z axis, and nine of ten
///     normals point towards the origin. Azimuth 15, elevation 20, -y is up.
/// (c) It is a cloud of which nine of ten normals are within 75 degrees of the z axis. As (a).
/// (d) It is another cloud. Azimuth -35, elevation 22, z is up.
/// (e) It is a mesh that is low in y, by the measure of (a). As (a), but y is up.
/// (f) It is another mesh. As (d), but y is up, as modellers have it.
/// Extents are those of the middle 99 % of the points along an axis.
Camera automatic_camera(const Scan& scan);

enum class Shading {
  None,   ///< a value has exactly its colour on the colour bar
  Gentle  ///< light from the upper left shows the shape; the hues stay those of the colour bar
};

enum class Edges { Hidden, Shown };

/// Which principal directions are drawn as short lines: of the least curvature, of the greatest, or of both.
enum class Directions { None, Min, Max, Both };

/// Principal directions, one unit vector a point, as in `Curvatures`. A point without a direction has NaN.
struct DirectionFields {
  std::vector<Vec3> dir_min, dir_max;
};

/// The principal directions in the fields dir_min_x<suffix> ... dir_max_z<suffix> of a scan. A direction of which one
/// of the three fields is missing gives an empty vector.
DirectionFields direction_fields(const Scan& scan, const std::string& suffix = "");

struct FigureOptions {
  int width = 1600, height = 1000;  ///< in pixels, in [64, 8192]
  Rgb background{237, 240, 244};    ///< light, but darker than the white of flat surfaces
  /// Diameter of the points of a cloud in pixels, in [0, 256]; it has no effect on a mesh. With 0, clouds of up to
  /// 300 000 points are drawn as discs in the tangent planes, wide enough to close the gaps, so that a cloud looks like
  /// a surface; larger clouds get points of a size that suits their number.
  double point_size = 0;
  std::optional<Camera> camera;  ///< empty for `automatic_camera`
  std::string title;             ///< in the upper left corner; may be empty
  /// Empty for Gentle on meshes and on clouds with normals, and None on clouds without.
  std::optional<Shading> shading;
  Edges edges = Edges::Hidden;  ///< of the faces; a cloud has none
  Directions directions = Directions::None;
  DirectionFields direction_fields;  ///< one a point for the directions that are drawn; otherwise not read
};

/// Draws a scan with a colour bar into the PNG file `path`. The faces are drawn if the scan has any, otherwise its
/// points, in the colours of `values` (one a point).
///
/// Points that are not finite are not drawn and have no influence on the colours. A face with a corner without a value
/// (NaN), and a point without one, gets `kNoValueColour`; the legend then names this colour. No display is needed:
/// where there is none, a VirtualDisplay is started. The same input gives the same bytes on the same machine.
///
/// The call polls `run.cancel` between and within its stages, except while VTK draws. After an error or a cancellation
/// no file is left; a file that was there before stays as it was.
/// @throws Error InvalidArgument (sizes, style, options), InvalidData (no finite point), FileWrite, Unavailable (no
/// display and no Xvfb); Cancelled.
void draw_scalar(const std::string& path, const Scan& scan, const std::vector<double>& values, const ScalarStyle& style,
                 const FigureOptions& options = {}, const Execution& run = {});

/// Draws a scan as `draw_scalar` does, but in the colours of its labels (`label_colour`, one label a point). The legend
/// lists the labels that occur, with their shares of the finite points. A face with several labels is divided between
/// its corners at the midpoints of its edges.
/// @throws Error and Cancelled as `draw_scalar`.
void draw_labels(const std::string& path, const Scan& scan, const std::vector<Label>& labels,
                 const FigureOptions& options = {}, const Execution& run = {});

}  // namespace kappa
