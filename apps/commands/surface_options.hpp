// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa::app {

/// Options that every command with a computation has.
struct RunOptions {
  int threads = 0;
  std::uint64_t seed = 0;
  bool quiet = false;
  bool json = false;
};
void declare(CLI::App& command, RunOptions& options);

/// Options of the stages up to the corrected normals.
struct SurfaceArguments {
  SurfaceOptions surface;
  std::optional<double> max_depth_jump, max_incidence;  ///< GridOptions of both grid and spinning
  std::vector<std::string> orient;
  bool flip = false;
};
void declare(CLI::App& command, SurfaceArguments& options);

/// The surface options meant by the arguments.
/// @throws CLI::ValidationError on a malformed viewpoint.
SurfaceOptions surface_options(const SurfaceArguments& arguments);

/// What --radius takes besides numbers and auto.
inline constexpr const char* kAutoPerPoint = "auto-per-point";

/// Options of the measures.
struct MeasureArguments {
  std::vector<std::string> radii;
  BallDefinition ball = BallDefinition::ExactDensity;
  BorderEstimate border = BorderEstimate::InBall;
  QuadMeasures quads = QuadMeasures::Split;
  VertexLimit limit = VertexLimit::Star;
  std::string engine = "tree";
  Precision precision = Precision::Double;
  std::optional<int> order;  ///< of the bias that is cancelled; 1 if not given
  int refine = 0;            ///< see measure_refined
  double min_coverage = 0;   ///< see mark_borders

  bool own_scales() const { return radii.size() == 1 && radii.front() == kAutoPerPoint; }
};
void declare(CLI::App& command, MeasureArguments& options);

/// Radii in units of the data; empty for automatic ones.
/// @throws CLI::ValidationError on anything but numbers >= 0, or one of the words auto and auto-per-point alone.
std::vector<double> parse_radii(const std::vector<std::string>& radii);

/// Tells of options that do not go together before any work is done.
/// @throws CLI::ValidationError.
void check_measure(const MeasureArguments& arguments);

/// `count` numbers separated by commas. @throws CLI::ValidationError.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count);

}  // namespace kappa::app
