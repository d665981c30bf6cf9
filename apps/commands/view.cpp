// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <csignal>
#include <optional>

#include "command.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/scan/scan.hpp"
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
  command
      .add_option(
          "input", arguments.curvature.input,
          "Scan, mesh, or result of `kappa curvature` or `kappa segment`. Without --radius, the window shows the "
          "curvatures that the file holds, and nothing is measured until the slider is moved")
      ->required();
  declare(command, arguments.curvature.filters);
  declare_up_axis(command, arguments.up);
  declare_stages(command, arguments.curvature);
  command.add_option("--pictures", arguments.picture_folder, "Folder in which the key c saves pictures")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  command.footer(viewer_keys());
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

ViewData measure_at(double radius, const Measured& m, const CurvatureArguments& arguments, const Execution& run) {
  const std::vector<CurvatureField> fields = measure(m, arguments.measure, {radius}, stage(run, 0.0, 0.9));
  const double threshold = estimate_threshold(*m.balls, m.surface.mesh.vertices, m.surface.u, fields.front(),
                                              arguments.measure.ball, m.surface.spacing, stage(run, 0.9, 1.0));
  return view_data(fields.front(), threshold >= 0 ? threshold : 0.0);
}

ViewerOptions viewer_options(const ViewArguments& arguments, const Scan& scan) {
  ViewerOptions options;
  options.file = arguments.curvature.input;
  options.picture_folder = arguments.picture_folder;
  options.camera = automatic_camera(scan);
  options.camera->up = arguments.up.value_or(options.camera->up);
  return options;
}

/// Shows the window until it is closed. Ctrl-C cancels what is done before it opens, and then closes it at once.
void show(Scan scan, const Recompute& recompute, const ViewerOptions& options, Stages& stages) {
  const auto viewer = stages.run("window", [&](const Execution& run) {
    return std::make_unique<Viewer>(std::move(scan), recompute, options, run);
  });
  std::signal(SIGINT, SIG_DFL);
  if (interrupted()) throw Cancelled();
  viewer->run();
  // Stages that the slider has started poll for interrupts alone; closing the window is one.
  catch_interrupts();
  std::raise(SIGINT);
}

/// Measures first, then shows.
void view_measured(const ViewArguments& arguments, Stages& stages) {
  const CurvatureArguments& common = arguments.curvature;
  Measured m = prepare(common, stages);
  double radius = choose_radii(common, m).front();
  const double spacing = m.surface.spacing;
  if (radius == 0) radius = spacing;  // the slider is logarithmic; the finest scale is that of the edges
  Scan scan = output_scan(m);
  ViewerOptions options = viewer_options(arguments, m.scan);
  options.min_radius = std::min(spacing, radius);
  options.max_radius = std::max({0.25 * bounds(m.scan.points).diagonal(), 2 * options.min_radius, radius});
  options.radius = radius;
  show(
      std::move(scan), [&](double r, const Execution& run) { return measure_at(r, m, common, run); }, options, stages);
}

/// Shows the curvatures that `scan` holds. The surface is made when the slider is moved for the first time.
void view_stored(const ViewArguments& arguments, Scan scan, Stages& stages) {
  const CurvatureArguments& common = arguments.curvature;
  stages.run("filter", [&](const Execution& run) { filter(scan, common.input, common.filters, run).restore(scan); });
  Stages later(common.run.threads, common.run.seed, true);
  std::optional<Measured> measured;
  const Recompute recompute = [&](double r, const Execution& run) {
    if (!measured) measured = prepare(common, later);
    return measure_at(r, *measured, common, run);
  };
  const ViewerOptions options = viewer_options(arguments, scan);
  show(std::move(scan), recompute, options, stages);
}

void run_view(const ViewArguments& arguments) {
  const CurvatureArguments& common = arguments.curvature;
  need_faces(common.surface, "view");
  check_measure(common.measure);
  check(common.filters);
  if (common.measure.own_scales())
    throw CLI::ValidationError("--radius",
                               "auto-per-point leaves the slider nothing to choose; view the result of "
                               "'kappa curvature' instead, or give a radius");
  Stages stages(common.run.threads, common.run.seed, common.run.quiet);
  if (common.measure.radii.empty()) {
    Scan scan = stages.run("read", [&](const Execution&) { return read_scan(common.input); });
    if (!stored_sets(scan).empty()) return view_stored(arguments, std::move(scan), stages);
  }
  view_measured(arguments, stages);
}

}  // namespace

void add_view(CLI::App& program) {
  add_command<ViewArguments>(program, "view",
                             "Shows a scan, a mesh or a result in a window, with a slider for the radius", declare_view,
                             run_view);
}

}  // namespace kappa::app
