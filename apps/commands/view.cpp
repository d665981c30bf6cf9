// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <csignal>
#include <optional>

#include "command.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/pipeline/output.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/segment/regions.hpp"
#include "kappa/view/viewer.hpp"
#include "scan_command.hpp"
#include "up_axis.hpp"

namespace kappa::app {
namespace {

struct ViewArguments {
  ScanCommand curvature;
  std::string picture_folder = ".";
  std::optional<UpAxis> up;
};

void declare(CLI::App& command, ViewArguments& arguments) {
  command
      .add_option(
          "input", arguments.curvature.input,
          "Scan, mesh, or result of `kappa curvature` or `kappa segment`. Without --radius, the window shows the "
          "curvatures that the file holds, and nothing is measured until the slider is moved")
      ->required();
  declare_filters(command, arguments.curvature.scan.filter);
  declare_up_axis(command, arguments.up);
  declare_curvature(command, arguments.curvature.scan);
  declare_surface(command, arguments.curvature.scan);
  declare_run(command, arguments.curvature);
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

ViewData view_data(const CurvatureField& field, std::vector<Label> labels) {
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
  data.labels = std::move(labels);
  for (const CurvatureSample& s : field.samples) {
    data.status.push_back(s.k.status);
    data.directions.dir_min.push_back(s.k.dir_min);
    data.directions.dir_max.push_back(s.k.dir_max);
  }
  return data;
}

/// Labels are those of `kappa segment`; none where the data cannot tell flat from curved.
std::vector<Label> labels_of(const PreparedScan& prepared, const CurvatureField& field, const ScanOptions& options,
                             const Execution& run) {
  try {
    return label(prepared, field, options, run).segmentation.labels;
  } catch (const Error&) {
    return std::vector<Label>(field.samples.size(), Label::Undefined);
  }
}

ViewData measure_at(double radius, const PreparedScan& prepared, const ScanOptions& options, const Execution& run) {
  CurvatureOptions curvature = options.curvature;
  curvature.scale = ScaleChoice::Given;
  curvature.radii = {radius};
  const std::vector<CurvatureField> fields = measure(prepared, curvature, stage(run, 0.0, 0.8));
  return view_data(fields.front(), labels_of(prepared, fields.front(), options, stage(run, 0.8, 1.0)));
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
}

/// Measures first, then shows.
void view_measured(const ViewArguments& arguments, Scan input, Stages& stages) {
  const ScanOptions& options = arguments.curvature.scan;
  const PreparedScan prepared = prepare_scan(std::move(input), options, stages);
  const Scan& measured = prepared.surfaced.scan;
  double radius = with_radii(options.curvature, prepared.surfaced.surface, options.name).radii.front();
  const double spacing = prepared.surfaced.surface.spacing;
  if (radius == 0) radius = spacing;  // the slider is logarithmic; the finest scale is that of the edges
  Scan scan = stages.run("window", [&](const Execution& run) { return output_scan(prepared.surfaced, run); });
  ViewerOptions window = viewer_options(arguments, measured);
  window.min_radius = std::min(spacing, radius);
  window.max_radius = std::max({0.25 * bounds(measured.points).diagonal(), 2 * window.min_radius, radius});
  window.radius = radius;
  const Recompute recompute = [&](double r, const Execution& run) { return measure_at(r, prepared, options, run); };
  show(std::move(scan), recompute, window, stages);
}

/// Shows the curvatures that `scan` holds. The surface is made when the slider is moved for the first time.
void view_stored(const ViewArguments& arguments, Scan scan, Stages& stages) {
  const ScanOptions& options = arguments.curvature.scan;
  const Scan input = scan;
  stages.run("filter",
             [&](const Execution& run) { filter_scan(scan, options.name, options.filter, run).restore(scan); });
  std::optional<PreparedScan> prepared;
  const Recompute recompute = [&](double r, const Execution& run) {
    if (!prepared) prepared = prepare_scan(input, options, stage(run, 0.0, 0.5));
    return measure_at(r, *prepared, options, stage(run, 0.5, 1.0));
  };
  const ViewerOptions window = viewer_options(arguments, scan);
  show(std::move(scan), recompute, window, stages);
}

void run(ViewArguments arguments) {
  ScanCommand& common = arguments.curvature;
  check(common.scan);
  check_faces(common.scan);
  if (common.scan.curvature.scale == ScaleChoice::PerPoint)
    throw CLI::ValidationError("--radius",
                               "auto-per-point leaves the slider nothing to choose; view the result of "
                               "'kappa curvature' instead, or give a radius");
  Stages stages(common.run.threads, common.run.quiet);
  Scan scan = read_input(common, stages);
  const bool no_radius = common.scan.curvature.scale == ScaleChoice::Automatic;
  if (no_radius && !stored_sets(scan).empty()) return view_stored(arguments, std::move(scan), stages);
  view_measured(arguments, std::move(scan), stages);
}

}  // namespace

void add_view(CLI::App& program) {
  add_command<ViewArguments>(
      program, "view", "Shows a scan, a mesh or a result in a window, with a slider for the radius", declare, run);
}

}  // namespace kappa::app
