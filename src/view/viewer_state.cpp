// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_state.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>
#include <utility>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "picture.hpp"
#include "viewer_text.hpp"

namespace kappa {
namespace {

using view_detail::Overlay;

constexpr double kRangeStep = 1.25;
constexpr int kPickReach = 6;  // pixels
constexpr auto kWaitStep = std::chrono::milliseconds(5);

void check(bool good, const std::string& message) {
  if (!good) throw Error(ErrorCode::InvalidArgument, message);
}

ViewerOptions checked(const Scan& scan, const Recompute& recompute, ViewerOptions options) {
  check(static_cast<bool>(recompute), "the viewer needs a function that computes what it shows");
  check(options.width >= 320 && options.height >= 240 && options.width <= 8192 && options.height <= 8192,
        "the window is " + std::to_string(options.width) + " x " + std::to_string(options.height) +
            " pixels; choose at least 320 x 240 and at most 8192");
  check(std::isfinite(options.max_radius) && options.min_radius > 0 && options.min_radius < options.max_radius,
        "the slider runs from radius " + std::to_string(options.min_radius) + " to " +
            std::to_string(options.max_radius) + "; it needs 0 < min_radius < max_radius");
  check(options.radius == 0 || (options.radius >= options.min_radius && options.radius <= options.max_radius),
        "the first radius is " + std::to_string(options.radius) + "; choose 0 or one between the slider's ends");
  if (bounds(scan.points).empty()) {
    throw Error(ErrorCode::InvalidData, "there is nothing to view: the scan has no point with finite coordinates");
  }
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

Viewer::Window::Window(Scan scan, Recompute recompute, ViewerOptions options)
    : scan_(std::move(scan)),
      options_(checked(scan_, recompute, std::move(options))),
      view_(scan_, options_, events()),
      computation_(std::move(recompute)) {
  view_.scene().show_plain(Execution{});
  set_radius(options_.radius);
}

view_detail::WindowEvents Viewer::Window::events() {
  return {[this](const std::string& keysym) { press(keysym); }, [this](int x, int y) { pick(x, y); },
          [this](double radius) { set_radius(radius); }, [this] { poll(); }};
}

void Viewer::Window::run() {
  refresh();
  view_.run();
}

void Viewer::Window::wait() {
  while (computation_.under_way()) {
    view_.handle_events();
    poll();
    if (computation_.under_way()) std::this_thread::sleep_for(kWaitStep);
  }
}

void Viewer::Window::update() {
  view_.handle_events();
  poll();
  refresh();
}

void Viewer::Window::set_radius(double radius) {
  check(std::isfinite(radius) && radius >= 0, "the radius is " + std::to_string(radius) + "; it cannot be negative");
  if (radius > 0) radius = std::clamp(radius, options_.min_radius, options_.max_radius);
  message_.clear();
  view_.set_slider(radius);
  computation_.start(radius);
  refresh();
}

void Viewer::Window::step_field(int step) {
  if (!has_data()) return;
  const std::size_t count = data_.fields.size();
  if (!labels_) field_ = (field_ + count + static_cast<std::size_t>(step + static_cast<int>(count))) % count;
  labels_ = false;
  paint();
}

void Viewer::Window::show_field(const std::string& name) {
  const auto found = std::find_if(data_.fields.begin(), data_.fields.end(),
                                  [&](const NamedValues& field) { return field.style.name == name; });
  check(found != data_.fields.end(), "the viewer has no field '" + name + "'");
  field_ = static_cast<std::size_t>(found - data_.fields.begin());
  labels_ = false;
  paint();
}

void Viewer::Window::toggle_labels() {
  if (data_.labels.empty()) return say("there are no labels");
  labels_ = !labels_;
  paint();
}

void Viewer::Window::scale_range(double factor) {
  check(std::isfinite(factor) && factor > 0, "the colour range cannot be scaled by " + std::to_string(factor));
  if (!has_data()) return;
  range_factors_[field_] *= factor;
  if (!labels_) view_.scene().change_range(range());
  refresh();
}

void Viewer::Window::reset_range() {
  if (has_data()) scale_range(1 / range_factors_[field_]);
}

void Viewer::Window::toggle_ball() {
  ball_ = !ball_;
  show_pick();
  if (ball_ && !picked_) return say("click on a point to see the measuring ball there");
  refresh();
}

void Viewer::Window::next_directions() {
  const DirectionFields& fields = data_.directions;
  if (fields.dir_min.empty() || fields.dir_max.empty()) return say("there are no principal directions");
  directions_ = static_cast<Directions>((static_cast<int>(directions_) + 1) % 4);
  view_.scene().show_directions(fields, directions_, Execution{});
  refresh();
}

void Viewer::Window::toggle_edges() {
  if (!scan_.is_mesh()) return say("a cloud has no edges");
  edges_ = edges_ == Edges::Hidden ? Edges::Shown : Edges::Hidden;
  view_.scene().show_edges(edges_, Execution{});
  refresh();
}

void Viewer::Window::toggle_help() {
  help_ = !help_;
  refresh();
}

void Viewer::Window::reset_view() {
  view_.reset_view();
  refresh();
}

std::optional<Index> Viewer::Window::pick(int x, int y) {
  const std::optional<Vec3> at = view_.position_at(x, y, kPickReach);
  if (!at) return {};
  Index nearest = kNoIndex;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scan_.points.size(); ++i) {
    const double distance = (scan_.points[i] - *at).squaredNorm();  // NaN is never below
    if (distance < best) {
      best = distance;
      nearest = static_cast<Index>(i);
    }
  }
  pick_point(nearest);
  return nearest;
}

void Viewer::Window::pick_point(Index point) {
  check(point < scan_.points.size() && is_finite(scan_.points[point]),
        "point " + std::to_string(point) + " cannot be picked: the scan has no such point with finite coordinates");
  picked_ = point;
  message_.clear();
  show_pick();
  refresh();
}

void Viewer::Window::clear_pick() {
  picked_.reset();
  message_.clear();
  show_pick();
  refresh();
}

void Viewer::Window::save_picture(const std::string& path) {
  view_.save_picture(path);
}

bool Viewer::Window::press(const std::string& keysym) {
  using Action = std::function<void(Window&)>;
  static const std::map<std::string, Action> kActions = {
      {"f", [](Window& w) { w.step_field(1); }},
      {"F", [](Window& w) { w.step_field(-1); }},
      {"l", [](Window& w) { w.toggle_labels(); }},
      {"bracketleft", [](Window& w) { w.scale_range(1 / kRangeStep); }},
      {"bracketright", [](Window& w) { w.scale_range(kRangeStep); }},
      {"0", [](Window& w) { w.reset_range(); }},
      {"b", [](Window& w) { w.toggle_ball(); }},
      {"d", [](Window& w) { w.next_directions(); }},
      {"e", [](Window& w) { w.toggle_edges(); }},
      {"h", [](Window& w) { w.toggle_help(); }},
      {"v", [](Window& w) { w.reset_view(); }},
      {"p", [](Window& w) { w.pick_at_mouse(); }},
      {"Escape", [](Window& w) { w.clear_pick(); }},
      {"c", [](Window& w) { w.save_numbered_picture(); }},
      {"Print", [](Window& w) { w.save_numbered_picture(); }},
      {"q", [](Window& w) { w.view_.quit(); }}};
  const auto action = kActions.find(keysym);
  if (action == kActions.end()) return false;
  try {
    action->second(*this);
  } catch (const Error& error) {
    say(error.what());
  }
  return true;
}

ViewerState Viewer::Window::state() const {
  ViewerState state;
  state.radius = data_.radius;
  if (has_data()) {
    state.field = field().style.name;
    state.range = range();
  }
  state.labels = labels_;
  state.ball = ball_;
  state.help = help_;
  state.computing = computation_.under_way();
  state.directions = directions_;
  state.picked = picked_;
  return state;
}

std::string Viewer::Window::text() const {
  std::string text = status();
  if (picked_) text += "\n" + view_detail::pick_text(scan_, data_, *picked_);
  if (help_) text += "\n" + view_detail::help_text();
  if (!message_.empty()) text += "\n" + message_;
  return text;
}

Vec2 Viewer::Window::window_position(Index point) {
  return view_.window_position(scan_.points.at(point));
}

void Viewer::Window::poll() {
  if (auto outcome = computation_.take()) {
    try {
      if (outcome->data)
        accept(std::move(*outcome->data));
      else
        say("not computed: " + outcome->error);
    } catch (const Error& error) {
      say(error.what());
    }
  } else if (computation_.under_way() && status() != status_shown_) {
    refresh();
  }
}

void Viewer::Window::accept(ViewData data) {
  check_data(data, scan_.points.size());
  data_ = std::move(data);
  range_factors_.resize(data_.fields.size(), 1.0);
  field_ = std::min(field_, data_.fields.size() - 1);
  labels_ = labels_ && !data_.labels.empty();
  if (data_.directions.dir_min.empty() || data_.directions.dir_max.empty()) directions_ = Directions::None;
  view_.scene().show_directions(data_.directions, directions_, Execution{});
  show_pick();
  paint();
}

void Viewer::Window::paint() {
  automatic_range_ = colour_range(field().values, field().style);
  if (labels_) {
    view_.scene().show_labels(data_.labels, Execution{});
  } else {
    view_.scene().show_values(field().values, field().style, range(), Execution{});
  }
  refresh();
}

void Viewer::Window::refresh() {
  status_shown_ = status();
  view_.set_text(Overlay::Status, status_shown_);
  view_.set_text(Overlay::Pick, picked_ ? view_detail::pick_text(scan_, data_, *picked_) : "");
  view_.set_text(Overlay::Help, help_ ? view_detail::help_text() : "");
  view_.set_text(Overlay::Message, message_);
  view_.render();
}

void Viewer::Window::show_pick() {
  if (picked_) {
    view_.show_marker(scan_.points[*picked_]);
  } else {
    view_.hide_marker();
  }
  if (picked_ && ball_ && data_.radius > 0) {
    view_.show_ball(scan_.points[*picked_], data_.radius);
  } else {
    view_.hide_ball();
  }
}

void Viewer::Window::save_numbered_picture() {
  std::string path;
  do {
    char name[32];
    std::snprintf(name, sizeof name, "kappa-%03d.png", ++pictures_);
    path = (std::filesystem::path(options_.picture_folder) / name).string();
  } while (std::filesystem::exists(path));
  message_.clear();
  refresh();
  view_.save_picture(path);
  say("saved " + path);
}

void Viewer::Window::pick_at_mouse() {
  const std::array<int, 2> at = view_.mouse();
  pick(at[0], at[1]);
}

void Viewer::Window::say(const std::string& message) {
  message_ = message;
  refresh();
}

ColourRange Viewer::Window::range() const {
  const ColourRange automatic = automatic_range_;
  const double factor = range_factors_[field_];
  const double middle = field().style.map == ColourMap::Diverging ? 0.0 : 0.5 * (automatic.low + automatic.high);
  return {middle + factor * (automatic.low - middle), middle + factor * (automatic.high - middle)};
}

std::string Viewer::Window::status() const {
  return view_detail::status_text(scan_, options_.file, state(), has_data() ? field().style.unit : "",
                                  computation_.progress());
}

}  // namespace kappa
