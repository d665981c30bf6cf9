// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <csignal>

#include "command.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/segment/regions.hpp"
#include "kappa/view/viewer.hpp"
#include "pipeline.hpp"
#include "up_axis.hpp"

namespace kappa::app {
namespace {

struct ViewArguments {
  CurvatureArguments curvature;
  std::string picture_folder = ".";
  std::optional<UpAxis> up;
};

void declare_view(CLI::App& command, ViewArguments& arguments) {
  command.add_option("input", arguments.curvature.input, "Scan or mesh")->required();
  declare(command, arguments.curvature.filters);
  declare_up_axis(command, arguments.up);
  declare_stages(command, arguments.curvature);
  command.add_option("--pictures", arguments.picture_folder, "Folder that the key c saves pictures in")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
}

using Value = double (*)(const CurvatureSample&);

NamedValues named_values(const CurvatureField& field, const char* name, const char* unit, ColourMap map, Value value) {
  NamedValues named;
  named.style.name = name;
  named.style.unit = unit;
  named.style.map = map;
  std::transform(field.samples.begin(), field.samples.end(), std::back_inserter(named.values), value);
  return named;
}

ViewData view_data(const CurvatureField& field, double threshold) {
  const auto signed_map = ColourMap::Diverging, unsigned_map = ColourMap::Sequential;
  ViewData data;
  data.radius = field.radius;
  data.fields = {
      named_values(field, "mean curvature", "1/length", signed_map, [](const CurvatureSample& s) { return s.k.mean; }),
      named_values(field, "gaussian curvature", "1/length\u00b2", signed_map,
                   [](const CurvatureSample& s) { return s.k.gaussian; }),
      named_values(field, "k min", "1/length", signed_map, [](const CurvatureSample& s) { return s.k.k_min; }),
      named_values(field, "k max", "1/length", signed_map, [](const CurvatureSample& s) { return s.k.k_max; }),
      named_values(field, "coverage", "", unsigned_map, [](const CurvatureSample& s) { return s.coverage; })};
  data.labels = classify(field, threshold);
  for (const CurvatureSample& s : field.samples) {
    data.status.push_back(s.k.status);
    data.directions.dir_min.push_back(s.k.dir_min);
    data.directions.dir_max.push_back(s.k.dir_max);
  }
  return data;
}

ViewData recompute(const Measured& m, const CurvatureArguments& arguments, double radius, const Execution& from) {
  Execution run = from;
  run.threads = arguments.run.threads;
  const std::vector<CurvatureField> fields = measure(m, arguments.measure, {radius}, stage(run, 0.0, 0.9));
  const double threshold = estimate_threshold(*m.balls, m.surface.mesh.vertices, m.surface.u, fields.front(),
                                              arguments.measure.ball, m.surface.spacing, stage(run, 0.9, 1.0));
  return view_data(fields.front(), threshold >= 0 ? threshold : 0.0);
}

ViewerOptions viewer_options(const ViewArguments& arguments, const Measured& m, double radius) {
  ViewerOptions options;
  options.file = arguments.curvature.input;
  options.picture_folder = arguments.picture_folder;
  const double spacing = m.surface.spacing, diagonal = bounds(m.scan.points).diagonal();
  options.min_radius = std::min(spacing, radius);
  options.max_radius = std::max({0.25 * diagonal, 2 * options.min_radius, radius});
  options.radius = radius;
  options.camera = automatic_camera(m.scan);
  options.camera->up = arguments.up.value_or(options.camera->up);
  return options;
}

void run_view(const ViewArguments& arguments) {
  const CurvatureArguments& common = arguments.curvature;
  need_faces(common.surface, "view");
  check_measure(common.measure);
  if (common.measure.own_scales())
    throw CLI::ValidationError("--radius",
                               "auto-per-point leaves the slider nothing to choose; view the result of "
                               "'kappa curvature' instead, or give a radius");
  Stages stages(common.run.threads, common.run.seed, common.run.quiet);
  Measured m = prepare(common, stages);
  double radius = choose_radii(common, m).front();
  // The slider is logarithmic; the finest scale is that of the edges.
  if (radius == 0) radius = m.surface.spacing;
  Viewer viewer(
      output_scan(m), [&](double r, const Execution& run) { return recompute(m, common, r, run); },
      viewer_options(arguments, m, radius));
  // Nothing is left to finish: Ctrl-C closes the window at once.
  std::signal(SIGINT, SIG_DFL);
  viewer.run();
}

}  // namespace

void add_view(CLI::App& program) {
  add_command<ViewArguments>(program, "view", "An interactive window with a slider for the radius", declare_view,
                             run_view);
}

}  // namespace kappa::app
