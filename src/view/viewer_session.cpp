// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "discs.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "viewer_keys.hpp"
#include "viewer_text.hpp"

namespace kappa::view_detail {
namespace {

void check(bool good, const std::string& message) {
  if (!good) throw Error(ErrorCode::InvalidArgument, message);
}

/// The options with ends of the slider that suit the scan where none are given.
ViewerOptions with_slider_ends(ViewerOptions options, const Scan& scan, const Execution& run) {
  const double diagonal = bounds(scan.points).diagonal();
  if ((options.min_radius == 0 || options.max_radius == 0) && !(diagonal > 0))
    throw Error(ErrorCode::InvalidData, "all points are at one place, so that no radius can be chosen from them");
  if (options.min_radius == 0) options.min_radius = median_spacing(scan.points, run);
  if (options.max_radius == 0) options.max_radius = std::max(0.25 * diagonal, 2 * options.min_radius);
  return options;
}

ViewerOptions checked(const Scan& scan, const Recompute& recompute, const ViewerOptions& asked, const Execution& run) {
  check(static_cast<bool>(recompute), "the viewer needs a function that computes what it shows");
  check(asked.width >= 320 && asked.height >= 240 && asked.width <= 8192 && asked.height <= 8192,
        "the window is " + std::to_string(asked.width) + " x " + std::to_string(asked.height) +
            " pixels; choose at least 320 x 240 and at most 8192");
  if (bounds(scan.points).empty())
    throw Error(ErrorCode::InvalidData, "there is nothing to view: the scan has no point with finite coordinates");
  ViewerOptions options = with_slider_ends(asked, scan, run);
  check(std::isfinite(options.max_radius) && options.min_radius > 0 && options.min_radius < options.max_radius,
        "the slider runs from radius " + std::to_string(options.min_radius) + " to " +
            std::to_string(options.max_radius) + "; it needs 0 < min_radius < max_radius");
  check(options.radius == 0 || (options.radius >= options.min_radius && options.radius <= options.max_radius),
        "the first radius is " + std::to_string(options.radius) + "; choose 0 or one between the slider's ends");
  return options;
}

void check_data(const ViewData& data, std::size_t points) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == points; };
  bool good = !data.fields.empty() && fits(data.labels.size()) && fits(data.status.size()) &&
              fits(data.directions.dir_min.size()) && fits(data.directions.dir_max.size());
  for (const NamedValues& field : data.fields) good = good && field.values.size() == points;
  check(good, "the data computed for the viewer do not have one value a point");
}

}  // namespace

Session::Session(Viewer& owner, Scan shown, Recompute recompute, const ViewerOptions& asked, const Execution& run)
    : viewer(owner),
      scan(std::move(shown)),
      options(checked(scan, recompute, asked, stage(run, 0.0, 0.3))),
      stored(stored_sets(scan)),
      window(scan, options, events(), stage(run, 0.3, 1.0)),
      computation(std::move(recompute), run) {}

WindowEvents Session::events() {
  return {[this](const std::string& keysym) { viewer.press(keysym); }, [this](int x, int y) { viewer.pick(x, y); },
          [this](double radius) { viewer.set_radius(radius); }, [this] { poll(); }};
}

std::optional<std::size_t> Session::find_field(const std::string& name) const {
  for (std::size_t i = 0; i < data.fields.size(); ++i) {
    if (data.fields[i].style.name == name) return i;
  }
  return {};
}

ColourRange Session::range() const {
  const auto found = range_factors.find(shown().style.name);
  const double factor = found == range_factors.end() ? 1.0 : found->second;
  const double middle =
      shown().style.map == ColourMap::Diverging ? 0.0 : 0.5 * (automatic_range.low + automatic_range.high);
  return {middle + factor * (automatic_range.low - middle), middle + factor * (automatic_range.high - middle)};
}

void Session::show_set(std::size_t which) {
  set = which;
  message.clear();
  window.set_slider(stored[set].radius);
  accept(stored_data(scan, stored[set]), true);
}

void Session::poll() {
  if (auto outcome = computation.take()) {
    try {
      if (outcome->data)
        accept(std::move(*outcome->data), false);
      else
        say("not computed: " + outcome->error);
    } catch (const Error& error) {
      say(error.what());
    }
  } else if (computation.under_way() && status() != window.text(Overlay::Status)) {
    refresh();
  }
}

void Session::accept(ViewData fresh, bool from_scan) {
  check_data(fresh, scan.points.size());
  const std::string name = has_data() ? shown().style.name : "";
  data = std::move(fresh);
  stored_shown = from_scan;
  field = find_field(name).value_or(0);
  labels = labels && !data.labels.empty();
  if (data.directions.dir_min.empty() || data.directions.dir_max.empty()) directions = Directions::None;
  window.scene().show_directions(data.directions, directions, Execution{});
  show_pick();
  paint();
}

void Session::paint() {
  automatic_range = colour_range(shown().values, shown().style);
  if (labels) {
    window.scene().show_labels(data.labels, Execution{});
  } else {
    window.scene().show_values(shown().values, shown().style, range(), Execution{});
  }
  refresh();
}

void Session::show_pick() {
  if (picked) {
    window.show_marker(scan.points[*picked]);
  } else {
    window.hide_marker();
  }
  if (picked && ball && data.radius > 0) {
    window.show_ball(scan.points[*picked], data.radius);
  } else {
    window.hide_ball();
  }
}

void Session::refresh() {
  window.set_text(Overlay::Status, status());
  window.set_text(Overlay::Pick, picked ? pick_text(scan, data, *picked) : "");
  window.set_text(Overlay::Help, help ? help_text() : "");
  window.set_text(Overlay::Message, message);
  window.set_keys(help ? std::vector<std::string>() : key_line());
  window.render();
}

void Session::say(const std::string& words) {
  message = words;
  refresh();
}

std::string Session::status() const {
  return status_text(scan, options.file, viewer.state(), has_data() ? shown().style.unit : "", computation.progress());
}

}  // namespace kappa::view_detail
