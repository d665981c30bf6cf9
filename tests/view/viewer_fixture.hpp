// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>

#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/display.hpp"
#include "kappa/view/viewer.hpp"
#include "picture_reader.hpp"

namespace kappa::test {

inline constexpr int kRows = 24, kColumns = 48;

/// Unit sphere at UTM-sized coordinates; point 0 is the first of the southernmost ring below the equator.
inline Scan sphere() {
  Scan scan;
  scan.origin = Vec3(500000, 5400000, 100);
  for (int i = 0; i < kRows; ++i) {
    const double latitude = kPi * ((i + 0.5) / kRows - 0.5);
    for (int j = 0; j < kColumns; ++j) {
      const double longitude = 2 * kPi * j / kColumns;
      scan.points.emplace_back(std::cos(latitude) * std::sin(longitude), -std::cos(latitude) * std::cos(longitude),
                               std::sin(latitude));
    }
  }
  scan.normals = scan.points;
  for (Index i = 0; i + 1 < kRows; ++i) {
    for (Index j = 0; j < kColumns; ++j) {
      const Index next = (j + 1) % kColumns;
      scan.faces.add({i * kColumns + j, i * kColumns + next, (i + 1) * kColumns + next, (i + 1) * kColumns + j});
    }
  }
  return scan;
}

/// Fields that tell the radius they belong to: "height" is z / radius.
inline ViewData data_for(const Scan& scan, double radius) {
  ViewData data;
  data.radius = radius;
  NamedValues height{{"height", "1/m", ColourMap::Diverging, {}, 100}, {}};
  NamedValues east{{"east", "m", ColourMap::Sequential, {}, 100}, {}};
  for (const Vec3& x : scan.points) {
    height.values.push_back(x.z() / radius);
    east.values.push_back(x.x());
    data.labels.push_back(x.z() > 0 ? Label::Convex : Label::Saddle);
    data.directions.dir_min.push_back(x.cross(Vec3::UnitZ()).normalized());
    data.directions.dir_max.push_back(x.cross(data.directions.dir_min.back()));
  }
  data.status.assign(scan.points.size(), PointStatus::Valid);
  data.status[5] = PointStatus::Degenerate;
  height.values[5] = kNaN;
  data.fields = {height, east};
  return data;
}

class ViewerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.width = 700;
    options_.height = 500;
    options_.file = "some/folder/sphere.ply";
    options_.radius = 0.5;
    options_.min_radius = 0.1;
    options_.max_radius = 10;
    options_.camera = Camera{-35, 22, 1, UpAxis::Z};
    options_.picture_folder = folder_ / "";
    open(scan_);
    viewer_->wait();
    // The nearest point to the eye, which the automatic view has in the middle of the window.
    double best = -2;
    for (std::size_t i = 0; i < scan_.points.size(); ++i) {
      const double a = -35 * kPi / 180, e = 22 * kPi / 180;
      const double near = scan_.points[i].dot(Vec3(std::cos(e) * std::sin(a), -std::cos(e) * std::cos(a), std::sin(e)));
      if (near > best) {
        best = near;
        front_ = static_cast<Index>(i);
      }
    }
  }

  void open(const Scan& scan) {
    viewer_.reset();
    viewer_ = std::make_unique<Viewer>(
        scan, [this](double radius, const Execution& run) { return compute(radius, run); }, options_);
  }

  ViewData compute(double radius, const Execution& run) {
    ++computed_;
    threads_ = run.threads;
    if (hold_) run.progress(0.5);
    half_done_ = hold_.load();
    while (hold_) {
      if (run.cancel->load()) ++cancelled_;
      check_cancelled(run);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (radius == 7) throw Error(ErrorCode::InvalidData, "seven is refused");
    return data_for(scan_, radius);
  }

  vtkRenderWindowInteractor* interactor() { return static_cast<vtkRenderWindowInteractor*>(viewer_->interactor()); }

  /// A key pressed in the window, as X reports it.
  void key(const char* keysym, char code = 0) {
    interactor()->SetKeyEventInformation(0, 0, code, 1, keysym);
    interactor()->InvokeEvent(vtkCommand::KeyPressEvent);
    interactor()->InvokeEvent(vtkCommand::CharEvent);
    interactor()->InvokeEvent(vtkCommand::KeyReleaseEvent);
  }

  void mouse(int x, int y, unsigned long event) {
    interactor()->SetEventInformation(x, y);
    interactor()->InvokeEvent(event);
  }

  Picture shot() {
    const std::string path = folder_ / ("shot" + std::to_string(++shots_) + ".png");
    viewer_->save_picture(path);
    return read_picture(path);
  }

  /// Once the window shows the second result.
  void end_by_key() {
    if (viewer_->state().radius == 2) key("q", 'q');
  }
  void end_by_closing() {
    if (viewer_->state().radius == 2) interactor()->InvokeEvent(vtkCommand::ExitEvent);
  }

  /// Waits for what another thread does; the time that test programs have is the only limit.
  static void wait_for(const std::function<bool()>& condition) {
    while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  bool says(const std::string& words) const { return viewer_->text().find(words) != std::string::npos; }

  const VirtualDisplay display_;
  TemporaryFolder folder_;
  const Scan scan_ = sphere();
  ViewerOptions options_;
  std::atomic<bool> hold_{false};
  std::atomic<bool> half_done_{false};
  std::atomic<int> computed_{0}, cancelled_{0}, threads_{-1};
  std::unique_ptr<Viewer> viewer_;
  Index front_ = 0;
  int shots_ = 0;
};

}  // namespace kappa::test
