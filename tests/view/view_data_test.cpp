// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/view_data.hpp"
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

/// A scan of two points with fields of these names. The values of field i are i and -i - 1.
Scan scan_with(const std::vector<std::string>& names) {
  Scan scan;
  scan.points.assign(2, Vec3::Zero());
  for (const std::string& name : names) {
    const auto i = static_cast<double>(scan.fields.size());
    scan.fields.push_back({name, Field::Type::Float64, {i, -i - 1}});
  }
  return scan;
}

std::vector<std::string> shown_names(const ViewData& data) {
  std::vector<std::string> names;
  for (const NamedValues& field : data.fields) names.push_back(field.style.name);
  return names;
}

std::vector<std::string> suffixes(const Scan& scan) {
  std::vector<std::string> found;
  for (const StoredSet& set : stored_sets(scan)) found.push_back(set.suffix);
  return found;
}

TEST(StoredSets, AreToldByTheNamesOfCurvaturesAndLabels) {
  using Strings = std::vector<std::string>;
  EXPECT_EQ(Strings{}, suffixes(scan_with({})));
  EXPECT_EQ(Strings{}, suffixes(scan_with({"intensity", "k_minor", "label_text", "mean_curvature_rough", "status",
                                           "coverage_r2", "mean_curvature_r", "k_max_r-1", "k_max_rnan"})));
  for (const char* name : {"mean_curvature", "gaussian_curvature", "k_min", "k_max", "label"})
    EXPECT_EQ(Strings{""}, suffixes(scan_with({"intensity", name}))) << name;
  const Scan scan = scan_with({"mean_curvature_r12", "k_min_r12", "k_max_r0.5", "mean_curvature_r1e-3"});
  const std::vector<StoredSet> sets = stored_sets(scan);
  ASSERT_EQ((Strings{"_r12", "_r0.5", "_r1e-3"}), suffixes(scan));
  EXPECT_EQ(12, sets[0].radius);
  EXPECT_EQ(0.5, sets[1].radius);
  EXPECT_EQ(1e-3, sets[2].radius);
  EXPECT_TRUE(std::isnan(stored_sets(scan_with({"k_min"})).front().radius));
}

TEST(StoredData, HasTheFieldsOfTheFileInOrder) {
  const Scan scan =
      scan_with({"intensity", "coverage", "k_max", "k_min", "gaussian_curvature", "mean_curvature", "mu0"});
  const ViewData data = stored_data(scan, stored_sets(scan).front());
  EXPECT_TRUE(std::isnan(data.radius));
  EXPECT_EQ((std::vector<std::string>{"mean curvature", "gaussian curvature", "k min", "k max", "coverage", "intensity",
                                      "mu0"}),
            shown_names(data));
  EXPECT_EQ((std::vector<double>{5, -6}), data.fields[0].values);
  EXPECT_EQ((std::vector<double>{0, -1}), data.fields[5].values);
  EXPECT_EQ("1/length", data.fields[0].style.unit);
  EXPECT_EQ("1/length\u00b2", data.fields[1].style.unit);
  EXPECT_EQ("", data.fields[5].style.unit);
  EXPECT_TRUE(data.labels.empty());
  EXPECT_TRUE(data.status.empty());
  EXPECT_TRUE(data.directions.dir_min.empty());
}

TEST(StoredData, OfSeveralRadiiAreKeptApart) {
  const Scan scan = scan_with({"mean_curvature_r2", "mu0_r2", "dir_min_x_r2", "dir_min_y_r2", "dir_min_z_r2",
                               "label_r2", "mean_curvature_r12", "mu0_r12", "label_r12", "intensity", "k_min"});
  const std::vector<StoredSet> sets = stored_sets(scan);
  ASSERT_EQ(3U, sets.size());
  const ViewData two = stored_data(scan, sets[0]), twelve = stored_data(scan, sets[1]),
                 own = stored_data(scan, sets[2]);
  EXPECT_EQ(2, two.radius);
  EXPECT_EQ(12, twelve.radius);
  EXPECT_EQ((std::vector<std::string>{"mean curvature", "mu0", "intensity"}), shown_names(two));
  EXPECT_EQ((std::vector<std::string>{"mean curvature", "mu0", "intensity"}), shown_names(twelve));
  EXPECT_EQ((std::vector<std::string>{"k min", "intensity"}), shown_names(own));
  EXPECT_EQ(0, two.fields[0].values[0]);
  EXPECT_EQ(6, twelve.fields[0].values[0]);
  EXPECT_EQ(7, twelve.fields[1].values[0]);
  ASSERT_EQ(2U, two.directions.dir_min.size());
  EXPECT_EQ(Vec3(2, 3, 4), two.directions.dir_min[0]);
  EXPECT_TRUE(twelve.directions.dir_min.empty());
  EXPECT_EQ((std::vector<Label>{Label::Ridge, Label::Undefined}), two.labels);
  EXPECT_TRUE(own.labels.empty());
  EXPECT_THROW(stored_data(scan, {"_r3", 3}), Error);
}

TEST(StoredData, LabelsAndStatusAreNumbersOfTheirKinds) {
  Scan scan = scan_with({"label", "status"});
  scan.points.assign(6, Vec3::Zero());
  scan.fields[0].values = {0, 6, 7, -1, 2.5, kNaN};
  scan.fields[1].values = {0, 4, 5, -1, 0.5, kNaN};
  const ViewData data = stored_data(scan, stored_sets(scan).front());
  EXPECT_EQ((std::vector<Label>{Label::Undefined, Label::Valley, Label::Undefined, Label::Undefined, Label::Undefined,
                                Label::Undefined}),
            data.labels);
  EXPECT_EQ((std::vector<PointStatus>{PointStatus::Valid, PointStatus::Border, PointStatus::Invalid,
                                      PointStatus::Invalid, PointStatus::Invalid, PointStatus::Invalid}),
            data.status);
  // There is always a field to show.
  EXPECT_EQ(std::vector<std::string>{"label"}, shown_names(data));
}

TEST(FieldStyle, IsToldByTheName) {
  const auto style = [](const std::string& name, double low, const std::string& unit = "length") {
    return field_style({name, Field::Type::Float64, {low, 1}}, unit);
  };
  EXPECT_EQ("mean curvature r0.5", style("mean_curvature_r0.5", 0).name);
  EXPECT_EQ("1/m", style("mean_curvature_r0.5", 0, "m").unit);
  EXPECT_EQ("1/m\u00b2", style("gaussian_curvature", 0, "m").unit);
  EXPECT_EQ("1/length", style("k_min", 0).unit);
  EXPECT_EQ("", style("coverage", 0, "m").unit);
  EXPECT_EQ(ColourMap::Diverging, style("k_max", 0).map);
  EXPECT_EQ(ColourMap::Diverging, style("height", -1).map);
  EXPECT_EQ(ColourMap::Sequential, style("height", 0).map);
  EXPECT_FALSE(style("height", 0).range);
}

}  // namespace
}  // namespace kappa
