// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>

#include "discs.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::view_detail {
namespace {

constexpr int kTableColours = 1024;
constexpr double kStripWidth = 290;  // of the legend, at scale 1
// Gentle light: the darkest a face gets is the ambient part, so that its hue stays that of the colour bar.
constexpr double kAmbient = 0.74, kDiffuse = 0.29;
constexpr Rgb kPlain{198, 203, 210};
constexpr Rgb kMinColour{16, 60, 140}, kMaxColour{110, 20, 20};
constexpr double kGlyphs = 40;  // lines across the extent of a scan

void set_colour(vtkProperty* property, Rgb c) {
  property->SetColor(c.r / 255.0, c.g / 255.0, c.b / 255.0);
}

bool is_empty(const Layer& layer) {
  return layer.data->GetNumberOfPolys() + layer.data->GetNumberOfVerts() == 0;
}

vtkSmartPointer<vtkActor> line_actor(vtkPolyData* lines, Rgb colour, double width, double opacity) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines);
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -8);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  set_colour(actor->GetProperty(), colour);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

/// Light from the upper left of the eye.
vtkSmartPointer<vtkLight> make_light() {
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.7, 0.75, 0.65);
  light->SetFocalPoint(0, 0, 0);
  return light;
}

}  // namespace

Scene::Scene(const Scan& scan, const SceneOptions& options, const Execution& run)
    : scan_(scan),
      options_(options),
      shape_(scan, options.point_size, towards_eye(options.camera), run),
      legend_(std::make_unique<Panel>(strip_)) {
  // Edges lie in the faces they belong to and are to be seen in front of them.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  const Rgb b = options.background;
  for (vtkRenderer* renderer : {picture_.Get(), strip_.Get()}) {
    renderer->SetBackground(b.r / 255.0, b.g / 255.0, b.b / 255.0);
  }
  strip_->InteractiveOff();
  picture_->AutomaticLightCreationOff();
  picture_->AddLight(make_light());
  colours_->SetNumberOfTableValues(kTableColours);
  if (!options_.shading) {
    const bool gentle = shape_.kind() == ShapeKind::Mesh || scan.normals.size() == scan.points.size();
    options_.shading = gentle && !scan.points.empty() ? Shading::Gentle : Shading::None;
  }
}

void Scene::add_to(vtkRenderWindow* window) {
  window->AddRenderer(picture_);
  window->AddRenderer(strip_);
}

void Scene::layout(int width, int height, double scale, double top, double bottom) {
  width_ = width;
  height_ = height;
  scale_ = scale;
  top_ = top;
  bottom_ = bottom;
  const double split = 1 - std::min(0.5, kStripWidth * scale / width);
  picture_->SetViewport(0, 0, split, 1);
  strip_->SetViewport(split, 0, 1, 1);
  draw_legend();
}

void Scene::look(const Camera& camera) {
  const double split = picture_->GetViewport()[2];
  Frame frame;
  frame.top -= top_ / height_;
  frame.bottom += bottom_ / height_;
  place_camera(picture_->GetActiveCamera(), scan_.points, camera, split * width_ / height_, frame);
  picture_->ResetCameraClippingRange();
}

void Scene::show_values(const std::vector<double>& values, const ScalarStyle& style, const ColourRange& range,
                        const Execution& run) {
  shown_ = Shown::Values;
  style_ = style;
  facts_ = field_facts(values, scan_.points);
  for (int i = 0; i < kTableColours; ++i) {
    const Rgb c = map_colour(style.map, i / (kTableColours - 1.0));
    colours_->SetTableValue(i, c.r / 255.0, c.g / 255.0, c.b / 255.0);
  }
  show_layers(shape_.paint(values, run));
  change_range(range);
}

void Scene::change_range(const ColourRange& range) {
  range_ = range;
  colours_->SetTableRange(range.low, range.high);
  colours_->Modified();
  draw_legend();
}

void Scene::show_labels(const std::vector<Label>& labels, const Execution& run) {
  shown_ = Shown::Labels;
  labels_.clear();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (is_finite(scan_.points[i])) labels_.push_back(labels[i]);
  }
  show_layers(shape_.paint(labels, run));
  draw_legend();
}

void Scene::show_plain(const Execution& run) {
  shown_ = Shown::Plain;
  std::vector<Layer> layers = shape_.paint(std::vector<double>(scan_.points.size(), 0.0), run);
  layers.front().colour = kPlain;
  show_layers(layers);
  draw_legend();
}

void Scene::show_edges(Edges edges, const Execution& run) {
  if (edges_ != nullptr) picture_->RemoveActor(edges_);
  edges_ = nullptr;
  if (edges == Edges::Hidden || !scan_.is_mesh()) return;
  edges_ = line_actor(edge_lines(scan_, run), {40, 44, 52}, 0.7 * options_.line_width, 0.45);
  picture_->AddActor(edges_);
}

void Scene::show_directions(const DirectionFields& fields, Directions which, const Execution& run) {
  for (const auto& actor : directions_) picture_->RemoveActor(actor);
  directions_.clear();
  const bool min = which == Directions::Min || which == Directions::Both;
  const bool max = which == Directions::Max || which == Directions::Both;
  if (min) add_directions(fields.dir_min, kMinColour, stage(run, 0.0, max ? 0.5 : 1.0));
  if (max) add_directions(fields.dir_max, kMaxColour, stage(run, min ? 0.5 : 0.0, 1.0));
}

Rgb Scene::text_colour() const {
  const Rgb b = options_.background;
  return 0.299 * b.r + 0.587 * b.g + 0.114 * b.b > 128 ? Rgb{30, 32, 36} : Rgb{235, 238, 242};
}

void Scene::show_layers(const std::vector<Layer>& layers) {
  for (const auto& actor : actors_) picture_->RemoveActor(actor);
  actors_.clear();
  for (const Layer& layer : layers) {
    if (is_empty(layer)) continue;
    actors_.push_back(make_actor(layer));
    picture_->AddActor(actors_.back());
  }
}

vtkSmartPointer<vtkActor> Scene::make_actor(const Layer& layer) const {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(layer.data);
  mapper->SetScalarVisibility(layer.colour ? 0 : 1);
  if (!layer.colour) {
    mapper->SetLookupTable(colours_);
    mapper->UseLookupTableScalarRangeOn();
    // Values between corners get the colours between theirs on the bar, not a mix of two colours.
    mapper->SetInterpolateScalarsBeforeMapping(shape_.kind() == ShapeKind::Mesh ? 1 : 0);
  }
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  if (layer.colour) set_colour(actor->GetProperty(), *layer.colour);
  set_material(actor->GetProperty());
  return actor;
}

void Scene::set_material(vtkProperty* property) const {
  const bool gentle = options_.shading == Shading::Gentle && shape_.has_normals();
  property->SetLighting(gentle);
  property->SetAmbient(gentle ? kAmbient : 0.0);
  property->SetDiffuse(gentle ? kDiffuse : 1.0);
  double size = options_.point_size;
  if (size <= 0) {
    // As many pixels a point as the picture has for it, if the scan fills about half of it.
    const double area = 0.5 * width_ * height_ / static_cast<double>(std::max<std::size_t>(1, shape_.point_count()));
    size = std::clamp(1.6 * std::sqrt(area), 2.0, 10.0);
  }
  property->SetPointSize(static_cast<float>(size));
}

void Scene::add_directions(const std::vector<Vec3>& directions, Rgb colour, const Execution& run) {
  if (directions.size() != scan_.points.size()) return;
  const Bounds box = bounds(scan_.points);
  const double nearest = median_spacing(scan_.points, stage(run, 0.0, 0.5));
  const double spacing = std::max((box.max - box.min).maxCoeff() / kGlyphs, 2 * nearest);
  if (!(spacing > 0)) return;
  const auto lines = direction_lines(scan_, directions, spacing, stage(run, 0.5, 1.0));
  directions_.push_back(line_actor(lines, colour, 2.2 * options_.line_width, 1));
  picture_->AddActor(directions_.back());
}

void Scene::draw_legend() {
  legend_->clear();
  const int width = static_cast<int>((1 - picture_->GetViewport()[2]) * width_);
  const LegendPlace place{width, height_, scale_, text_colour()};
  if (shown_ == Shown::Values) draw_colour_bar(*legend_, place, style_, range_, facts_);
  if (shown_ == Shown::Labels) draw_label_legend(*legend_, place, labels_);
}

}  // namespace kappa::view_detail
