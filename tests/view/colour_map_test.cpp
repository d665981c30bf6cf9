// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/colour_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/core/types.hpp"

namespace kappa {
namespace {

/// CIELAB lightness and colour of an sRGB colour, computed the other way round than the maps.
std::array<double, 3> lab(Rgb c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double r = linear(c.r / 255.0), g = linear(c.g / 255.0), b = linear(c.b / 255.0);
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047);
  const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double step(ColourMap map, int i, int n) {
  const auto a = lab(map_colour(map, static_cast<double>(i) / n)),
             b = lab(map_colour(map, static_cast<double>(i + 1) / n));
  return std::hypot(a[0] - b[0], std::hypot(a[1] - b[1], a[2] - b[2]));
}

TEST(ColourMap, DivergingIsBlueGreyRed) {
  const Rgb low = map_colour(ColourMap::Diverging, 0), middle = map_colour(ColourMap::Diverging, 0.5);
  const Rgb high = map_colour(ColourMap::Diverging, 1);
  EXPECT_GT(low.b, low.r + 100);
  EXPECT_GT(high.r, high.b + 100);
  EXPECT_NEAR(middle.r, middle.g, 2);
  EXPECT_NEAR(middle.g, middle.b, 2);
  EXPECT_GT(middle.g, 200);
  EXPECT_EQ(low.b, map_colour(ColourMap::Diverging, -7).b);
  EXPECT_EQ(high.r, map_colour(ColourMap::Diverging, 7).r);
}

TEST(ColourMap, DivergingIsAsLightOnBothSides) {
  for (double side = 0; side <= 0.5; side += 0.05) {
    const double below = lab(map_colour(ColourMap::Diverging, 0.5 - side))[0];
    EXPECT_NEAR(below, lab(map_colour(ColourMap::Diverging, 0.5 + side))[0], 1.5) << side;
  }
}

TEST(ColourMap, StepsAreSmooth) {
  constexpr int kSteps = 32;
  for (const ColourMap map : {ColourMap::Diverging, ColourMap::Sequential}) {
    double smallest = 1e9, largest = 0;
    for (int i = 0; i < kSteps; ++i) {
      smallest = std::min(smallest, step(map, i, kSteps));
      largest = std::max(largest, step(map, i, kSteps));
    }
    EXPECT_GT(smallest, 1.5);
    EXPECT_LT(largest, 4 * smallest);
  }
}

TEST(ColourMap, SequentialGetsLighter) {
  for (int i = 0; i < 64; ++i) {
    EXPECT_LT(lab(map_colour(ColourMap::Sequential, i / 64.0))[0],
              lab(map_colour(ColourMap::Sequential, (i + 1) / 64.0))[0]);
  }
}

TEST(ColourRange, IsSymmetricAboutZeroAndIgnoresOutliers) {
  std::vector<double> values;
  for (int i = 1; i <= 1000; ++i) values.push_back((i % 2 == 0 ? 1 : -1) * 0.001 * i);
  for (int i = 0; i < 10; ++i) values.push_back(1e6);
  values.push_back(kNaN);
  values.push_back(std::numeric_limits<double>::infinity());
  const ColourRange range = colour_range(values, {});
  EXPECT_DOUBLE_EQ(-range.high, range.low);
  EXPECT_NEAR(0.99, range.high, 2e-3);  // 98 % of 1010 sizes
}

TEST(ColourRange, DegenerateFields) {
  EXPECT_EQ(1, colour_range({}, {}).high);
  EXPECT_EQ(1, colour_range({0, 0, kNaN}, {}).high);
  EXPECT_EQ(3, colour_range(std::vector<double>(1000, 3.0), {}).high);
  std::vector<double> sparse(1000, 0.0);
  sparse[7] = -5;
  EXPECT_EQ(5, colour_range(sparse, {}).high);
  ScalarStyle sequential;
  sequential.map = ColourMap::Sequential;
  const ColourRange constant = colour_range({2, 2, 2}, sequential);
  EXPECT_LT(constant.low, 2);
  EXPECT_GT(constant.high, 2);
}

TEST(ColourRange, GivenRangeAndItsErrors) {
  ScalarStyle style;
  style.range = ColourRange{-0.25, 0.5};
  EXPECT_EQ(0.5, colour_range({100}, style).high);
  style.range = ColourRange{1, 1};
  EXPECT_THROW(colour_range({1}, style), Error);
  style.range = ColourRange{0, kNaN};
  EXPECT_THROW(colour_range({1}, style), Error);
  style.range.reset();
  style.percentile = 50;
  EXPECT_THROW(colour_range({1}, style), Error);
}

TEST(Ticks, AreRoundInsideAndFew) {
  for (const double size : {1e-9, 3.7e-4, 0.0731, 0.5, 1.0, 2.6, 99.0, 1.23e7}) {
    const ColourRange range{-size, size};
    const std::vector<double> ticks = round_ticks(range);
    EXPECT_GE(ticks.size(), 4U) << size;
    EXPECT_LE(ticks.size(), 9U) << size;
    EXPECT_EQ(1, std::count(ticks.begin(), ticks.end(), 0.0)) << size;
    EXPECT_GE(ticks.front(), range.low * (1 + 1e-9));
    EXPECT_LE(ticks.back(), range.high * (1 + 1e-9));
    const std::vector<std::string> texts = tick_texts(ticks);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_NEAR(ticks[i], std::stod(texts[i]), 1e-6 * size) << texts[i];
      EXPECT_LE(texts[i].size(), 8U) << texts[i];
    }
  }
}

TEST(Ticks, Texts) {
  EXPECT_EQ((std::vector<std::string>{"-0.05", "0.00", "0.05"}), tick_texts({-0.05, 0, 0.05}));
  EXPECT_EQ((std::vector<std::string>{"-2", "0", "2"}), tick_texts({-2, 0, 2}));
  EXPECT_EQ((std::vector<std::string>{"-2e-5", "0", "2e-5"}), tick_texts({-2e-5, 0, 2e-5}));
  EXPECT_EQ((std::vector<std::string>{"0", "5e5", "1.0e6"}), tick_texts({0, 5e5, 1e6}));
}

}  // namespace
}  // namespace kappa
