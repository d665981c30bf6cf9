// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_fixture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>
#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

using test::differing_pixels;
using test::kColumns;
using test::kRows;
using test::Picture;
using test::sphere;
using test::ViewerTest;

TEST_F(ViewerTest, ShowsTheFirstResult) {
  const ViewerState state = viewer_->state();
  EXPECT_EQ(0.5, state.radius);
  EXPECT_EQ("height", state.field);
  EXPECT_FALSE(state.computing);
  EXPECT_NEAR(2 * std::cos(0.5 * kPi / kRows), state.range.high, 1e-9);
  EXPECT_FALSE(state.stored);
  EXPECT_EQ(0U, viewer_->text().rfind("sphere.ply  |  ", 0)) << "the name of the file, not its path";
  EXPECT_FALSE(says("folder"));
  EXPECT_TRUE(says("1 152 points, 1 104 faces"));
  EXPECT_TRUE(says("radius 0.5"));
  const Picture picture = shot();
  EXPECT_EQ(options_.width, picture.width);
  EXPECT_GT(picture.count([](Rgb c) { return c.b > c.r + 60; }), 2000);
  EXPECT_GT(picture.count([](Rgb c) { return c.r > c.b + 60; }), 2000);
}

TEST_F(ViewerTest, KeysGoThroughTheWindow) {
  const Picture before = shot();
  key("f", 'f');
  EXPECT_EQ("east", viewer_->state().field);
  EXPECT_GT(differing_pixels(before, shot()), 5000);
  key("f", 'f');
  EXPECT_EQ("height", viewer_->state().field);
  EXPECT_EQ(0, differing_pixels(before, shot()));
  key("F", 'F');
  EXPECT_EQ("east", viewer_->state().field);
  key("l", 'l');
  EXPECT_TRUE(viewer_->state().labels);
  EXPECT_TRUE(says("|  labels"));
  key("l", 'l');
  EXPECT_FALSE(says("measuring ball"));
  key("h", 'h');
  EXPECT_TRUE(viewer_->state().help);
  EXPECT_TRUE(says("measuring ball"));
  key("b", 'b');
  EXPECT_FALSE(viewer_->state().ball);
  key("d", 'd');
  EXPECT_EQ(Directions::Min, viewer_->state().directions);
  EXPECT_FALSE(viewer_->press("F12"));
}

/// Names that X gives the keys of a line of the help such as "  f, F            shows ...".
std::vector<std::string> keysyms(const std::string& line) {
  std::vector<std::string> names;
  std::string inputs = line.substr(0, line.find("  ", 2));
  for (char& c : inputs) c = c == ',' ? ' ' : c;
  std::istringstream words(inputs);
  for (std::string word; words >> word;)
    names.push_back(word == "[" ? "bracketleft" : word == "]" ? "bracketright" : word);
  return names;
}

TEST_F(ViewerTest, EveryKeyOfTheHelpHasAMeaningAndEveryKeyIsInTheHelp) {
  std::set<std::string> known;
  std::istringstream help(viewer_keys());
  std::string line;
  ASSERT_TRUE(std::getline(help, line)) << "a heading";
  while (std::getline(help, line)) {
    ASSERT_EQ(0U, line.rfind("  ", 0)) << line;
    for (const std::string& name : keysyms(line)) known.insert(name);
  }
  for (const char* word : {"drag", "Shift", "+", "wheel", "slider", "click"}) EXPECT_EQ(1U, known.erase(word)) << word;
  options_.picture_folder = folder_ / "";
  for (const std::string& name : known) EXPECT_TRUE(viewer_->press(name)) << name;
  EXPECT_EQ(18U, known.size());
  std::vector<std::string> others = {"bracketleft", "bracketright", "Escape", "Print", "Return", "space", "Tab", "F1"};
  for (char c = '!'; c <= '~'; ++c) others.emplace_back(1, c);
  for (const std::string& name : others) EXPECT_EQ(known.count(name) == 1, viewer_->press(name)) << name;
}

TEST_F(ViewerTest, KeysAreOnTheScreenFromTheStart) {
  EXPECT_TRUE(says("h  all keys"));
  EXPECT_TRUE(says("f F  field"));
  EXPECT_FALSE(says("shows the next"));
  const Picture line = shot();
  viewer_->press("h");
  EXPECT_FALSE(says("h  all keys")) << "the full list takes the place of the line";
  EXPECT_TRUE(says("f, F:  shows the next, the previous field"));
  const Picture list = shot();
  // The line of keys is above the status line, the list at the top.
  const auto grey = [](Rgb c) { return c.r < 170 && c.g < 175 && c.b < 180; };
  EXPECT_GT(line.count(0, 30, options_.width / 2, 48, grey), 200);
  EXPECT_EQ(0, list.count(0, 30, options_.width / 2, 48, grey));
  const auto white = [](Rgb c) { return c.r > 248 && c.g > 248 && c.b > 248; };
  EXPECT_EQ(0, line.count(0, options_.height / 2, options_.width, options_.height, white));
  EXPECT_GT(list.count(0, options_.height / 2, options_.width, options_.height, white), 10000);
  viewer_->press("h");
  EXPECT_EQ(0, differing_pixels(line, shot()));
}

TEST_F(ViewerTest, ASmallWindowShowsTheKeysThatFit) {
  options_.width = 320;
  options_.height = 240;
  open(scan_);
  viewer_->wait();
  EXPECT_TRUE(says("h  all keys"));
  EXPECT_FALSE(says("q  quit"));
}

TEST_F(ViewerTest, KeysOfVtkDoNothing) {
  const Picture before = shot();
  for (const char* name : {"w", "s", "r", "3", "j", "t", "a", "i"}) key(name, name[0]);
  EXPECT_EQ(0, differing_pixels(before, shot()));
}

TEST_F(ViewerTest, LabelsHaveTheirColours) {
  viewer_->press("l");
  const Picture picture = shot();
  const auto is_green = [](Rgb c) { return c.g > c.r + 50 && c.g > c.b + 50; };
  const auto is_red = [](Rgb c) { return c.r > c.g + 50 && c.r > c.b + 50; };
  EXPECT_GT(picture.count(is_green), 2000);
  EXPECT_GT(picture.count(is_red), 2000);
}

TEST_F(ViewerTest, ColourRange) {
  const ColourRange automatic = viewer_->state().range;
  const Picture before = shot();
  key("bracketleft", '[');
  EXPECT_NEAR(automatic.high / 1.25, viewer_->state().range.high, 1e-12);
  EXPECT_NEAR(automatic.low / 1.25, viewer_->state().range.low, 1e-12);
  EXPECT_GT(differing_pixels(before, shot()), 1000);
  key("bracketright", ']');
  EXPECT_NEAR(automatic.high, viewer_->state().range.high, 1e-12);
  for (int i = 0; i < 5; ++i) viewer_->press("bracketright");
  EXPECT_NEAR(std::pow(1.25, 5) * automatic.high, viewer_->state().range.high, 1e-12);
  key("0", '0');
  EXPECT_NEAR(automatic.high, viewer_->state().range.high, 1e-12);
}

TEST_F(ViewerTest, AColourRangeKeepsTwoEnds) {
  options_.width = 320;
  options_.height = 240;
  open(scan_);
  viewer_->wait();
  const double automatic = viewer_->state().range.high;
  for (int i = 0; i < 70; ++i) viewer_->press("bracketright");
  EXPECT_NEAR(1e6 * automatic, viewer_->state().range.high, 1e-3);
  for (int i = 0; i < 130; ++i) viewer_->press("bracketleft");
  EXPECT_NEAR(1e-6 * automatic, viewer_->state().range.high, 1e-15);
}

TEST_F(ViewerTest, SliderRecomputesWhenLetGo) {
  auto* slider = static_cast<vtkSliderWidget*>(viewer_->slider());
  auto* look = vtkSliderRepresentation2D::SafeDownCast(slider->GetRepresentation());
  const int before = computed_;
  // Drag the bead to the right end with the mouse; positions in pixels of the window.
  const int* from = look->GetPoint1Coordinate()->GetComputedDisplayValue(slider->GetCurrentRenderer());
  const int x0 = from[0], y = from[1];
  const int x1 = look->GetPoint2Coordinate()->GetComputedDisplayValue(slider->GetCurrentRenderer())[0];
  const double t = (std::log10(0.5) + 1) / 2;
  mouse(static_cast<int>(x0 + t * (x1 - x0)), y, vtkCommand::LeftButtonPressEvent);
  mouse(x0 + 3 * (x1 - x0) / 4, y, vtkCommand::MouseMoveEvent);
  EXPECT_EQ(before, computed_) << "computes while the slider moves";
  EXPECT_FALSE(viewer_->state().picked);
  mouse(x0 + 3 * (x1 - x0) / 4, y, vtkCommand::LeftButtonReleaseEvent);
  viewer_->wait();
  EXPECT_EQ(before + 1, computed_);
  // Three quarters of the way from 0.1 to 10 on the logarithmic scale.
  EXPECT_NEAR(std::log10(std::pow(10, 0.5)), std::log10(viewer_->state().radius), 0.08);
  EXPECT_NEAR(1 / viewer_->state().radius, viewer_->state().range.high, 0.01);
  EXPECT_FALSE(viewer_->state().picked) << "the slider is not the scan";
}

TEST_F(ViewerTest, ComputingIsShownAndSuperseded) {
  hold_ = true;
  viewer_->set_radius(2);
  EXPECT_TRUE(viewer_->state().computing);
  EXPECT_TRUE(says("computing"));
  EXPECT_EQ(0.5, viewer_->state().radius);
  wait_for([&] { return half_done_.load(); });
  viewer_->update();
  EXPECT_TRUE(says("50 %"));
  key("f", 'f');
  EXPECT_EQ("east", viewer_->state().field) << "the window is alive";
  viewer_->set_radius(3);
  wait_for([&] { return cancelled_ == 1; });
  hold_ = false;
  viewer_->wait();
  EXPECT_EQ(3, viewer_->state().radius);
  EXPECT_FALSE(says("computing"));
}

TEST_F(ViewerTest, WhatCannotBeComputedIsSaid) {
  viewer_->set_radius(7);
  viewer_->wait();
  EXPECT_TRUE(says("seven is refused"));
  EXPECT_EQ(0.5, viewer_->state().radius);
  viewer_->set_radius(1e9);
  viewer_->wait();
  EXPECT_EQ(10, viewer_->state().radius);
  EXPECT_THROW(viewer_->set_radius(-1), Error);
}

TEST_F(ViewerTest, ClickPicksThePointUnderTheMouse) {
  const Vec2 at = viewer_->window_position(front_);
  const int x = static_cast<int>(std::lround(at.x())), y = static_cast<int>(std::lround(at.y()));
  mouse(x, y, vtkCommand::LeftButtonPressEvent);
  mouse(x, y, vtkCommand::LeftButtonReleaseEvent);
  ASSERT_TRUE(viewer_->state().picked);
  EXPECT_EQ(front_, *viewer_->state().picked);
  EXPECT_TRUE(says("point " + std::to_string(front_)));
  EXPECT_TRUE(says("status: valid"));
  EXPECT_TRUE(says("label: convex"));
  EXPECT_TRUE(says("x  49999"));
  EXPECT_TRUE(says("height  "));
  key("Escape");
  EXPECT_FALSE(viewer_->state().picked);
  mouse(x, y, vtkCommand::MouseMoveEvent);
  key("p", 'p');
  EXPECT_EQ(front_, viewer_->state().picked);
}

TEST_F(ViewerTest, HiddenPointsAndBackgroundAreNotPicked) {
  EXPECT_FALSE(viewer_->pick(3, options_.height / 2));
  EXPECT_FALSE(viewer_->state().picked);
  // The antipode of the front point is behind it in the window.
  Index back = 0;
  for (std::size_t i = 0; i < scan_.points.size(); ++i) {
    if ((scan_.points[i] + scan_.points[front_]).norm() < 1e-9) back = static_cast<Index>(i);
  }
  const Vec2 at = viewer_->window_position(back);
  const auto picked = viewer_->pick(static_cast<int>(at.x()), static_cast<int>(at.y()));
  ASSERT_TRUE(picked);
  EXPECT_GT(scan_.points[*picked].dot(scan_.points[front_]), 0.8);
}

TEST_F(ViewerTest, ADragTurnsAndDoesNotPick) {
  const Picture before = shot();
  const Vec2 at = viewer_->window_position(front_);
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  mouse(x, y, vtkCommand::LeftButtonPressEvent);
  mouse(x + 60, y + 30, vtkCommand::MouseMoveEvent);
  mouse(x + 60, y + 30, vtkCommand::LeftButtonReleaseEvent);
  EXPECT_FALSE(viewer_->state().picked);
  EXPECT_GT(differing_pixels(before, shot()), 5000);
  key("v", 'v');
  EXPECT_EQ(0, differing_pixels(before, shot()));
}

TEST_F(ViewerTest, NoValueAndStatusOfAPickedPoint) {
  viewer_->pick_point(5);
  EXPECT_TRUE(says("status: degenerate"));
  EXPECT_TRUE(says("height  no value"));
  EXPECT_TRUE(says("label: saddle"));
  EXPECT_THROW(viewer_->pick_point(100000), Error);
}

TEST_F(ViewerTest, MeasuringBallIsAsLargeAsTheRadius) {
  viewer_->pick_point(front_);
  viewer_->press("b");
  const Picture without = shot();
  viewer_->press("b");
  const Picture with = shot();
  const int ball = differing_pixels(without, with);
  const double scale = (viewer_->window_position(front_) - viewer_->window_position(front_ + 1)).norm() /
                       (scan_.points[front_] - scan_.points[front_ + 1]).norm();
  const double disc = kPi * std::pow(0.5 * scale, 2);
  EXPECT_NEAR(disc, ball, 0.2 * disc);
  viewer_->set_radius(0.25);
  viewer_->wait();
  viewer_->press("b");
  const Picture none = shot();
  viewer_->press("b");
  EXPECT_NEAR(0.25, static_cast<double>(differing_pixels(none, shot())) / ball, 0.05);
}

TEST_F(ViewerTest, DirectionsEdgesAndHelpAreDrawn) {
  const Picture before = shot();
  viewer_->press("d");
  EXPECT_GT(differing_pixels(before, shot()), 300);
  for (int i = 0; i < 3; ++i) viewer_->press("d");
  EXPECT_EQ(0, differing_pixels(before, shot()));
  key("e", 'e');
  EXPECT_GT(differing_pixels(before, shot()), 1000);
  key("e", 'e');
  viewer_->press("h");
  EXPECT_GT(differing_pixels(before, shot()), 3000);
}

TEST_F(ViewerTest, PictureKeyNumbersItsFiles) {
  key("c", 'c');
  key("c", 'c');
  EXPECT_TRUE(std::filesystem::exists(folder_ / "kappa-001.png"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "kappa-002.png"));
  EXPECT_TRUE(says("kappa-002.png"));
  EXPECT_THROW(viewer_->save_picture(folder_ / "none/x.png"), Error);
}

TEST_F(ViewerTest, RunsAndShowsResultsUntilQ) {
  interactor()->GetRenderWindow()->AddObserver(vtkCommand::EndEvent, this,
                                               &ViewerTest_RunsAndShowsResultsUntilQ_Test::end_by_key);
  viewer_->set_radius(2);
  viewer_->run();
  EXPECT_EQ(2, viewer_->state().radius);
}

TEST_F(ViewerTest, RunsUntilTheWindowIsClosed) {
  interactor()->GetRenderWindow()->AddObserver(vtkCommand::EndEvent, this,
                                               &ViewerTest_RunsUntilTheWindowIsClosed_Test::end_by_closing);
  viewer_->set_radius(2);
  viewer_->run();
  EXPECT_EQ(2, viewer_->state().radius);
}

TEST_F(ViewerTest, TheExecutionReachesTheComputation) {
  Execution run;
  run.threads = 3;
  viewer_ = std::make_unique<Viewer>(
      scan_, [this](double radius, const Execution& given) { return compute(radius, given); }, options_, run);
  viewer_->wait();
  EXPECT_EQ(3, threads_);
  std::atomic<bool> stop{true};
  run.cancel = &stop;
  const int before = computed_;
  const auto compute_nothing = [](double, const Execution&) { return ViewData(); };
  EXPECT_THROW(Viewer(scan_, compute_nothing, options_, run), Cancelled);
  EXPECT_EQ(before, computed_);
}

TEST_F(ViewerTest, TheSliderHasAutomaticEnds) {
  options_.min_radius = options_.max_radius = options_.radius = 0;
  open(scan_);
  viewer_->set_radius(1e9);
  viewer_->wait();
  EXPECT_NEAR(0.25 * bounds(scan_.points).diagonal(), viewer_->state().radius, 1e-9);
  viewer_->set_radius(1e-9);
  viewer_->wait();
  // Between the distance of neighbours on the last ring and on the equator.
  EXPECT_GT(viewer_->state().radius, 2 * kPi / kColumns * std::sin(0.5 * kPi / kRows));
  EXPECT_LT(viewer_->state().radius, 1.001 * kPi / kRows);
}

TEST_F(ViewerTest, FieldsByName) {
  viewer_->show_field("east");
  EXPECT_EQ("east", viewer_->state().field);
  EXPECT_THROW(viewer_->show_field("west"), Error);
}

TEST(ViewerErrors, NoDisplayAndBadOptions) {
  const auto compute = [](double, const Execution&) { return ViewData(); };
  const char* old = std::getenv("DISPLAY");
  const std::string before = old == nullptr ? "" : old;
  unsetenv("DISPLAY");
  ViewerOptions options;
  options.min_radius = 0.1;
  options.max_radius = 1;
  try {
    const Viewer viewer(sphere(), compute, options);
    ADD_FAILURE() << "opened a window without a display";
  } catch (const Error& error) {
    EXPECT_EQ(ErrorCode::Unavailable, error.code());
  }
  if (old != nullptr) setenv("DISPLAY", before.c_str(), 1);
  const VirtualDisplay display;
  options.min_radius = 2;
  EXPECT_THROW(Viewer(sphere(), compute, options), Error);
  options.min_radius = 0.1;
  EXPECT_THROW(Viewer(sphere(), Recompute(), options), Error);
  EXPECT_THROW(Viewer(Scan(), compute, options), Error);
  Scan one_place;
  one_place.points.assign(3, Vec3(1, 2, 3));
  options.min_radius = 0;
  EXPECT_THROW(Viewer(one_place, compute, options), Error);
  options.min_radius = 0.1;
  Viewer viewer(sphere(), compute, options);
  viewer.wait();
  EXPECT_NE(std::string::npos, viewer.text().find("one value a point"));
}

}  // namespace
}  // namespace kappa
