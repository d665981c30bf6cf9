// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "filters.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"
#include "point_order.hpp"
#include "progress.hpp"
#include "surface_options.hpp"

namespace kappa::app {

/// What every command needs that makes a surface of a scan.
struct SurfaceCommand {
  std::string input, output;
  RunOptions run;
  FilterArguments filters;
  SurfaceArguments surface;
};
/// `outputs` lists the extensions that can be written.
void declare_files(CLI::App& command, SurfaceCommand& arguments, const std::string& outputs);

/// What `curvature`, `segment` and `view` have in common.
struct CurvatureArguments : SurfaceCommand {
  MeasureArguments measure;
};
void declare_stages(CLI::App& command, CurvatureArguments& arguments);

/// A scan and its surface, with the normals turned round if asked.
struct SurfaceResult {
  Scan scan;  ///< what the filters left, in the coordinates of the file
  Filtered filtered;
  Surface surface;   ///< its heights in the unit of x and y
  PointOrder order;  ///< of the surface, where it is not that of the scan
};
/// Everything in the order of the file.
SurfaceResult read_and_make_surface(const SurfaceCommand& arguments, Stages& stages);

/// Refuses surfaces that have no faces, for a command that needs them.
/// @throws CLI::ValidationError.
void need_faces(const SurfaceArguments& arguments, const std::string& command);

/// A scan with everything up to its curvatures.
struct Measured : SurfaceResult {
  /// Null if the surface has no faces, or they are needed no more. From `measure_input`, in an order of its own.
  std::unique_ptr<BallSum> balls;
  std::vector<CurvatureField> fields;  ///< one a radius, in the order of the surface; without faces one alone
  bool automatic = false;              ///< the radius was chosen from the spacing
  bool has_faces = false;              ///< else triangles of each point alone are measured
  std::size_t faces = 0;               ///< of the surface, also where they are not kept
  std::size_t dropped_faces = 0;       ///< that could not be measured
};

/// What is needed when the curvatures are known.
enum class Keep {
  Everything,
  /// Mesh and balls are given up as early as can be: half of the memory. Surface and curvatures stay in `order`.
  Curvatures
};

/// Reads and makes the surface; the balls are ready to be summed.
Measured prepare(const CurvatureArguments& arguments, Stages& stages);

/// Radii asked for, or the automatic one; empty if each point is to have its own.
/// @throws Error InvalidArgument for radius 0 on a cloud, InvalidData if no radius can be chosen.
std::vector<double> choose_radii(const CurvatureArguments& arguments, Measured& measured);

/// One field a radius, in the order of `radii`.
std::vector<CurvatureField> measure(const Measured& measured, const MeasureArguments& arguments,
                                    const std::vector<double>& radii, const Execution& run);

/// All stages up to the curvatures.
/// @throws Error as the stages do, and InvalidData if no point has a curvature.
Measured measure_input(const CurvatureArguments& arguments, Keep keep, Stages& stages);

/// The points with their corrected normals (NaN where there is none) and the faces of the scan, as they are written;
/// `places` are those of result.order.
Scan output_scan(const SurfaceResult& result, const std::vector<Index>& places = {}, const Execution& run = {});

/// Suffix of the fields of a radius: empty if there is only one radius.
std::string field_suffix(const Measured& measured, std::size_t radius);

}  // namespace kappa::app
