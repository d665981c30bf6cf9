// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/figure.hpp"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "camera.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/display.hpp"
#include "picture.hpp"
#include "scene.hpp"

namespace kappa {
namespace {

using view_detail::Scene;

constexpr int kReduction = 2;  // pixels drawn along each axis for one pixel of the file: smooth edges and text
constexpr double kTitleHeight = 50;

void check(bool good, const std::string& message) {
  if (!good) throw Error(ErrorCode::InvalidArgument, message);
}

void check_directions(const Scan& scan, const std::vector<Vec3>& directions, bool needed, const char* name) {
  check(!needed || directions.size() == scan.points.size(),
        std::string("the directions ") + name + " of the figure are " + std::to_string(directions.size()) + " for " +
            std::to_string(scan.points.size()) + " points; give one a point");
}

void validate(const Scan& scan, std::size_t values, const FigureOptions& options) {
  check(values == scan.points.size(), std::to_string(values) + " values were given for the " +
                                          std::to_string(scan.points.size()) +
                                          " points of the figure; give one a point");
  const auto is_size = [](int pixels) { return pixels >= 64 && pixels <= 8192; };
  check(is_size(options.width) && is_size(options.height), "a figure of " + std::to_string(options.width) + " x " +
                                                               std::to_string(options.height) +
                                                               " pixels cannot be drawn; choose sides in [64, 8192]");
  check(options.point_size >= 0 && options.point_size <= 256,
        "the point size is " + std::to_string(options.point_size) + " pixels; choose one in [0, 256]");
  if (options.camera) {
    const Camera& c = *options.camera;
    check(std::isfinite(c.azimuth) && std::abs(c.elevation) <= 90 && c.zoom > 0.01 && c.zoom < 1000,
          "the camera needs a finite azimuth, an elevation in [-90, 90] and a zoom in (0.01, 1000)");
  }
  const Directions d = options.directions;
  check_directions(scan, options.direction_fields.dir_min, d == Directions::Min || d == Directions::Both, "dir_min");
  check_directions(scan, options.direction_fields.dir_max, d == Directions::Max || d == Directions::Both, "dir_max");
  if (bounds(scan.points).empty()) {
    throw Error(ErrorCode::InvalidData, "there is nothing to draw: the scan has no point with finite coordinates");
  }
}

void draw_title(view_detail::Panel& panel, const std::string& title, int height, double scale, Rgb colour) {
  if (title.empty()) return;
  view_detail::TextLook look{static_cast<int>(std::lround(26 * scale)), colour};
  look.weight = view_detail::Weight::Bold;
  panel.text(Vec2(30 * scale, height - 40 * scale), title, look);
}

using Paint = std::function<void(Scene& scene, const Execution& run)>;

/// What draw_scalar and draw_labels have in common; `paint` colours the scene.
void draw(const std::string& path, const Scan& scan, const FigureOptions& options, const Paint& paint,
          const Execution& run) {
  view_detail::check_picture_path(path);
  check_cancelled(run);
  const view_detail::Quiet quiet;
  const VirtualDisplay display;
  const int width = kReduction * options.width, height = kReduction * options.height;
  const double scale = std::min(width / 1600.0, height / 1000.0);
  const Camera camera = options.camera ? *options.camera : automatic_camera(scan);

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetDPI(72);
  window->SetSize(width, height);
  Scene scene(scan, {options.background, kReduction * options.point_size, options.shading, camera, scale},
              stage(run, 0.0, 0.4));
  scene.add_to(window);
  scene.layout(width, height, scale, options.title.empty() ? 0 : kTitleHeight * scale, 0);
  paint(scene, stage(run, 0.4, 0.6));
  scene.show_edges(options.edges, stage(run, 0.6, 0.7));
  scene.show_directions(options.direction_fields, options.directions, stage(run, 0.7, 0.8));
  scene.look(camera);
  view_detail::Panel title(scene.picture());
  draw_title(title, options.title, height, scale, scene.text_colour());
  check_cancelled(run);
  window->Render();
  view_detail::write_picture(path, window, kReduction, stage(run, 0.9, 1.0));
}

}  // namespace

DirectionFields direction_fields(const Scan& scan, const std::string& suffix) {
  const auto gather = [&](const std::string& name) {
    std::array<const Field*, 3> parts = {scan.field(name + "_x" + suffix), scan.field(name + "_y" + suffix),
                                         scan.field(name + "_z" + suffix)};
    std::vector<Vec3> vectors;
    if (std::count(parts.begin(), parts.end(), nullptr) > 0) return vectors;
    vectors.reserve(scan.points.size());
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      vectors.emplace_back(parts[0]->values[i], parts[1]->values[i], parts[2]->values[i]);
    }
    return vectors;
  };
  return {gather("dir_min"), gather("dir_max")};
}

void draw_scalar(const std::string& path, const Scan& scan, const std::vector<double>& values, const ScalarStyle& style,
                 const FigureOptions& options, const Execution& run) {
  validate(scan, values.size(), options);
  std::vector<double> drawn = values;
  // A point that is not drawn has no say in the range.
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!is_finite(scan.points[i])) drawn[i] = kNaN;
  }
  const ColourRange range = colour_range(drawn, style);
  draw(
      path, scan, options,
      [&](Scene& scene, const Execution& painting) { scene.show_values(drawn, style, range, painting); }, run);
}

void draw_labels(const std::string& path, const Scan& scan, const std::vector<Label>& labels,
                 const FigureOptions& options, const Execution& run) {
  validate(scan, labels.size(), options);
  draw(
      path, scan, options, [&](Scene& scene, const Execution& painting) { scene.show_labels(labels, painting); }, run);
}

}  // namespace kappa
