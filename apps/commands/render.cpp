// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include "checks.hpp"
#include "command.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/figure.hpp"
#include "kappa/view/view_data.hpp"
#include "progress.hpp"
#include "up_axis.hpp"

namespace kappa::app {
namespace {

struct RenderArguments {
  std::string input, output, field, range, camera, size, unit;
  std::optional<UpAxis> up;
  FigureOptions figure;
  double percentile = ScalarStyle().percentile;
  bool labels = false, edges = false, sequential = false, quiet = false;
};

void declare_style(CLI::App& command, RenderArguments& arguments) {
  command.add_option("--field", arguments.field,
                     "Field to draw; default: mean_curvature, or the first field of a file that has none");
  command.add_flag("--labels", arguments.labels,
                   "Draw the labels that `kappa segment` has written; --field names another field of labels");
  command.add_option("--range", arguments.range,
                     "LOW,HIGH: values that get the end colours; default: chosen by --percentile, with 0 in the middle "
                     "for fields with a sign");
  command
      .add_option("--percentile", arguments.percentile,
                  "The colours end at this percentile of the values, so that outliers do not bleach the picture")
      ->check(CLI::Range(50.1, 100.0))
      ->capture_default_str();
  command.add_flag("--sequential", arguments.sequential, "Use the colours for fields without a sign");
  command.add_option("--unit", arguments.unit, "Unit of length of the data, such as m; the legend then says 1/m");
  command.add_option("--directions", arguments.figure.directions, "Principal directions to draw: none, min, max, both")
      ->transform(choice<Directions>(
          {{"none", Directions::None}, {"min", Directions::Min}, {"max", Directions::Max}, {"both", Directions::Both}}))
      ->option_text("WHICH=none");
}

void declare_render(CLI::App& command, RenderArguments& arguments) {
  command
      .add_option("input", arguments.input, "Result of `kappa curvature` or `kappa segment`, or any scan with a field")
      ->required();
  command.add_option("output", arguments.output, "Picture to write: .png")->required();
  declare_style(command, arguments);
  command.add_option("--title", arguments.figure.title, "Text in the upper left corner");
  command.add_option(
      "--camera", arguments.camera,
      "AZIMUTH,ELEVATION of the eye in degrees: counter-clockwise from the south, and above the horizon; "
      "default: chosen from the shape");
  declare_up_axis(command, arguments.up);
  command.add_option("--size", arguments.size, "WIDTH,HEIGHT of the picture in pixels, each in 64 to 8192")
      ->option_text("W,H=1600,1000");
  command
      .add_option("--point-size", arguments.figure.point_size,
                  "Diameter of the points of a cloud in pixels; 0 makes them as wide as the gaps")
      ->check(not_negative())
      ->capture_default_str();
  command.add_flag("--edges", arguments.edges, "Draw the edges of the faces");
  command.add_flag("--quiet", arguments.quiet, "No progress bar and no message");
}

FigureOptions figure_options(const RenderArguments& arguments, const Scan& scan) {
  FigureOptions options = arguments.figure;
  options.edges = arguments.edges ? Edges::Shown : Edges::Hidden;
  Camera camera = automatic_camera(scan);
  camera.up = arguments.up.value_or(camera.up);
  if (!arguments.camera.empty()) {
    const std::vector<double> angles = parse_numbers("--camera", arguments.camera, 2);
    camera.azimuth = angles[0];
    camera.elevation = angles[1];
  }
  options.camera = camera;
  if (!arguments.size.empty()) {
    const std::vector<double> size = parse_numbers("--size", arguments.size, 2);
    options.width = static_cast<int>(std::clamp(size[0], 0.0, 1e6));
    options.height = static_cast<int>(std::clamp(size[1], 0.0, 1e6));
  }
  if (options.directions != Directions::None) options.direction_fields = direction_fields(scan);
  return options;
}

const Field& choose_field(const RenderArguments& arguments, const Scan& scan) {
  const std::string wanted = arguments.field.empty() ? "mean_curvature" : arguments.field;
  if (const Field* field = scan.field(wanted)) return *field;
  if (arguments.field.empty() && !scan.fields.empty()) return scan.fields.front();
  std::string names;
  for (const Field& field : scan.fields) names += " " + field.name;
  throw Error(ErrorCode::InvalidData,
              arguments.input + " has no field '" + wanted + "'; " +
                  (names.empty() ? "it has none: run `kappa curvature` on it first" : "give one of:" + names));
}

ScalarStyle style_of(const RenderArguments& arguments, const Field& field) {
  ScalarStyle style = field_style(field, arguments.unit.empty() ? "length" : arguments.unit);
  style.percentile = arguments.percentile;
  if (arguments.sequential) style.map = ColourMap::Sequential;
  if (!arguments.range.empty()) {
    const std::vector<double> range = parse_numbers("--range", arguments.range, 2);
    style.range = ColourRange{range[0], range[1]};
  }
  return style;
}

std::vector<Label> labels_of(const RenderArguments& arguments, const Scan& scan) {
  if (const Field* field = scan.field(arguments.field.empty() ? "label" : arguments.field)) return field_labels(*field);
  throw Error(ErrorCode::InvalidData, arguments.input + " has no labels; run `kappa segment` on it first");
}

void run_render(const RenderArguments& arguments) {
  Stages stages(0, arguments.quiet);
  const Scan scan = stages.run("read", [&](const Execution& run) { return read_scan(arguments.input, run); });
  const FigureOptions options = figure_options(arguments, scan);
  stages.run("draw", [&](const Execution& run) {
    if (arguments.labels) {
      draw_labels(arguments.output, scan, labels_of(arguments, scan), options, run);
    } else {
      const Field& field = choose_field(arguments, scan);
      draw_scalar(arguments.output, scan, field.values, style_of(arguments, field), options, run);
    }
  });
  if (!arguments.quiet) std::printf("written     %s\n", arguments.output.c_str());
}

}  // namespace

void add_render(CLI::App& program) {
  add_command<RenderArguments>(program, "render", "Draws a picture of a scan; no display is needed", declare_render,
                               run_render);
}

}  // namespace kappa::app
