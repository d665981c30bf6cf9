// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/labels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <stdexcept>
#include <tuple>

#include "kappa/core/types.hpp"
#include "support/expect_names.hpp"

namespace kappa {
namespace {

struct Row {
  double k_min, k_max;
  Label label;
};

TEST(Labels, TableOfFigure13) {
  const std::array<Row, 10> table = {{{2, 3, Label::Convex},
                                      {-3, -2, Label::Concave},
                                      {-2, 2, Label::Saddle},
                                      {0.1, 2, Label::Ridge},
                                      {-0.1, 2, Label::Ridge},
                                      {-2, 0.1, Label::Valley},
                                      {-2, -0.1, Label::Valley},
                                      {-0.1, 0.1, Label::Flat},
                                      {0, 0, Label::Flat},
                                      {1, 1, Label::Convex}}};
  for (const Row& row : table) EXPECT_EQ(classify(row.k_min, row.k_max, 1), row.label) << row.k_min << ' ' << row.k_max;
}

TEST(Labels, AtTheThresholdCounts) {
  EXPECT_EQ(classify(0.5, 0.5, 0.5), Label::Convex);
  EXPECT_EQ(classify(-0.5, 0.5, 0.5), Label::Saddle);
  EXPECT_EQ(classify(0.49, 0.49, 0.5), Label::Flat);
}

TEST(Labels, ZeroThresholdKeepsExactZeroFlat) {
  EXPECT_EQ(classify(1e-300, 1e-300, 0), Label::Convex);
  EXPECT_EQ(classify(-1e-300, 1e-300, 0), Label::Saddle);
  EXPECT_EQ(classify(0, 0, 0), Label::Flat);
  EXPECT_EQ(classify(0, 1, 0), Label::Ridge);
  EXPECT_EQ(classify(-1, 0, 0), Label::Valley);
}

TEST(Labels, NaNIsUndefined) {
  EXPECT_EQ(classify(kNaN, 1, 0.1), Label::Undefined);
  EXPECT_EQ(classify(1, kNaN, 0.1), Label::Undefined);
  EXPECT_EQ(classify(kNaN, kNaN, 0.1), Label::Undefined);
}

TEST(Labels, HaveWordsForPeople) {
  test::expect_names<Label>({"undefined", "flat", "convex", "concave", "saddle", "ridge", "valley"});
}

TEST(Labels, HaveColoursOfTheirOwn) {
  std::set<std::tuple<int, int, int>> colours;
  for (int i = 0; i < kLabelCount; ++i) {
    const Rgb c = label_colour(static_cast<Label>(i));
    colours.insert({c.r, c.g, c.b});
  }
  EXPECT_EQ(colours.size(), static_cast<std::size_t>(kLabelCount));
  EXPECT_THROW(label_colour(static_cast<Label>(kLabelCount)), std::out_of_range);
}

bool dominates(int strong, int a, int b) {
  return strong > a + 40 && strong > b + 40;
}

TEST(Labels, ColoursAreThoseOfTheirNames) {
  const Rgb red = label_colour(Label::Convex), blue = label_colour(Label::Concave), green = label_colour(Label::Saddle);
  EXPECT_TRUE(dominates(red.r, red.g, red.b));
  EXPECT_TRUE(dominates(blue.b, blue.r, blue.g));
  EXPECT_TRUE(dominates(green.g, green.r, green.b));
  const Rgb yellow = label_colour(Label::Ridge), cyan = label_colour(Label::Valley);
  EXPECT_TRUE(yellow.r > yellow.b + 40 && yellow.g > yellow.b + 40);
  EXPECT_TRUE(cyan.g > cyan.r + 40 && cyan.b > cyan.r + 40);
  const Rgb white = label_colour(Label::Flat), grey = label_colour(Label::Undefined);
  EXPECT_TRUE(white.r == white.g && white.g == white.b && white.r > 200);
  EXPECT_TRUE(grey.r == grey.g && grey.g == grey.b && grey.r < white.r);
}

}  // namespace
}  // namespace kappa
