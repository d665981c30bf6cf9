// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>

#include <array>
#include <chrono>
#include <functional>
#include <string>

#include "kappa/scan/scan.hpp"
#include "kappa/view/viewer.hpp"
#include "scene.hpp"

namespace kappa::view_detail {

/// What the window tells its owner about.
struct WindowEvents {
  std::function<void(const std::string& keysym)> key;
  std::function<void(int x, int y)> click;   ///< left button pressed and released at one place
  std::function<void(double radius)> slide;  ///< the slider was let go
  std::function<void()> tick;                ///< between the events of run()
};

enum class Overlay { Status, Radius, Pick, Help, Message };

/// The VTK window of the viewer with its scene, slider and texts: shows what it is told, decides nothing.
class ViewerWindow {
 public:
  ViewerWindow(const Scan& scan, const ViewerOptions& options, WindowEvents events);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  Scene& scene() { return scene_; }
  void render();
  void reset_view();
  void run();
  void handle_events();
  void quit();

  void set_text(Overlay overlay, const std::string& words);
  /// Moves the slider without an event.
  void set_slider(double radius);
  void show_ball(const Vec3& centre, double radius);
  void hide_ball();
  void show_marker(const Vec3& at);
  void hide_marker();

  /// Position in the scan of what is drawn at a place of the window or up to `reach` pixels from it.
  std::optional<Vec3> position_at(int x, int y, int reach);
  Vec2 window_position(const Vec3& point);
  std::array<int, 2> mouse() const;
  void save_picture(const std::string& path);

  vtkRenderWindowInteractor* interactor() { return interactor_; }
  vtkSliderWidget* slider() { return slider_; }
  const WindowEvents& events() const { return events_; }

 private:
  void make_window(const ViewerOptions& options);
  void make_slider(const ViewerOptions& options);
  vtkTextActor* text(Overlay overlay) { return texts_[static_cast<std::size_t>(overlay)]; }
  void make_texts();
  void make_ball_and_marker();
  void layout();
  void on_slide();
  void on_slide_end();
  void label_slider();

  WindowEvents events_;
  Camera camera_;
  Scene scene_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkSliderWidget> slider_;
  vtkNew<vtkSliderRepresentation2D> slider_look_;
  std::array<vtkSmartPointer<vtkTextActor>, 5> texts_;
  vtkNew<vtkSphereSource> ball_;
  vtkNew<vtkActor> ball_actor_;
  vtkNew<vtkActor2D> marker_, marker_rim_;
  std::array<int, 2> size_{0, 0};
  bool closed_ = false;
};

}  // namespace kappa::view_detail
