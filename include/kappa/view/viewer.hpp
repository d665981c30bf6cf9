// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/figure.hpp"
#include "kappa/view/view_data.hpp"

namespace kappa {

namespace view_detail {
struct Session;
}

/// Computes what the viewer shows at a radius. The viewer calls it on a thread of its own, one call at a time. In
/// `run`, threads are those the viewer was made with, progress moves the percentage in the status line, and
/// cancel is raised when another radius is asked for or the viewer ends. The window shows the message of what it
/// throws.
using Recompute = std::function<ViewData(double radius, const Execution& run)>;

struct ViewerOptions {
  int width = 1400, height = 900;  ///< of the window in pixels: at least 320 x 240, at most 8192 x 8192
  std::string file;                ///< path of the file that is shown; the window shows its name without the folders
  /// In units of the data; computed first if the scan holds no curvatures. 0 (which `recompute` gets as it is) or a
  /// radius between the ends of the slider.
  double radius = 0;
  /// Ends of the slider, in units of the data; the slider is logarithmic.
  double min_radius = 0;             ///< 0: the median distance of neighbouring points
  double max_radius = 0;             ///< 0: a quarter of the diagonal of the bounding box, at least twice min_radius
  std::optional<Camera> camera;      ///< of the first view; empty for `automatic_camera`
  std::string picture_folder = ".";  ///< where the key c saves kappa-001.png, kappa-002.png ...
};

/// What the window shows at the moment.
struct ViewerState {
  double radius = 0;    ///< of the data shown; 0 before the first result, NaN if a file does not tell it
  bool stored = false;  ///< the data shown are fields of the scan; otherwise they were computed
  std::string field;    ///< name of the field chosen; empty before the first result
  ColourRange range;    ///< of that field
  bool labels = false;  ///< the labels are shown in place of the field
  bool ball = true;     ///< the measuring ball is shown at the picked point
  bool help = false;    ///< the full list of the keys is shown
  bool computing = false;
  Directions directions = Directions::None;
  std::optional<Index> picked;
};

/// The mouse and the keys of the viewer, one line each ("  f, F            shows the next, the previous field"), with a
/// heading. The window shows the same list on the key h.
std::string viewer_keys();

/// An interactive window on a scan or mesh. It shows a field or the labels in colours, the values and the measuring
/// ball of a picked point, and a slider for the radius. When the slider is let go, the data are computed anew.
///
/// Each action of the user is a key: `viewer_keys` lists them, the window shows the most important ones, `press` does
/// what they do.
///
/// Call all methods on the thread that made the viewer. The viewer needs an X display that can draw; tests hold a
/// VirtualDisplay.
class Viewer {
 public:
  /// Opens the window. If the scan holds curvatures (see `stored_sets`), the window shows its first set and computes
  /// nothing until the slider is moved; otherwise it starts computing for `options.radius`.
  ///
  /// `run.threads` also holds for all calls of `recompute`; `run.cancel` and `run.progress` hold until
  /// the constructor returns.
  /// @throws Error InvalidArgument (an option, or no `recompute`), InvalidData (no point with finite coordinates, or
  /// all at one place and no ends of the slider given), Unavailable (no usable display); Cancelled.
  Viewer(Scan scan, Recompute recompute, ViewerOptions options, const Execution& run = {});
  /// Cancels a computation that is under way, waits for its end, and closes the window.
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  /// Handles events until the user closes the window or presses q.
  void run();
  /// Handles events until no computation is under way.
  void wait();
  /// Handles the events that have arrived, takes over a finished result, and draws.
  void update();

  /// Does what a key does; `keysym` is its X name ("f", "bracketleft", "Escape"). An error becomes a message in the
  /// window. Returns false if the key has no meaning.
  bool press(const std::string& keysym);
  /// Starts computing for a radius and cancels a computation under way. A radius above 0 is brought between the ends of
  /// the slider. @throws Error InvalidArgument if the radius is negative or not finite.
  void set_radius(double radius);
  /// Shows the field of that name. @throws Error InvalidArgument if there is none.
  void show_field(const std::string& name);
  /// Picks the point nearest to what is drawn at a position in the window (pixels from its lower left corner) or up to
  /// six pixels from it, and returns the point. Where nothing is drawn, returns nothing and keeps the last pick.
  std::optional<Index> pick(int x, int y);
  /// Picks a point. @throws Error InvalidArgument if there is no such point or it is not finite.
  void pick_point(Index point);
  /// Saves what the window shows as a PNG file. @throws Error FileWrite.
  void save_picture(const std::string& path);

  ViewerState state() const;
  /// All texts of the window except the legend: status line, keys, slider, picked point, help, message.
  std::string text() const;
  /// Position of a point in the window, in pixels from its lower left corner.
  /// @throws Error InvalidArgument if there is no such point or it is not finite.
  Vec2 window_position(Index point) const;

  /// The VTK interactor (vtkRenderWindowInteractor*), for tests that send events.
  void* interactor();
  /// The VTK slider widget (vtkSliderWidget*), for tests.
  void* slider();

 private:
  std::unique_ptr<view_detail::Session> session_;
};

}  // namespace kappa
