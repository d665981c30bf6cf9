// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "computation.hpp"
#include "kappa/scan/scan.hpp"
#include "viewer_window.hpp"

namespace kappa::view_detail {

/// What a viewer knows and shows. The methods of Viewer and the keys in viewer_keys.cpp decide what is to be shown; the
/// methods here bring it into the window.
struct Session {
  /// Opens the window, still without data. `owner` gets the events of the window; it is not called before they come.
  /// @throws Error and Cancelled as the constructor of Viewer.
  Session(Viewer& owner, Scan shown, Recompute recompute, const ViewerOptions& asked, const Execution& run);

  Viewer& viewer;
  const Scan scan;
  const ViewerOptions options;          ///< with both ends of the slider
  const std::vector<StoredSet> stored;  ///< in the scan
  std::size_t set = 0;                  ///< the one of `stored` shown last
  bool stored_shown = false;            ///< `data` is that set; otherwise it was computed
  ViewData data;                        ///< without fields before the first result
  std::size_t field = 0;
  ColourRange automatic_range;                  ///< of that field
  std::map<std::string, double> range_factors;  ///< of fields whose range the user has changed, by name
  bool labels = false, ball = true, help = false;
  Edges edges = Edges::Hidden;
  Directions directions = Directions::None;
  std::optional<Index> picked;
  std::string message;
  int pictures = 0;  ///< the last number given to a picture
  ViewerWindow window;
  Computation computation;

  bool has_data() const { return !data.fields.empty(); }
  const NamedValues& shown() const { return data.fields[field]; }
  /// Place of a field in `data`, if there is one of that name.
  std::optional<std::size_t> find_field(const std::string& name) const;
  double& range_factor() { return range_factors.try_emplace(shown().style.name, 1.0).first->second; }
  ColourRange range() const;

  /// Shows a set of the scan's own fields.
  void show_set(std::size_t which);
  /// Takes over a result of the computation, if there is one, and keeps the progress in the status line up to date.
  void poll();
  /// Draws the field or the labels anew.
  void paint();
  /// Draws the marker and the ball at the picked point, or removes them.
  void show_pick();
  /// Brings the texts up to date and draws.
  void refresh();
  /// Shows a message until the next pick, radius or message.
  void say(const std::string& words);

 private:
  WindowEvents events();
  std::string status() const;
  void accept(ViewData fresh, bool from_scan);
};

}  // namespace kappa::view_detail
