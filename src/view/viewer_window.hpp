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
#include <vector>

#include "kappa/scan/scan.hpp"
#include "kappa/view/viewer.hpp"
#include "scene.hpp"

namespace kappa::view_detail {

/// What the window calls when something happens in it.
struct WindowEvents {
  std::function<void(const std::string& keysym)> key;
  std::function<void(int x, int y)> click;   ///< the left button was pressed and released at one place
  std::function<void(double radius)> slide;  ///< the slider was let go
  std::function<void()> tick;                ///< run() has handled the events that had arrived
};

/// The texts of the window, each at a place of its own.
enum class Overlay { Status, Keys, Radius, Pick, Help, Message };

/// The VTK window of the viewer with its scene, slider and texts. It shows what it is told and decides nothing.
class ViewerWindow {
 public:
  /// Makes the geometry of the scan and opens the window. `scan` must outlive the window. @throws Cancelled.
  ViewerWindow(const Scan& scan, const ViewerOptions& options, WindowEvents events, const Execution& run);
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
  /// Shows a line of as many of the keys as fit.
  void set_keys(const std::vector<std::string>& keys);
  /// A text as it was set last.
  const std::string& text(Overlay overlay) const { return words_[static_cast<std::size_t>(overlay)]; }
  /// All texts that are not empty, a line or more each.
  std::string all_texts() const;
  /// Moves the slider without an event and shows the radius beside it. The slider, which is logarithmic, stays where it
  /// is for radius 0 and for NaN (not known); the text then says so.
  void set_slider(double radius);
  void show_ball(const Vec3& centre, double radius);
  void hide_ball();
  void show_marker(const Vec3& at);
  void hide_marker();

  /// Position in the scan of what is drawn at a place of the window (pixels from its lower left corner), or nearest to
  /// it up to `reach` pixels away. Empty if only background is there.
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
  vtkTextActor* actor(Overlay overlay) { return texts_[static_cast<std::size_t>(overlay)]; }
  void make_texts();
  void make_ball_and_marker();
  void layout();
  void on_slide();
  void on_slide_end();
  void fit_keys();

  WindowEvents events_;
  Camera camera_;
  Scene scene_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkSliderWidget> slider_;
  vtkNew<vtkSliderRepresentation2D> slider_look_;
  std::array<vtkSmartPointer<vtkTextActor>, 6> texts_;
  std::array<std::string, 6> words_;
  std::vector<std::string> keys_;
  vtkNew<vtkSphereSource> ball_;
  vtkNew<vtkActor> ball_actor_;
  vtkNew<vtkActor2D> marker_, marker_rim_;
  std::array<int, 2> size_{0, 0};
  bool closed_ = false;
};

}  // namespace kappa::view_detail
