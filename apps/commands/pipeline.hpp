// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kappa/mesh/mesh.hpp"
#include "kappa/search/flann_ball_sum.hpp"
#include "progress.hpp"
#include "surface_options.hpp"

namespace kappa::app {

/// What `curvature` and `segment` (and `view`) have in common.
struct CurvatureArguments {
  std::string input, output;
  RunOptions run;
  SurfaceArguments surface;
  MeasureArguments measure;
};
void declare_input_output(CLI::App& command, CurvatureArguments& arguments);
void declare_stages(CLI::App& command, CurvatureArguments& arguments);

/// A scan with everything up to its curvatures.
struct Measured {
  Scan scan;
  Surface surface;
  std::unique_ptr<FlannBallSum> balls;
  std::vector<CurvatureField> fields;  ///< one a radius
  bool automatic = false;              ///< the radius was chosen from the spacing
};

/// Reads and makes the surface; the balls are ready to be summed.
Measured prepare(const CurvatureArguments& arguments, Stages& stages);

/// Radii asked for, or the automatic one.
/// @throws Error InvalidArgument for radius 0 on a cloud, InvalidData if no radius can be chosen.
std::vector<double> choose_radii(const CurvatureArguments& arguments, Measured& measured);

/// One field a radius, in the order of `radii`.
std::vector<CurvatureField> measure(const Measured& measured, const MeasureArguments& arguments,
                                    const std::vector<double>& radii, const Execution& run);

/// All stages up to the curvatures.
/// @throws Error as the stages do, and InvalidData if no point has a curvature.
Measured measure_input(const CurvatureArguments& arguments, Stages& stages);

/// The points with their corrected normals (NaN where there is none) and faces, as they are written.
Scan output_scan(const Measured& measured);

/// Suffix of the fields of a radius: empty if there is only one radius.
std::string field_suffix(const Measured& measured, std::size_t radius);

}  // namespace kappa::app
