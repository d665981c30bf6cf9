// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/figure.hpp"
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/view/display.hpp"
#include "picture_reader.hpp"

namespace kappa {
namespace {

using test::differing_pixels;
using test::Picture;
using test::read_picture;
using test::same;

constexpr int kWidth = 800, kHeight = 500;
constexpr int kStrip = 145;  // width of the legend at this size

bool bluish(Rgb c) {
  return c.b > c.r + 40;
}
bool reddish(Rgb c) {
  return c.r > c.b + 40;
}

/// A flat square grid with faces, seen from above: x grows to the right, y upwards.
class FigureTest : public ::testing::Test {
 protected:
  static constexpr int kSide = 41;

  void SetUp() override {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        scan_.points.emplace_back(i, j, 0);
        values_.push_back(2.0 * i / (kSide - 1) - 1);
      }
    }
    for (Index j = 0; j + 1 < kSide; ++j) {
      for (Index i = 0; i + 1 < kSide; ++i) scan_.faces.add({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    options_.width = kWidth;
    options_.height = kHeight;
    options_.camera = Camera{0, 90, 1};
    options_.shading = Shading::None;
  }

  static Index at(Index i, Index j) { return j * kSide + i; }

  Picture scalar(const std::string& name) {
    draw_scalar(folder_ / name, scan_, values_, style_, options_);
    return read_picture(folder_ / name);
  }

  /// Pixels of the background at their left and right the drawn square begins and ends, in the middle row.
  static std::pair<int, int> square(const Picture& picture, Rgb background) {
    int left = 0, right = kWidth - kStrip - 1;
    while (same(picture.at(left, kHeight / 2), background)) ++left;
    while (same(picture.at(right, kHeight / 2), background)) --right;
    return {left, right};
  }

  const VirtualDisplay display_;  // one for all figures of a test
  test::TemporaryFolder folder_;
  Scan scan_;
  std::vector<double> values_;
  ScalarStyle style_{"mean curvature", "1/m", ColourMap::Diverging, ColourRange{-1, 1}, 98};
  FigureOptions options_;
};

TEST_F(FigureTest, ColoursAreThoseOfTheMap) {
  const Picture picture = scalar("a.png");
  ASSERT_EQ(kWidth, picture.width);
  ASSERT_EQ(kHeight, picture.height);
  const auto [left, right] = square(picture, options_.background);
  ASSERT_GT(right - left, kHeight / 2);
  for (double t = 0.05; t < 1; t += 0.1) {
    const int x = left + static_cast<int>(std::lround(t * (right - left)));
    EXPECT_LE(test::difference(map_colour(ColourMap::Diverging, t), picture.at(x, kHeight / 2)), 4) << t;
  }
  EXPECT_TRUE(bluish(picture.at(left + 5, kHeight / 2)));
  EXPECT_TRUE(reddish(picture.at(right - 5, kHeight / 2)));
}

TEST_F(FigureTest, DataFillThePictureAndKeepOffTheLegend) {
  const Picture picture = scalar("a.png");
  const auto drawn = [&](Rgb c) { return !same(c, options_.background); };
  EXPECT_EQ(0, picture.count(0, 0, kWidth - kStrip, 10, drawn));
  EXPECT_EQ(0, picture.count(0, kHeight - 10, kWidth - kStrip, kHeight, drawn));
  EXPECT_GT(picture.count(0, 0, kWidth - kStrip, kHeight, drawn), 0.8 * kHeight * kHeight);
}

TEST_F(FigureTest, TheColourBarHasTheColoursAndText) {
  const Picture picture = scalar("a.png");
  const int x0 = kWidth - kStrip;
  EXPECT_GT(picture.count(x0, 0, kWidth, kHeight, bluish), 500);
  EXPECT_GT(picture.count(x0, 0, kWidth, kHeight, reddish), 500);
  const auto dark = [](Rgb c) { return c.r < 90 && c.g < 90 && c.b < 90; };
  EXPECT_GT(picture.count(x0, 0, kWidth, kHeight, dark), 100);
}

TEST_F(FigureTest, ClippedEndsAreMarked) {
  const Picture whole = scalar("whole.png");
  style_.range = ColourRange{-0.5, 0.5};
  const Picture clipped = scalar("clipped.png");
  const int x0 = kWidth - kStrip;
  // The pointed ends add the end colours to the legend.
  for (const double t : {0.0, 1.0}) {
    const auto end = [&](Rgb c) { return same(c, map_colour(ColourMap::Diverging, t)); };
    EXPECT_GT(clipped.count(x0, 0, kWidth, kHeight, end), whole.count(x0, 0, kWidth, kHeight, end) + 50) << t;
  }
}

TEST_F(FigureTest, NoValueIsGreyAndNamed) {
  const auto grey = [](Rgb c) { return same(c, kNoValueColour); };
  EXPECT_EQ(0, scalar("all.png").count(grey));
  for (Index j = 10; j < 20; ++j) {
    for (Index i = 10; i < 20; ++i) values_[at(i, j)] = kNaN;
  }
  const Picture picture = scalar("some.png");
  const auto [left, right] = square(picture, options_.background);
  const double pixels = static_cast<double>(right - left) / (kSide - 1);
  // All faces with a corner without value: 11 x 11 of them.
  const double expected = std::pow(11 * pixels, 2);
  EXPECT_NEAR(expected, picture.count(0, 0, kWidth - kStrip, kHeight, grey), 0.05 * expected);
  EXPECT_GT(picture.count(kWidth - kStrip, 0, kWidth, kHeight, grey), 100);
}

TEST_F(FigureTest, CloudLooksLikeTheSurface) {
  const Picture mesh = scalar("mesh.png");
  scan_.faces.clear();
  const Picture cloud = scalar("cloud.png");
  const auto [left, right] = square(mesh, options_.background);
  int different = 0;
  for (int y = kHeight / 4; y < 3 * kHeight / 4; ++y) {
    for (int x = left + 10; x < right - 10; ++x)
      different += test::difference(mesh.at(x, y), cloud.at(x, y)) > 12 ? 1 : 0;
  }
  EXPECT_EQ(0, different);  // no gap, no colour more than a point's distance away
}

TEST_F(FigureTest, PointSizeInPixels) {
  scan_.faces.clear();
  options_.point_size = 4;
  const Picture picture = scalar("dots.png");
  const auto drawn = [&](Rgb c) { return !same(c, options_.background); };
  const int count = picture.count(0, 0, kWidth - kStrip, kHeight, drawn);
  // A square of four pixels touches four or five of them along an axis.
  EXPECT_GE(count, 4 * 4 * kSide * kSide);
  EXPECT_LE(count, 5 * 5 * kSide * kSide);
}

TEST_F(FigureTest, InvalidPointsAreSkipped) {
  const Picture whole = scalar("whole.png");
  scan_.points[at(20, 20)] = Vec3::Constant(kNaN);
  const Picture holed = scalar("holed.png");
  const auto [left, right] = square(whole, options_.background);
  EXPECT_TRUE(same(options_.background, holed.at((left + right) / 2, kHeight / 2)));
  EXPECT_FALSE(same(options_.background, whole.at((left + right) / 2, kHeight / 2)));
  // It is not drawn, so the legend does not tell of points without a value.
  EXPECT_EQ(0, holed.count([](Rgb c) { return same(c, kNoValueColour); }));
}

TEST_F(FigureTest, LabelsHaveExactlyTheirColours) {
  std::vector<Label> labels;
  for (const double value : values_)
    labels.push_back(value < -0.3 ? Label::Concave : value > 0.4 ? Label::Convex : Label::Flat);
  draw_labels(folder_ / "labels.png", scan_, labels, options_);
  const Picture picture = read_picture(folder_ / "labels.png");
  int known = 0;
  for (const Label label : {Label::Concave, Label::Flat, Label::Convex}) {
    const auto is_label = [&](Rgb c) { return same(c, label_colour(label)); };
    const double share =
        static_cast<double>(std::count(labels.begin(), labels.end(), label)) / static_cast<double>(labels.size());
    const int count = picture.count(0, 0, kWidth - kStrip, kHeight, is_label);
    known += count;
    const auto [left, right] = square(picture, options_.background);
    EXPECT_NEAR(share, count / std::pow(right - left, 2), 0.03) << name(label);
    EXPECT_GT(picture.count(kWidth - kStrip, 0, kWidth, kHeight, is_label), 200) << name(label);
  }
  const auto drawn = [&](Rgb c) { return !same(c, options_.background); };
  EXPECT_GT(known, 0.98 * picture.count(0, 0, kWidth - kStrip, kHeight, drawn));  // the rest are smoothed edges
  const auto absent = [](Rgb c) { return same(c, label_colour(Label::Saddle)); };
  EXPECT_EQ(0, picture.count(absent));
}

TEST_F(FigureTest, GentleShadingShowsTheShapeAndKeepsTheHue) {
  for (std::size_t i = 0; i < scan_.points.size(); ++i) {
    scan_.points[i].z() = 4 * std::sin(0.4 * scan_.points[i].x());
    values_[i] = 0.5;
  }
  const Picture plain = scalar("plain.png");
  options_.shading = Shading::Gentle;
  const Picture shaded = scalar("shaded.png");
  int darkest = 255, lightest = 0;
  for (int x = 220; x < 420; ++x) {
    const Rgb c = shaded.at(x, kHeight / 2), p = plain.at(x, kHeight / 2);
    darkest = std::min<int>(darkest, c.r);
    lightest = std::max<int>(lightest, c.r);
    EXPECT_NEAR(static_cast<double>(p.g) / p.r, static_cast<double>(c.g) / c.r, 0.02);
    EXPECT_GT(c.r, 0.7 * p.r);
  }
  EXPECT_GT(lightest, darkest + 15);
}

TEST_F(FigureTest, EdgesDirectionsAndTitleAreDrawn) {
  const Picture plain = scalar("plain.png");
  options_.edges = Edges::Shown;
  EXPECT_GT(differing_pixels(plain, scalar("edges.png")), 5000);
  options_.edges = Edges::Hidden;
  options_.directions = Directions::Max;
  EXPECT_THROW(scalar("directions.png"), Error);
  options_.direction_fields.dir_max.assign(scan_.points.size(), Vec3::UnitX());
  const Picture lines = scalar("directions.png");
  EXPECT_GT(differing_pixels(plain, lines), 1000);
  options_.directions = Directions::None;
  options_.title = "A title";
  const auto dark = [](Rgb c) { return c.r < 90 && c.g < 90 && c.b < 90; };
  EXPECT_EQ(0, plain.count(0, kHeight - 40, 200, kHeight, dark));
  EXPECT_GT(scalar("title.png").count(0, kHeight - 40, 200, kHeight, dark), 50);
}

TEST_F(FigureTest, SameInputSameBytes) {
  scalar("a.png");
  scalar("b.png");
  EXPECT_EQ(test::file_bytes(folder_ / "a.png"), test::file_bytes(folder_ / "b.png"));
}

TEST_F(FigureTest, PositionFarFromTheOriginChangesNothing) {
  scalar("a.png");
  scan_.origin = Vec3(500000, 5400000, 100);
  scalar("b.png");
  EXPECT_EQ(test::file_bytes(folder_ / "a.png"), test::file_bytes(folder_ / "b.png"));
}

TEST_F(FigureTest, BadCallsAreNamedAndLeaveNoFile) {
  const auto code = [&](const std::string& path) {
    try {
      draw_scalar(path, scan_, values_, style_, options_);
    } catch (const Error& error) {
      return static_cast<int>(error.code());
    }
    return -1;
  };
  EXPECT_EQ(static_cast<int>(ErrorCode::FileWrite), code(folder_ / "nowhere/a.png"));
  EXPECT_EQ(static_cast<int>(ErrorCode::FileWrite), code(folder_ / "a.jpg"));
  options_.width = 10;
  EXPECT_EQ(static_cast<int>(ErrorCode::InvalidArgument), code(folder_ / "a.png"));
  options_.width = kWidth;
  values_.pop_back();
  EXPECT_EQ(static_cast<int>(ErrorCode::InvalidArgument), code(folder_ / "a.png"));
  scan_ = Scan();
  scan_.points = {Vec3::Constant(kNaN)};
  values_ = {1};
  EXPECT_EQ(static_cast<int>(ErrorCode::InvalidData), code(folder_ / "a.png"));
  EXPECT_EQ(0U, folder_.file_count());
}

TEST_F(FigureTest, AFewPointsAndPointsThatCoincide) {
  scan_ = Scan();
  scan_.points = {Vec3(1, 2, 3)};
  values_ = {0.5};
  scalar("one.png");
  scan_.points.assign(40, Vec3(1, 2, 3));
  scan_.points.emplace_back(2, 2, 3);
  values_.assign(41, 0.5);
  options_.point_size = 8;
  const Picture picture = scalar("two.png");
  EXPECT_GT(picture.count(0, 0, kWidth - kStrip, kHeight, [&](Rgb c) { return !same(c, options_.background); }), 100);
}

TEST(AutomaticCamera, TerrainIsSeenFromTheSouthAndAbove) {
  Scan terrain, block;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x(i % 10, i / 10 % 10, i / 100);
    block.points.push_back(x);
    terrain.points.push_back(x.cwiseProduct(Vec3(10, 10, 1)));
  }
  terrain.points.emplace_back(50, 50, 4000);  // a bird
  const Camera camera = automatic_camera(terrain);
  EXPECT_GE(camera.elevation, 45);
  EXPECT_LE(camera.elevation, 50);
  EXPECT_LE(std::abs(camera.azimuth), 30);
  EXPECT_LT(automatic_camera(block).elevation, 35);
  // However high the hills: a normal that leans up says that there is a below.
  block.normals.assign(block.points.size(), Vec3(0.6, 0, 0.8));
  EXPECT_GE(automatic_camera(block).elevation, 45);
  for (std::size_t i = 0; i < block.normals.size(); i += 5) block.normals[i] = Vec3(1, 0, 0);
  EXPECT_LT(automatic_camera(block).elevation, 35);
}

TEST(AutomaticCamera, YIsUpForMeshesThatAreNotLowInZ) {
  Scan block, tile;
  for (int i = 0; i < 1000; ++i) {
    block.points.emplace_back(i % 10, i / 10 % 10, i / 100);
    tile.points.push_back(block.points.back().cwiseProduct(Vec3(10, 10, 1)));
  }
  EXPECT_EQ(automatic_camera(block).up, UpAxis::Z);
  for (Scan* scan : {&block, &tile}) scan->faces.add(0, 1, 2);
  EXPECT_EQ(automatic_camera(block).up, UpAxis::Y);
  EXPECT_EQ(automatic_camera(tile).up, UpAxis::Z);
}

TEST_F(FigureTest, TheUpAxisPointsUp) {
  scan_ = Scan();
  scan_.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 1}, {0, 2, 0}, {1, 2, 0}, {0.5, 2, 1}};
  scan_.faces.add(0, 1, 2);
  scan_.faces.add(3, 4, 5);
  values_ = {-1, -1, -1, 1, 1, 1};  // red where y is high
  options_.shading = Shading::None;
  options_.camera = Camera{0, 20, 1, UpAxis::Y};
  const Picture picture = scalar("up.png");
  const auto red = [](Rgb c) { return c.r > c.b + 60; };
  const auto blue = [](Rgb c) { return c.b > c.r + 60; };
  const int half = kHeight / 2, width = kWidth - kStrip;
  EXPECT_GT(picture.count(0, half, width, kHeight, red), 50);
  EXPECT_EQ(picture.count(0, 0, width, half, red), 0);
  EXPECT_GT(picture.count(0, 0, width, half, blue), 50);
  EXPECT_EQ(picture.count(0, half, width, kHeight, blue), 0);
}

TEST(AutomaticCamera, ADepthCameraSeesItsCloudUpright) {
  Scan scan;
  for (int i = 0; i < 100; ++i) scan.points.emplace_back(0.1 * (i % 10) - 0.5, 0.1 * (i / 10) - 0.5, 1 + 0.1 * (i % 7));
  scan.normals.assign(scan.points.size(), Vec3(0, 0, -1));
  EXPECT_EQ(automatic_camera(scan).up, UpAxis::NegativeY);
  scan.normals.assign(scan.points.size(), Vec3(0, 0, 1));  // not seen from the origin
  EXPECT_EQ(automatic_camera(scan).up, UpAxis::Z);
}

TEST_F(FigureTest, NegativeYPointsUpSeenFromTheDepthCamera) {
  scan_ = Scan();  // a wall at z = 2, its upper half (y < 0) red, its left half at x < 0
  scan_.points = {{-1, -1, 2}, {-1, 0, 2}, {0, -1, 2}, {1, 1, 2}, {1, 0, 2}, {0, 1, 2}};
  scan_.faces.add(0, 1, 2);
  scan_.faces.add(3, 4, 5);
  values_ = {1, 1, 1, -1, -1, -1};
  options_.shading = Shading::None;
  options_.camera = Camera{0, 0, 1, UpAxis::NegativeY};
  const Picture picture = scalar("camera.png");
  const auto red = [](Rgb c) { return c.r > c.b + 60; };
  const auto blue = [](Rgb c) { return c.b > c.r + 60; };
  const int half_x = (kWidth - kStrip) / 2, half_y = kHeight / 2;
  EXPECT_GT(picture.count(0, half_y, half_x, kHeight, red), 50);
  EXPECT_EQ(picture.count(half_x, 0, kWidth - kStrip, half_y, red), 0);
  EXPECT_GT(picture.count(half_x, 0, kWidth - kStrip, half_y, blue), 50);
  EXPECT_EQ(picture.count(0, half_y, half_x, kHeight, blue), 0);
}

TEST(DirectionFieldsOfAScan, AreFoundByName) {
  Scan scan;
  scan.points.assign(2, Vec3::Zero());
  for (const char* name : {"dir_min_x_r2", "dir_min_y_r2", "dir_min_z_r2", "dir_max_x_r2"}) {
    scan.fields.push_back({name, Field::Type::Float64, {1.0, static_cast<double>(scan.fields.size())}});
  }
  const DirectionFields fields = direction_fields(scan, "_r2");
  ASSERT_EQ(2U, fields.dir_min.size());
  EXPECT_EQ(Vec3(0, 1, 2), fields.dir_min[1]);
  EXPECT_TRUE(fields.dir_max.empty());
  EXPECT_TRUE(direction_fields(scan).dir_min.empty());
}

}  // namespace
}  // namespace kappa
