// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/viewer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/display.hpp"
#include "viewer_keys.hpp"
#include "viewer_session.hpp"

namespace kappa {
namespace {

constexpr int kPickReach = 6;  // pixels
constexpr auto kWaitStep = std::chrono::milliseconds(5);

void check(bool good, const std::string& message) {
  if (!good) throw Error(ErrorCode::InvalidArgument, message);
}

void check_point(const Scan& scan, Index point) {
  check(point < scan.points.size() && is_finite(scan.points[point]),
        "point " + std::to_string(point) + " cannot be picked: the scan has no such point with finite coordinates");
}

/// VTK would end the process on a display it cannot use.
void need_display() {
  if (display_is_usable()) return;
  throw Error(ErrorCode::Unavailable,
              "the viewer needs an X display and DISPLAY names none that works; run it in a desktop session, or draw a "
              "picture to a file instead");
}

}  // namespace

Viewer::Viewer(Scan scan, Recompute recompute, ViewerOptions options, const Execution& run) {
  need_display();
  session_ = std::make_unique<view_detail::Session>(*this, std::move(scan), std::move(recompute), options, run);
  session_->window.scene().show_plain(run);
  if (session_->stored.empty()) {
    set_radius(options.radius);
  } else {
    session_->show_set(0);
  }
}

Viewer::~Viewer() = default;

void Viewer::run() {
  session_->refresh();
  session_->window.run();
}

void Viewer::wait() {
  const view_detail::Computation& computation = session_->computation;
  while (computation.under_way()) {
    session_->window.handle_events();
    session_->poll();
    if (computation.under_way()) std::this_thread::sleep_for(kWaitStep);
  }
}

void Viewer::update() {
  session_->window.handle_events();
  session_->poll();
  session_->refresh();
}

bool Viewer::press(const std::string& keysym) {
  try {
    return view_detail::press_key(*session_, keysym);
  } catch (const Error& error) {
    session_->say(error.what());
    return true;
  }
}

void Viewer::set_radius(double radius) {
  check(std::isfinite(radius) && radius >= 0, "the radius is " + std::to_string(radius) + "; it cannot be negative");
  const ViewerOptions& options = session_->options;
  if (radius > 0) radius = std::clamp(radius, options.min_radius, options.max_radius);
  session_->message.clear();
  session_->window.set_slider(radius);
  session_->computation.start(radius);
  session_->refresh();
}

void Viewer::show_field(const std::string& name) {
  const auto found = session_->find_field(name);
  check(found.has_value(), "the viewer has no field '" + name + "'");
  session_->field = *found;
  session_->labels = false;
  session_->paint();
}

std::optional<Index> Viewer::pick(int x, int y) {
  const std::optional<Vec3> at = session_->window.position_at(x, y, kPickReach);
  if (!at) return {};
  const std::vector<Vec3>& points = session_->scan.points;
  Index nearest = kNoIndex;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = (points[i] - *at).squaredNorm();  // NaN is never below
    if (distance < best) {
      best = distance;
      nearest = static_cast<Index>(i);
    }
  }
  pick_point(nearest);
  return nearest;
}

void Viewer::pick_point(Index point) {
  check_point(session_->scan, point);
  session_->picked = point;
  session_->message.clear();
  session_->show_pick();
  session_->refresh();
}

void Viewer::save_picture(const std::string& path) {
  session_->window.save_picture(path);
}

ViewerState Viewer::state() const {
  const view_detail::Session& s = *session_;
  ViewerState state;
  state.radius = s.data.radius;
  state.stored = s.stored_shown;
  if (s.has_data()) {
    state.field = s.shown().style.name;
    state.range = s.range();
  }
  state.labels = s.labels;
  state.ball = s.ball;
  state.help = s.help;
  state.computing = s.computation.under_way();
  state.directions = s.directions;
  state.picked = s.picked;
  return state;
}

std::string Viewer::text() const {
  return session_->window.all_texts();
}

Vec2 Viewer::window_position(Index point) const {
  check_point(session_->scan, point);
  return session_->window.window_position(session_->scan.points[point]);
}

void* Viewer::interactor() {
  return session_->window.interactor();
}

void* Viewer::slider() {
  return session_->window.slider();
}

}  // namespace kappa
