// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "kappa/mesh/estimate.hpp"
#include "kappa/mesh/measure_tree.hpp"
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

/// Options of the measures.
struct MeasureArguments {
  std::vector<std::string> radii;
  BallDefinition ball = BallDefinition::ExactDensity;
  QuadMeasures quads = QuadMeasures::Split;
  VertexLimit limit = VertexLimit::Star;
  std::string engine = "tree";
  Precision precision = Precision::Double;
};
void declare(CLI::App& command, MeasureArguments& options);

/// Radii in units of the data; empty for automatic.
/// @throws CLI::ValidationError on anything but numbers >= 0 or the one word auto.
std::vector<double> parse_radii(const std::vector<std::string>& radii);

/// `count` numbers separated by commas. @throws CLI::ValidationError.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count);

}  // namespace kappa::app
