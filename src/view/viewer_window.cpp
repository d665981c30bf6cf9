// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_window.hpp"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "kappa/scan/scan.hpp"
#include "picture.hpp"
#include "viewer_text.hpp"

namespace kappa::view_detail {
namespace {

constexpr auto kIdle = std::chrono::milliseconds(8);
constexpr int kClickSlack = 3;  // pixels the mouse may move during a click
constexpr int kMargin = 16;     // pixels around texts
constexpr double kTextScale = 0.72;
constexpr double kBottom = 112;                           // pixels kept free for the slider and the lines below it
constexpr double kKeysHeight = 32;                        // pixels from the bottom
constexpr double kSliderStart = 0.25, kSliderEnd = 0.65;  // across the picture
constexpr double kSliderHeight = 76;                      // pixels from the bottom
constexpr Rgb kBall{20, 130, 120};
const TextLook kKeysLook{13, {112, 117, 124}};

/// Turns the camera as VTK users know it, but leaves all keys to the viewer.
class Style : public vtkInteractorStyleTrackballCamera {
 public:
  static Style* New();
  vtkTypeMacro(Style, vtkInteractorStyleTrackballCamera)

      void OnChar() override {}
  void OnKeyPress() override {
    const char* keysym = Interactor->GetKeySym();
    if (keysym != nullptr) window->events().key(keysym);
  }
  void OnLeftButtonDown() override {
    pressed_ = position();
    vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
  }
  void OnLeftButtonUp() override {
    vtkInteractorStyleTrackballCamera::OnLeftButtonUp();
    const std::array<int, 2> at = position();
    const int moved = std::max(std::abs(at[0] - pressed_[0]), std::abs(at[1] - pressed_[1]));
    if (moved <= kClickSlack) window->events().click(at[0], at[1]);
  }

  ViewerWindow* window = nullptr;

 private:
  std::array<int, 2> position() const { return {Interactor->GetEventPosition()[0], Interactor->GetEventPosition()[1]}; }
  std::array<int, 2> pressed_{0, 0};
};
vtkStandardNewMacro(Style);

void set_colour(vtkProperty* property, Rgb c) {
  property->SetColor(c.r / 255.0, c.g / 255.0, c.b / 255.0);
}

/// A disc of some pixels in front of everything, at a position in the scan.
void make_dot(vtkActor2D* actor, double radius, Rgb colour) {
  constexpr int kSides = 24;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(kSides);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * kPi * i / kSides;
    cells->InsertCellPoint(points->InsertNextPoint(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  actor->SetMapper(mapper);
  actor->GetPositionCoordinate()->SetCoordinateSystemToWorld();
  actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  actor->VisibilityOff();
}

SceneOptions scene_options(const Camera& camera) {
  SceneOptions options;
  options.camera = camera;
  return options;
}

void make_box(vtkTextProperty* property) {
  property->SetBackgroundColor(1, 1, 1);
  property->SetBackgroundOpacity(0.85);
}

}  // namespace

ViewerWindow::ViewerWindow(const Scan& scan, const ViewerOptions& options, WindowEvents events, const Execution& run)
    : events_(std::move(events)),
      camera_(options.camera ? *options.camera : automatic_camera(scan)),
      scene_(scan, scene_options(camera_), run) {
  const Quiet quiet;
  make_window(options);
  make_texts();
  make_ball_and_marker();
  make_slider(options);
  layout();
  reset_view();
}

ViewerWindow::~ViewerWindow() {
  slider_->Off();
  interactor_->SetInteractorStyle(nullptr);
  // So told, VTK forgets a window whose last events are handled.
  interactor_->SetDone(true);
  interactor_->ProcessEvents();
  interactor_->SetRenderWindow(nullptr);
  window_->Finalize();
}

void ViewerWindow::make_window(const ViewerOptions& options) {
  const std::string name = std::filesystem::path(options.file).filename().string();
  window_->SetWindowName(name.empty() ? "kappa" : ("kappa - " + name).c_str());
  window_->SetSize(options.width, options.height);
  window_->SetMultiSamples(4);
  window_->SetDPI(72);
  scene_.add_to(window_);
  interactor_->SetRenderWindow(window_);
  vtkNew<Style> style;
  style->window = this;
  style->SetDefaultRenderer(scene_.picture());
  interactor_->SetInteractorStyle(style);
  interactor_->AddObserver(vtkCommand::ExitEvent, this, &ViewerWindow::quit);
  window_->Render();  // opens it
  interactor_->Initialize();
}

void ViewerWindow::make_texts() {
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    const bool keys = i == static_cast<std::size_t>(Overlay::Keys);
    texts_[i] = make_text(keys ? kKeysLook : TextLook{static_cast<int>(22 * kTextScale), scene_.text_colour()});
    scene_.picture()->AddActor2D(texts_[i]);
  }
  for (const Overlay boxed : {Overlay::Pick, Overlay::Help, Overlay::Message}) {
    make_box(actor(boxed)->GetTextProperty());
  }
  for (const Overlay low : {Overlay::Status, Overlay::Keys, Overlay::Message}) {
    actor(low)->GetTextProperty()->SetVerticalJustificationToBottom();
  }
}

void ViewerWindow::make_ball_and_marker() {
  ball_->SetThetaResolution(64);
  ball_->SetPhiResolution(48);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball_->GetOutputPort());
  ball_actor_->SetMapper(mapper);
  set_colour(ball_actor_->GetProperty(), kBall);
  ball_actor_->GetProperty()->SetOpacity(0.35);
  ball_actor_->GetProperty()->SetAmbient(0.4);
  ball_actor_->GetProperty()->BackfaceCullingOn();
  ball_actor_->VisibilityOff();
  make_dot(marker_rim_, 7, {30, 32, 36});
  make_dot(marker_, 5, {250, 205, 20});
  scene_.picture()->AddActor(ball_actor_);
  scene_.picture()->AddActor2D(marker_rim_);
  scene_.picture()->AddActor2D(marker_);
}

void ViewerWindow::make_slider(const ViewerOptions& options) {
  slider_look_->SetMinimumValue(std::log10(options.min_radius));
  slider_look_->SetMaximumValue(std::log10(options.max_radius));
  slider_look_->SetValue(0.5 * (slider_look_->GetMinimumValue() + slider_look_->GetMaximumValue()));
  slider_look_->ShowSliderLabelOff();
  slider_look_->SetSliderLength(0.02);
  slider_look_->SetSliderWidth(0.028);
  slider_look_->SetTubeWidth(0.008);
  slider_look_->SetEndCapLength(0.004);
  slider_look_->SetEndCapWidth(0.02);
  slider_look_->GetTubeProperty()->SetColor(0.62, 0.65, 0.70);
  slider_look_->GetCapProperty()->SetColor(0.62, 0.65, 0.70);
  slider_look_->GetSliderProperty()->SetColor(0.13, 0.35, 0.65);
  slider_look_->GetSelectedProperty()->SetColor(0.85, 0.45, 0.10);
  slider_->SetInteractor(interactor_);
  slider_->SetDefaultRenderer(scene_.picture());
  slider_->SetCurrentRenderer(scene_.picture());
  slider_->SetRepresentation(slider_look_);
  slider_->SetAnimationModeToJump();
  slider_->KeyPressActivationOff();
  slider_->AddObserver(vtkCommand::InteractionEvent, this, &ViewerWindow::on_slide);
  slider_->AddObserver(vtkCommand::EndInteractionEvent, this, &ViewerWindow::on_slide_end);
  slider_->EnabledOn();
}

void ViewerWindow::layout() {
  size_ = {window_->GetSize()[0], window_->GetSize()[1]};
  const double scale = kTextScale * std::clamp(std::min(size_[0] / 1400.0, size_[1] / 900.0), 0.6, 2.0);
  scene_.layout(size_[0], size_[1], scale, 0, kBottom);
  const double height = size_[1];
  slider_look_->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider_look_->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider_look_->GetPoint1Coordinate()->SetValue(kSliderStart, kSliderHeight / height);
  slider_look_->GetPoint2Coordinate()->SetValue(kSliderEnd, kSliderHeight / height);
  slider_look_->Modified();  // else it stays where it was until its value changes
  slider_look_->BuildRepresentation();
  actor(Overlay::Status)->SetPosition(kMargin, 10);
  actor(Overlay::Keys)->SetPosition(kMargin, kKeysHeight);
  actor(Overlay::Radius)
      ->SetPosition(kSliderEnd * scene_.picture()->GetViewport()[2] * size_[0] + kMargin, kSliderHeight + 7);
  actor(Overlay::Pick)->SetPosition(kMargin, height - kMargin);
  actor(Overlay::Help)->SetPosition(0.3 * size_[0], height - kMargin);
  actor(Overlay::Message)->SetPosition(kMargin, kBottom);
  fit_keys();
}

void ViewerWindow::render() {
  const Quiet quiet;
  if (size_[0] != window_->GetSize()[0] || size_[1] != window_->GetSize()[1]) layout();
  scene_.picture()->ResetCameraClippingRange();
  window_->Render();
}

void ViewerWindow::reset_view() {
  scene_.look(camera_);
}

void ViewerWindow::run() {
  const Quiet quiet;
  render();
  // VTK's own loop on X also serves the windows that were closed before, and crashes.
  for (closed_ = false; !closed_; std::this_thread::sleep_for(kIdle)) {
    interactor_->ProcessEvents();
    events_.tick();
  }
}

void ViewerWindow::handle_events() {
  const Quiet quiet;
  interactor_->ProcessEvents();
}

void ViewerWindow::quit() {
  closed_ = true;
}

void ViewerWindow::set_text(Overlay overlay, const std::string& words) {
  std::string padded;
  for (const char c : words) padded += c == '\n' ? std::string("  \n  ") : std::string(1, c);
  const bool boxed = actor(overlay)->GetTextProperty()->GetBackgroundOpacity() > 0;
  actor(overlay)->SetInput(boxed ? ("  " + padded + "  ").c_str() : words.c_str());
  actor(overlay)->SetVisibility(words.empty() ? 0 : 1);
  words_[static_cast<std::size_t>(overlay)] = words;
}

void ViewerWindow::set_keys(const std::vector<std::string>& keys) {
  if (keys == keys_) return;
  keys_ = keys;
  fit_keys();
}

void ViewerWindow::fit_keys() {
  const int width = static_cast<int>(scene_.picture()->GetViewport()[2] * size_[0]) - 2 * kMargin;
  set_text(Overlay::Keys, fit(keys_, width, kKeysLook));
}

std::string ViewerWindow::all_texts() const {
  std::string all;
  for (const std::string& words : words_) {
    if (!words.empty()) all += (all.empty() ? "" : "\n") + words;
  }
  return all;
}

void ViewerWindow::set_slider(double radius) {
  if (radius > 0) slider_look_->SetValue(std::log10(radius));
  set_text(Overlay::Radius, std::isnan(radius) ? "move to measure" : "radius " + number_text(radius));
}

void ViewerWindow::show_ball(const Vec3& centre, double radius) {
  ball_->SetCenter(centre.x(), centre.y(), centre.z());
  ball_->SetRadius(radius);
  ball_actor_->VisibilityOn();
}

void ViewerWindow::hide_ball() {
  ball_actor_->VisibilityOff();
}

void ViewerWindow::show_marker(const Vec3& at) {
  for (vtkActor2D* dot : {marker_.Get(), marker_rim_.Get()}) {
    dot->GetPositionCoordinate()->SetValue(at.x(), at.y(), at.z());
    dot->VisibilityOn();
  }
}

void ViewerWindow::hide_marker() {
  marker_->VisibilityOff();
  marker_rim_->VisibilityOff();
}

std::optional<Vec3> ViewerWindow::position_at(int x, int y, int reach) {
  const int x0 = std::max(0, x - reach), x1 = std::min(size_[0] - 1, x + reach);
  const int y0 = std::max(0, y - reach), y1 = std::min(size_[1] - 1, y + reach);
  if (x0 > x1 || y0 > y1 || !scene_.picture()->IsInViewport(x, y)) return {};
  vtkNew<vtkFloatArray> depths;
  window_->GetZbufferData(x0, y0, x1, y1, depths);
  double best = std::numeric_limits<double>::infinity();
  Vec3 display = Vec3::Zero();
  for (vtkIdType i = 0; i < depths->GetNumberOfValues(); ++i) {
    const int width = x1 - x0 + 1;
    const int px = x0 + static_cast<int>(i) % width, py = y0 + static_cast<int>(i) / width;
    const double distance = std::hypot(px - x, py - y), depth = static_cast<double>(depths->GetValue(i));
    if (depth >= 1 || distance >= best) continue;
    best = distance;
    display = Vec3(px, py, depth);
  }
  if (!std::isfinite(best)) return {};
  double world[4];
  scene_.picture()->SetDisplayPoint(display.x(), display.y(), display.z());
  scene_.picture()->DisplayToWorld();
  scene_.picture()->GetWorldPoint(world);
  return Vec3(world[0], world[1], world[2]) / world[3];
}

Vec2 ViewerWindow::window_position(const Vec3& point) {
  scene_.picture()->SetWorldPoint(point.x(), point.y(), point.z(), 1);
  scene_.picture()->WorldToDisplay();
  const double* display = scene_.picture()->GetDisplayPoint();
  return {display[0], display[1]};
}

std::array<int, 2> ViewerWindow::mouse() const {
  return {interactor_->GetEventPosition()[0], interactor_->GetEventPosition()[1]};
}

void ViewerWindow::save_picture(const std::string& path) {
  check_picture_path(path);
  render();
  write_picture(path, window_, 1, Execution{});
}

void ViewerWindow::on_slide() {
  set_text(Overlay::Radius, "radius " + number_text(std::pow(10.0, slider_look_->GetValue())));
}

void ViewerWindow::on_slide_end() {
  events_.slide(std::pow(10.0, slider_look_->GetValue()));
}
}  // namespace kappa::view_detail
