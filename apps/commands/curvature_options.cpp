// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "kappa/core/orders.hpp"
#include "scan_command.hpp"

namespace kappa::app {
namespace {

/// Numbers, or one of the words for a choice of the data.
void take_radii(const std::vector<std::string>& words, CurvatureOptions& options) {
  options.radii.clear();
  for (const Named<ScaleChoice>& named : names_of(ScaleChoice{})) {
    if (words.size() != 1 || words.front() != named.name) continue;
    options.scale = named.value;
    return;
  }
  options.scale = ScaleChoice::Given;
  for (const std::string& text : words) {
    options.radii.push_back(parse_number("--radius", text));
    if (options.radii.back() < 0) throw CLI::ValidationError("--radius", "'" + text + "' is negative");
  }
}

}  // namespace

void declare_curvature(CLI::App& command, ScanOptions& options) {
  CurvatureOptions& c = options.curvature;
  MeasureOptions& m = options.measure;
  command
      .add_option_function<std::vector<std::string>>(
          "--radius", [&c](const std::vector<std::string>& words) { take_radii(words, c); },
          "Radius of the ball in input units, several by commas, auto, or auto-per-point: radius "
          "and order are chosen from the data for every point")
      ->delimiter(',')
      ->option_text("R[,R...]=auto");
  command
      .add_option("--order", c.order,
                  "Order of the bias that smaller balls cancel: 1 none, 2 and 3 for smooth surfaces and wide balls")
      ->check(CLI::Range(1, kMaxOrder))
      ->option_text("N=1");
  command
      .add_option("--refine", m.refine,
                  "Split every face in four N times on a curved patch before it is measured; for good normals")
      ->check(CLI::Range(0, kMostRefinements))
      ->capture_default_str();
  command
      .add_option("--min-coverage", c.min_coverage,
                  "No curvature where faces cover less of the ball than this share of it, as at borders and holes: 0 "
                  "keeps all, 0.5 is a straight border")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  add_choice(command, "--ball", c.ball, "What a face that the sphere cuts adds");
  add_choice(command, "--border", c.border,
             "Where balls reach over a border (centre not with --refine, radius 0 or auto-per-point)");
  add_choice(command, "--quads", m.quads, "How a face of four corners is measured");
  add_choice(command, "--vertex-limit", c.vertex_limit, "What is measured at radius 0");
  add_choice(command, "--engine", m.engine, "How balls are summed");
  add_choice(command, "--precision", m.precision, "Of the tree");
}

}  // namespace kappa::app
