// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::expect_refused;
using test::position;
using test::scan_of;

TEST(TextClouds, AnySeparator) {
  for (const char* text : {"1 2.5 -3e2\n4 5 6", "1\t2.5\t-3e2\r\n4\t5\t6\r\n", "1,2.5,-3e2\n4,5,6\n",
                           "1;2.5;-3e2\n4;5;6", " 1 , 2.5 , -3e2 \n\n4, 5 ,6,\n"}) {
    const Scan scan =
        scan_of("a.xyz", std::string(text).find("6,") == std::string::npos ? text : "1,2.5,-3e2,\n4,5,6,");
    ASSERT_EQ(scan.points.size(), 2u) << text;
    EXPECT_EQ(position(scan, 0), Vec3(1, 2.5, -300)) << text;
    EXPECT_EQ(position(scan, 1), Vec3(4, 5, 6)) << text;
  }
}

TEST(TextClouds, CommentsBlankLinesAndSigns) {
  const Scan scan =
      scan_of("a.txt", "\xef\xbb\xbf# x y Mean_Curvature nx ny\n// more\n\n+1 -2 .5 0 0 1\n1 2 NaN 0 0 -1\n");
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(position(scan, 0), Vec3(1, -2, 0.5));
  EXPECT_TRUE(std::isnan(scan.points[1].z()));
  ASSERT_EQ(scan.normals.size(), 2u);
  EXPECT_EQ(scan.normals[1], Vec3(0, 0, -1));
}

TEST(TextClouds, HeaderNamesColumnsInAnyOrder) {
  const Scan scan = scan_of("a.csv", "\"nz\",Intensity,z,y,x,ny,nx\n1,17,3,2,1,0,0\n");
  EXPECT_EQ(position(scan, 0), Vec3(1, 2, 3));
  EXPECT_EQ(scan.normals[0], Vec3(0, 0, 1));
  ASSERT_NE(scan.field("Intensity"), nullptr);
  EXPECT_EQ(scan.field("Intensity")->values[0], 17);
}

TEST(TextClouds, SixColumnsAreColoursIfTheyCannotBeNormals) {
  const Scan colours = scan_of("a.xyz", "1 2 3 255 0 17\n4 5 6 0 0 0\n");
  EXPECT_TRUE(colours.normals.empty());
  ASSERT_NE(colours.field("blue"), nullptr);
  EXPECT_EQ(colours.field("blue")->values[0], 17);
  EXPECT_EQ(scan_of("a.xyz", "1 2 3 1 0 0\n4 5 6 0 0 1\n").normals.size(), 2u);
}

TEST(TextClouds, OtherColumnsBecomeFields) {
  const Scan scan = scan_of("a.pts", "2\n1 2 3 -1043 10 20 30\n4 5 6 -1000 1 2 3\n");
  ASSERT_EQ(scan.points.size(), 2u);
  ASSERT_EQ(scan.fields.size(), 4u);
  EXPECT_EQ(scan.fields[0].name, "column_4");
  EXPECT_EQ(scan.fields[3].values[1], 3);
}

TEST(TextClouds, NumbersAreReadToTheLastBit) {
  const Scan scan = scan_of("a.xyz", "512700.12345678901 0.1 1e-400\n4.35 5e-324 1.7976931348623157e308\n");
  EXPECT_EQ(position(scan, 0).x(), 512700.12345678901);
  EXPECT_EQ(position(scan, 0).y(), 0.1);
  EXPECT_EQ(position(scan, 0).z(), 0.0);
  EXPECT_EQ(position(scan, 1).y(), 5e-324);
}

TEST(TextClouds, RefusedWithTheLine) {
  expect_refused("a.xyz", "1 2 3\n4 5\n", "line 2: has 2 columns where those above have 3");
  expect_refused("a.xyz", "1 2 3\n\n4 5 6 7\n", "line 3: has 4 columns");
  expect_refused("a.xyz", "1 2 3\n4 5 6x\n", "line 2: '6x' is not a number");
  expect_refused("a.xyz", "1 2 3\n4 5 1e999\n", "line 2: '1e999' is not a number");
  expect_refused("a.csv", "1,2,3\n4,,6\n", "line 2: '' is not a number");
  expect_refused("a.csv", "1,5;2,5;3,5\n", "decimal points");
  expect_refused("a.csv", "x;y;z\n1,5;2,5;3,5\n", "line 2: has both commas and semicolons");
  expect_refused("a.xyz", "1 2\n3 4\n", "line 1: has 2 columns");
  expect_refused("a.xyz", "0.5\n1 2 3\n", "line 1: has one number");
  expect_refused("a.pts", "3\n1 2 3\n4 5 6\n", "promises 3 points on its first line but holds 2");
  expect_refused("a.csv", "x,y,height\n1,2,3\n", "no z");
  expect_refused("a.csv", "x,y,z,a,a\n1,2,3,4,5\n", "two columns 'a'");
  expect_refused("a.csv", "x,y,z\n", "holds no point");
  expect_refused("a.xyz", "# nothing\n\n", "holds no point");
  expect_refused("a.xyz", "nan nan nan\nnan 1 2\n", "no point with finite coordinates");
  expect_refused("a.xyz", "", "is empty");
}

TEST(TextClouds, AMillionLinesTakeAboutASecond) {
  std::string text;
  for (int i = 0; i < 1000000; ++i) text += "512700." + std::to_string(100000 + i % 7) + " 5403547.25 -17.125\n";
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.xyz", text);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(read_scan(path).points.size(), 1000000u);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_LT(seconds, 30.0);  // far above, for a busy machine under a sanitizer
}

}  // namespace
}  // namespace kappa
