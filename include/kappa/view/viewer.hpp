// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/figure.hpp"
#include "kappa/view/view_data.hpp"

namespace kappa {

/// Computes what is shown at a radius. Called on a thread of its own, one call at a time, with progress and cancel
/// set in `run`, threads = 0. What it throws is shown in the window.
using Recompute = std::function<ViewData(double radius, const Execution& run)>;

struct ViewerOptions {
  int width = 1400, height = 900;
  std::string file;       ///< name shown in the status line
  double radius = 0;      ///< shown first; units of the data, in [min_radius, max_radius], or 0
  double min_radius = 0;  ///< ends of the slider, logarithmic: 0 < min_radius < max_radius
  double max_radius = 0;
  std::optional<Camera> camera;      ///< shown first; empty for `automatic_camera`
  std::string picture_folder = ".";  ///< where the key for a picture saves kappa-001.png, kappa-002.png ...
};

/// What the window shows at the moment.
struct ViewerState {
  double radius = 0;  ///< of the data shown; 0 before the first result
  std::string field;  ///< name of the field chosen
  ColourRange range;
  bool labels = false;  ///< labels are shown instead of the field
  bool ball = true;
  bool help = false;
  bool computing = false;
  Directions directions = Directions::None;
  std::optional<Index> picked;
};

/// Interactive window on a scan or mesh: a slider for the radius that recomputes, a field or labels in colours, a
/// point picked with its values and the measuring ball.
///
/// Keys: f F next and previous field; l labels; [ ] narrow and widen the colour range, 0 automatic range; b measuring
/// ball; d principal directions (none, min, max, both); p or a click picks a point; c or Print saves a picture;
/// v resets the view; e edges; h help; Escape forgets the pick; q quits. Every key is also a method.
///
/// All methods are to be called on the thread that made the viewer. Needs a usable display: hold a VirtualDisplay
/// for tests.
class Viewer {
 public:
  /// Opens the window and starts computing for `options.radius`.
  /// @throws Error InvalidArgument (options), InvalidData (no finite point), Unavailable (no usable display).
  Viewer(Scan scan, Recompute recompute, ViewerOptions options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Runs the event loop until the window is closed or q pressed.
  void run();
  /// Handles events until no computation is under way.
  void wait();
  /// Handles the events that are there and draws.
  void update();

  /// Starts computing for a radius, 0 or clamped to the ends of the slider; a computation under way is cancelled.
  void set_radius(double radius);
  void next_field();
  void previous_field();
  /// Chooses a field by its name. @throws Error InvalidArgument if there is none of that name.
  void show_field(const std::string& name);
  void toggle_labels();
  /// Multiplies the width of the colour range; about 0 for a diverging map. `factor` > 0.
  void scale_range(double factor);
  void reset_range();
  void toggle_ball();
  void next_directions();
  void toggle_edges();
  void toggle_help();
  void reset_view();
  /// Picks the point nearest to what is drawn at a position in the window (pixels from its lower left corner), or at
  /// most six pixels from there. Returns it; without anything there the pick is kept and nothing returned.
  std::optional<Index> pick(int x, int y);
  /// @throws Error InvalidArgument if there is no such point or it is not finite.
  void pick_point(Index point);
  void clear_pick();
  /// Saves what the window shows. @throws Error FileWrite.
  void save_picture(const std::string& path);
  /// What the window does on a key, by its X keysym ("f", "bracketleft", "Escape"). False if it does nothing.
  bool press(const std::string& keysym);

  ViewerState state() const;
  /// All text of the overlays: status line, pick, help, message.
  std::string text() const;
  /// Position of a point in the window, pixels from the lower left corner.
  Vec2 window_position(Index point) const;

  /// The VTK interactor (vtkRenderWindowInteractor*), for tests that send events.
  void* interactor();
  /// The VTK slider widget (vtkSliderWidget*), for tests.
  void* slider();

 private:
  class Window;
  std::unique_ptr<Window> window_;
};

}  // namespace kappa
