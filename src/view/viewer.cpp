// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/viewer.hpp"

#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/display.hpp"
#include "viewer_state.hpp"

namespace kappa {
namespace {

/// VTK would end the process on a display it cannot use.
Scan with_display(Scan scan) {
  if (!display_is_usable()) {
    throw Error(ErrorCode::Unavailable,
                "the viewer needs an X display and DISPLAY names none that works; run it in a desktop session, or "
                "draw a picture to a file instead");
  }
  return scan;
}

}  // namespace

Viewer::Viewer(Scan scan, Recompute recompute, ViewerOptions options)
    : window_(std::make_unique<Window>(with_display(std::move(scan)), std::move(recompute), std::move(options))) {}

Viewer::~Viewer() = default;

void Viewer::run() {
  window_->run();
}
void Viewer::wait() {
  window_->wait();
}
void Viewer::update() {
  window_->update();
}
void Viewer::set_radius(double radius) {
  window_->set_radius(radius);
}
void Viewer::next_field() {
  window_->step_field(1);
}
void Viewer::previous_field() {
  window_->step_field(-1);
}
void Viewer::show_field(const std::string& name) {
  window_->show_field(name);
}
void Viewer::toggle_labels() {
  window_->toggle_labels();
}
void Viewer::scale_range(double factor) {
  window_->scale_range(factor);
}
void Viewer::reset_range() {
  window_->reset_range();
}
void Viewer::toggle_ball() {
  window_->toggle_ball();
}
void Viewer::next_directions() {
  window_->next_directions();
}
void Viewer::toggle_edges() {
  window_->toggle_edges();
}
void Viewer::toggle_help() {
  window_->toggle_help();
}
void Viewer::reset_view() {
  window_->reset_view();
}
std::optional<Index> Viewer::pick(int x, int y) {
  return window_->pick(x, y);
}
void Viewer::pick_point(Index point) {
  window_->pick_point(point);
}
void Viewer::clear_pick() {
  window_->clear_pick();
}
void Viewer::save_picture(const std::string& path) {
  window_->save_picture(path);
}
bool Viewer::press(const std::string& keysym) {
  return window_->press(keysym);
}
ViewerState Viewer::state() const {
  return window_->state();
}
std::string Viewer::text() const {
  return window_->text();
}
Vec2 Viewer::window_position(Index point) const {
  return window_->window_position(point);
}
void* Viewer::interactor() {
  return window_->view().interactor();
}
void* Viewer::slider() {
  return window_->view().slider();
}

}  // namespace kappa
