// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

CurvatureField one_sample() {
  CurvatureSample s;
  s.k = {1, 2, 3, 4, Vec3(5, 6, 7), Vec3(8, 9, 10), PointStatus::Degenerate};
  s.mu0 = 11;
  s.mu1 = 12;
  s.mu2 = 13;
  s.area = 14;
  s.coverage = 15;
  s.face_count = 16;
  return {0.5, {s, CurvatureSample{}}};
}

TEST(CurvatureFields, HaveNameOrderAndValueOfTheDesign) {
  const char* const names[] = {
      "mean_curvature", "gaussian_curvature", "k_min",     "k_max", "dir_min_x", "dir_min_y", "dir_min_z",
      "dir_max_x",      "dir_max_y",          "dir_max_z", "mu0",   "mu1",       "mu2",       "area",
      "coverage",       "face_count",         "status"};
  const std::vector<Field> fields = curvature_fields(one_sample(), "_r0.5");
  ASSERT_EQ(fields.size(), std::size(names));
  for (std::size_t f = 0; f < fields.size(); ++f) {
    EXPECT_EQ(fields[f].name, names[f] + std::string("_r0.5"));
    ASSERT_EQ(fields[f].values.size(), 2u);
    EXPECT_EQ(fields[f].values[0], f == 16 ? 2.0 : static_cast<double>(f + 1));
    EXPECT_EQ(std::isnan(fields[f].values[1]), f < 15) << names[f];
  }
  EXPECT_EQ(fields[15].type, Field::Type::UInt32);
  EXPECT_EQ(fields[16].type, Field::Type::UInt8);
  EXPECT_EQ(fields[16].values[1], 3.0);
}

TEST(CurvatureFields, AreInTheOrderAskedFor) {
  const std::vector<Index> order = {1, 0};
  const std::vector<Field> fields = curvature_fields(one_sample(), "", order);
  for (std::size_t f = 0; f < 15; ++f) {
    EXPECT_TRUE(std::isnan(fields[f].values[0])) << f;
    EXPECT_EQ(fields[f].values[1], static_cast<double>(f + 1));
  }
  EXPECT_THROW(curvature_fields(one_sample(), "", {0}), Error);
}

TEST(RadiusSuffix, IsTheShortestDecimal) {
  EXPECT_EQ(radius_suffix(0), "_r0");
  EXPECT_EQ(radius_suffix(8), "_r8");
  EXPECT_EQ(radius_suffix(0.1), "_r0.1");
  EXPECT_EQ(radius_suffix(200000), "_r200000");
  EXPECT_EQ(radius_suffix(0.1 + 0.2), "_r0.30000000000000004");
}

Segmentation two_regions() {
  Segmentation s;
  s.labels = {Label::Convex, Label::Undefined, Label::Valley};
  s.regions = {1, 0, 2};
  return s;
}

TEST(SegmentFields, AreLabelAndRegion) {
  const std::vector<Field> fields = segment_fields(two_regions());
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0].name, "label");
  EXPECT_EQ(fields[0].values, (std::vector<double>{2, 0, 6}));
  EXPECT_EQ(fields[1].name, "region");
  EXPECT_EQ(fields[1].values, (std::vector<double>{1, 0, 2}));
}

}  // namespace
}  // namespace kappa
