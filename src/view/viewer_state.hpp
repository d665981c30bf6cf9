// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "computation.hpp"
#include "kappa/scan/scan.hpp"
#include "viewer_window.hpp"

namespace kappa {

/// What the viewer knows and decides; its methods are those of Viewer.
class Viewer::Window {
 public:
  Window(Scan scan, Recompute recompute, ViewerOptions options);

  void run();
  void wait();
  void update();

  void set_radius(double radius);
  void step_field(int step);
  void show_field(const std::string& name);
  void toggle_labels();
  void scale_range(double factor);
  void reset_range();
  void toggle_ball();
  void next_directions();
  void toggle_edges();
  void toggle_help();
  void reset_view();
  std::optional<Index> pick(int x, int y);
  void pick_point(Index point);
  void clear_pick();
  void save_picture(const std::string& path);
  bool press(const std::string& keysym);

  ViewerState state() const;
  std::string text() const;
  Vec2 window_position(Index point);
  view_detail::ViewerWindow& view() { return view_; }

 private:
  view_detail::WindowEvents events();
  void poll();
  void accept(ViewData data);
  void paint();
  void refresh();
  void show_pick();
  void save_numbered_picture();
  void pick_at_mouse();
  void say(const std::string& message);
  bool has_data() const { return !data_.fields.empty(); }
  const NamedValues& field() const { return data_.fields[field_]; }
  ColourRange range() const;
  std::string status() const;

  Scan scan_;
  ViewerOptions options_;
  ViewData data_;  // without fields before the first result
  std::size_t field_ = 0;
  ColourRange automatic_range_;        // of that field
  std::vector<double> range_factors_;  // one a field
  bool labels_ = false, ball_ = true, help_ = false;
  Edges edges_ = Edges::Hidden;
  Directions directions_ = Directions::None;
  std::optional<Index> picked_;
  std::string message_;
  std::string status_shown_;
  int pictures_ = 0;
  view_detail::ViewerWindow view_;
  view_detail::Computation computation_;
};

}  // namespace kappa
