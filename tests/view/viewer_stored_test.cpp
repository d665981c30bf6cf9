// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "kappa/scan/scan.hpp"
#include "viewer_fixture.hpp"

namespace kappa {
namespace {

using test::Picture;
using test::ViewerTest;

/// A viewer on a scan that holds curvatures of its own.
class StoredTest : public ViewerTest {
 protected:
  void SetUp() override {
    ViewerTest::SetUp();
    computed_ = 0;
  }

  /// The sphere with the mean curvature `value` and a height, for a suffix.
  void add(const std::string& suffix, double value) {
    Field mean{"mean_curvature" + suffix, Field::Type::Float64, {}};
    Field height{"height" + suffix, Field::Type::Float64, {}};
    for (const Vec3& x : scan.points) {
      mean.values.push_back(value);
      height.values.push_back(x.z());
    }
    scan.fields.push_back(mean);
    scan.fields.push_back(height);
  }

  void add_labels(const std::string& suffix) {
    scan.fields.push_back({"label" + suffix, Field::Type::UInt8, std::vector<double>(scan.points.size(), 4)});
    scan.fields.push_back({"status" + suffix, Field::Type::UInt8, std::vector<double>(scan.points.size(), 4)});
  }

  Scan scan = test::sphere();
};

TEST_F(StoredTest, OpensWithTheFieldsOfTheFileAndComputesNothing) {
  add("", 0.25);
  add_labels("");
  open(scan);
  viewer_->update();
  EXPECT_EQ(0, computed_);
  EXPECT_FALSE(viewer_->state().computing);
  EXPECT_TRUE(viewer_->state().stored);
  EXPECT_TRUE(std::isnan(viewer_->state().radius));
  EXPECT_EQ("mean curvature", viewer_->state().field);
  EXPECT_EQ(0.25, viewer_->state().range.high);
  EXPECT_TRUE(says("|  values of the file  |  mean curvature"));
  EXPECT_TRUE(says("move to measure"));
  auto* look =
      vtkSliderRepresentation2D::SafeDownCast(static_cast<vtkSliderWidget*>(viewer_->slider())->GetRepresentation());
  EXPECT_NEAR(0, look->GetValue(), 1e-12) << "in the middle of 0.1 to 10";
  // The bead is on the bar near the lower edge, not where VTK puts one by itself.
  const auto bead = [](Rgb c) { return c.r < 50 && c.g > 70 && c.g < 110 && c.b > 140; };
  const Picture first = shot();
  EXPECT_GT(first.count(0, 60, options_.width, 100, bead), 50);
  EXPECT_EQ(0, first.count(0, 112, options_.width, options_.height, bead));
  viewer_->press("f");
  EXPECT_EQ("height", viewer_->state().field);
  const Picture picture = shot();
  EXPECT_GT(picture.count([](Rgb c) { return c.b > c.r + 60; }), 2000);
  EXPECT_GT(picture.count([](Rgb c) { return c.r > c.b + 60; }), 2000);
  viewer_->pick_point(7);
  EXPECT_TRUE(says("mean curvature  0.25 1/length"));
  EXPECT_TRUE(says("label: saddle"));
  EXPECT_TRUE(says("status: border"));
  viewer_->press("l");
  EXPECT_TRUE(viewer_->state().labels);
  EXPECT_EQ(0, computed_);
}

TEST_F(StoredTest, TheSliderComputesAndTheKeyLeadsBack) {
  add("", 0.25);
  open(scan);
  viewer_->press("f");
  viewer_->set_radius(2);
  viewer_->wait();
  EXPECT_EQ(1, computed_);
  EXPECT_FALSE(viewer_->state().stored);
  EXPECT_EQ(2, viewer_->state().radius);
  EXPECT_EQ("height", viewer_->state().field) << "a field is kept by its name";
  EXPECT_EQ(0.5, viewer_->state().range.high / std::cos(0.5 * kPi / test::kRows));
  EXPECT_TRUE(says("|  radius 2  |"));
  viewer_->press("n");
  EXPECT_TRUE(viewer_->state().stored);
  EXPECT_EQ("height", viewer_->state().field);
  EXPECT_TRUE(says("values of the file"));
  EXPECT_EQ(1, computed_);
}

TEST_F(StoredTest, AFieldThatIsNotComputedGivesWayToTheFirst) {
  add("", 0.25);
  open(scan);
  EXPECT_EQ("mean curvature", viewer_->state().field);
  viewer_->set_radius(2);
  viewer_->wait();
  EXPECT_EQ("height", viewer_->state().field);
  EXPECT_THROW(viewer_->show_field("mean curvature"), Error);
}

TEST_F(StoredTest, SeveralRadiiAreSteppedThrough) {
  add("_r0.5", 0.25);
  add("_r2", 3);
  add_labels("_r2");
  open(scan);
  EXPECT_EQ(0.5, viewer_->state().radius);
  EXPECT_EQ(0.25, viewer_->state().range.high);
  EXPECT_TRUE(says("|  radius 0.5 of the file  |"));
  viewer_->press("l");
  EXPECT_TRUE(says("there are no labels"));
  viewer_->press("n");
  EXPECT_EQ(2, viewer_->state().radius);
  EXPECT_EQ(3, viewer_->state().range.high);
  viewer_->press("l");
  EXPECT_TRUE(viewer_->state().labels);
  viewer_->press("n");
  EXPECT_EQ(0.5, viewer_->state().radius);
  EXPECT_FALSE(viewer_->state().labels);
  viewer_->press("N");
  EXPECT_EQ(2, viewer_->state().radius);
  EXPECT_EQ(0, computed_);
}

TEST_F(StoredTest, ThereMayBeNone) {
  scan.fields.push_back({"intensity", Field::Type::Float64, std::vector<double>(scan.points.size(), 1)});
  open(scan);
  viewer_->wait();
  EXPECT_EQ(1, computed_);
  EXPECT_FALSE(viewer_->state().stored);
  viewer_->press("n");
  EXPECT_TRUE(says("holds no curvatures of its own"));
  EXPECT_EQ("height", viewer_->state().field);
}

}  // namespace
}  // namespace kappa
