// SPDX-License-Identifier: BSD-3-Clause
// Options that say which points are measured, and in what unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kappa/io/las/file.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/scan.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

/// Level ground with a box on it, classes 2 and 6; every other point of a pulse with two returns.
Scan scene() {
  Scan scan;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(0, 60);
  Field classes{"classification", Field::Type::UInt8, {}}, number{"return_number", Field::Type::UInt8, {}},
      of{"number_of_returns", Field::Type::UInt8, {}};
  for (int i = 0; i < 4000; ++i) {
    const double x = place(random), y = place(random);
    const bool in_box = x > 20 && x < 35 && y > 20 && y < 35;
    scan.points.emplace_back(x, y, in_box ? 12 : 0.2 * std::sin(x));
    classes.values.push_back(in_box ? 6 : 2);
    number.values.push_back(1 + i % 2);
    of.values.push_back(2);
  }
  scan.fields = {classes, number, of};
  scan.origin = Vec3(400000, 5400000, 100);
  scan.width = scan.points.size();
  return scan;
}

std::string written(const Folder& folder, const std::string& name, const Scan& scan) {
  write_scan(folder.file(name), scan);
  return folder.file(name);
}

Outcome curvature(const Folder& f, const std::string& in, const std::string& out, const Arguments& options) {
  Arguments arguments = {"curvature", in, f.file(out), "--radius", "4"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run(arguments);
}

TEST(Filters, OnlyTheRowsAskedForLeave) {
  const Folder f;
  const std::string in = written(f, "in.las", scene());
  const Scan all = read_scan(in);
  const Outcome done =
      curvature(f, in, "out.las", {"--class", "2,9", "--returns", "last", "--bounds", "400000,5400000,400030,5400030"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("filter      4000 points read; taken away: "), std::string::npos) << done.out;
  const Scan out = read_scan(f.file("out.las"));
  std::size_t row = 0;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const Vec3 p = all.points[i] + all.origin;
    const bool stays = all.field("classification")->values[i] == 2 && all.field("return_number")->values[i] == 2 &&
                       p.x() <= 400030 && p.y() <= 5400030;
    if (!stays) continue;
    ASSERT_LT(row, out.points.size());
    const std::size_t a = las_of(all)->record_length, b = las_of(out)->record_length;
    EXPECT_EQ(las_of(out)->points.substr(row * b, a), las_of(all)->points.substr(i * a, a)) << i;
    ++row;
  }
  EXPECT_EQ(row, out.points.size());
  EXPECT_TRUE(out.field("mean_curvature"));
}

TEST(Filters, AThinnedScanIsPartOfTheScan) {
  const Folder f;
  const std::string in = written(f, "in.pcd", scene());
  const Outcome done = curvature(f, in, "out.ply", {"--voxel", "2", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Scan out = read_scan(f.file("out.ply"));
  EXPECT_LT(out.points.size(), 1200u);
  EXPECT_GT(out.points.size(), 500u);
  EXPECT_NE(done.out.find("\"voxel\": " + std::to_string(4000 - out.points.size())), std::string::npos) << done.out;
}

TEST(Filters, GroundLosesTheBox) {
  const Folder f;
  const std::string in = written(f, "in.las", scene());
  for (const char* option : {"--ground", "--ground=pmf"}) {
    ASSERT_EQ(curvature(f, in, "out.las", {option, "--surface", "delaunay", "--quiet"}).exit_code, 0);
    const Scan out = read_scan(f.file("out.las"));
    const std::vector<double>& classes = out.field("classification")->values;
    EXPECT_EQ(std::count(classes.begin(), classes.end(), 6), 0) << option;
    EXPECT_GT(out.points.size(), 3500u) << option;
  }
}

/// Heights of a torus in another unit.
TEST(Filters, HeightsInAnotherUnitGiveTheSameCurvature) {
  const Folder f;
  ASSERT_EQ(
      run({"generate", "torus", f.file("torus.ply"), "--slices", "60", "--sides", "40", "--origin", "1000,2000,300"})
          .exit_code,
      0);
  constexpr double kFoot = 0.3048;
  const Scan torus = read_scan(f.file("torus.ply"));
  Scan squeezed = torus;
  squeezed.fields.clear();
  for (Vec3& p : squeezed.points) p.z() = (p.z() + torus.origin.z()) / kFoot - torus.origin.z();
  for (Vec3& u : squeezed.normals) u = Vec3(u.x(), u.y(), u.z() * kFoot).normalized();
  const std::string in = written(f, "squeezed.ply", squeezed);
  const Scan read = read_scan(in);
  ASSERT_EQ(run({"segment", f.file("torus.ply"), f.file("a.ply"), "--radius", "0.8"}).exit_code, 0);
  const Outcome done = run({"segment", in, f.file("b.ply"), "--radius", "0.8", "--z-scale", "0.3048"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Scan a = read_scan(f.file("a.ply")), b = read_scan(f.file("b.ply"));
  ASSERT_EQ(b.points.size(), a.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ((b.points[i] + b.origin).eval(), (read.points[i] + read.origin).eval()) << "coordinates as they came";
    EXPECT_LT((b.normals[i] - read.normals[i]).norm(), 1e-9) << "normals in the coordinates of the file";
    for (const char* name : {"mean_curvature", "k_min", "k_max", "area"})
      EXPECT_NEAR(b.field(name)->values[i], a.field(name)->values[i], 1e-9) << name;
    const Vec3 direction(b.field("dir_max_x")->values[i], b.field("dir_max_y")->values[i],
                         b.field("dir_max_z")->values[i]);
    EXPECT_NEAR(direction.dot(b.normals[i]), 0, 1e-9) << "directions along the surface of the file";
    EXPECT_NEAR(direction.norm(), 1, 1e-9);
  }
}

TEST(Filters, MixedUnitsAreSaid) {
  const std::string in = shared_file("lidar/airborne-las/autzen-bmx-2010.las");
  if (in.empty()) GTEST_SKIP() << "no shared data";
  const Folder f;
  const Outcome done = run({"curvature", in, f.file("out.las")});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_NE(done.err.find("give --z-scale 0.3048006096"), std::string::npos) << done.err;
  EXPECT_EQ(run({"curvature", in, f.file("out.las"), "--z-scale", "0.3048006096"}).err, "");
  EXPECT_EQ(run({"curvature", in, f.file("out.las"), "--quiet"}).err, "");
  EXPECT_NE(run({"info", in}).out.find("units       x and y 1 m, heights 0.3048 m"), std::string::npos);
}

TEST(Filters, NoReturnsOfASpinningScannerKeepTheirRows) {
  const std::string in = shared_file("lidar/spinning/251370668.pcd");
  if (in.empty()) GTEST_SKIP() << "no shared data";
  const Folder f;
  const Outcome done = run({"curvature", in, f.file("out.ply"), "--radius", "0.2"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("5032 points at (0, 0, 0) are taken for no returns"), std::string::npos) << done.out;
  const Scan before = read_scan(in), after = read_scan(f.file("out.ply"));
  ASSERT_EQ(after.points.size(), before.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    ASSERT_EQ((after.points[i] + after.origin).eval(), (before.points[i] + before.origin).eval());
    if ((before.points[i] + before.origin).isZero(0)) {
      ASSERT_EQ(after.field("status")->values[i], 3);
    }
  }
  const Outcome cut = run({"curvature", in, f.file("cut.ply"), "--radius", "0.2", "--bounds", "-3,-3,3,3"});
  ASSERT_EQ(cut.exit_code, 0) << cut.err;
  EXPECT_NE(cut.out.find("5032 without a position"), std::string::npos) << cut.out;
}

/// A scene in which every 50th point is far off the ground and flagged.
Scan scene_with_withheld() {
  Scan scan = scene();
  Field withheld{"withheld", Field::Type::UInt8, std::vector<double>(scan.points.size())};
  for (std::size_t i = 0; i < scan.points.size(); i += 50) {
    withheld.values[i] = 1;
    scan.points[i].z() = 200;
  }
  scan.fields.push_back(withheld);
  return scan;
}

TEST(Filters, WithheldPointsKeepTheirRowsUnmeasured) {
  const Folder f;
  const std::string in = written(f, "in.las", scene_with_withheld());
  const Scan before = read_scan(in);
  const Outcome done = curvature(f, in, "out.las", {});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("80 points are flagged as withheld and not measured"), std::string::npos) << done.out;
  const Scan after = read_scan(f.file("out.las"));
  ASSERT_EQ(after.points.size(), before.points.size());
  const std::size_t a = las_of(before)->record_length, b = las_of(after)->record_length;
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    ASSERT_EQ(las_of(after)->points.substr(i * b, a), las_of(before)->points.substr(i * a, a)) << i;
    const bool withheld = i % 50 == 0;
    EXPECT_EQ(after.field("status")->values[i], withheld ? 3 : 0) << i;
    EXPECT_EQ(std::isnan(after.field("mean_curvature")->values[i]), withheld) << i;
  }
}

TEST(Filters, WithheldPointsMakeNoDifference) {
  const Folder f;
  std::vector<char> kept(4000, 1);
  for (std::size_t i = 0; i < kept.size(); i += 50) kept[i] = 0;
  for (const std::string& name : {std::string("in.las"), std::string("in.pcd")}) {
    const std::string in = written(f, name, scene_with_withheld());
    Scan rest = read_scan(in);  // as the file rounds it
    leave_out(rest, kept);
    const std::string without = written(f, "rest" + name, rest);
    ASSERT_EQ(curvature(f, in, "a.ply", {}).exit_code, 0);
    ASSERT_EQ(curvature(f, without, "b.ply", {}).exit_code, 0);
    const std::vector<double> a = read_scan(f.file("a.ply")).field("mean_curvature")->values;
    const std::vector<double> b = read_scan(f.file("b.ply")).field("mean_curvature")->values;
    for (std::size_t i = 0, at = 0; i < a.size(); ++i) {
      if (kept[i]) {
        EXPECT_NEAR(a[i], b[at++], 1e-9) << i;
      }
    }
  }
}

TEST(Filters, WithheldPointsAreMeasuredWhereAsked) {
  const Folder f;
  Scan scan = scene_with_withheld();
  const std::string in = written(f, "in.las", scan);
  const Outcome done = curvature(f, in, "out.ply", {"--withheld", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("\"withheld\": 0"), std::string::npos) << done.out;
  const Outcome left_out = curvature(f, in, "out.las", {"--class", "2,6", "--json"});
  EXPECT_NE(left_out.out.find("\"withheld\": 80"), std::string::npos) << left_out.out;
  EXPECT_EQ(read_scan(f.file("out.las")).points.size(), 3920u) << "filters take what has no position away";
  std::fill(scan.fields.back().values.begin(), scan.fields.back().values.end(), 1);
  const Outcome none = curvature(f, written(f, "all.las", scan), "none.las", {});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("all.las': every point is flagged as withheld; give --withheld"), std::string::npos)
      << none.err;
}

TEST(Filters, WrongUseIsTold) {
  const Folder f;
  const std::string in = written(f, "in.las", scene());
  const auto usage = [&](const Arguments& options, const std::string& part) {
    const Outcome done = curvature(f, in, "out.las", options);
    EXPECT_EQ(done.exit_code, 2) << part;
    EXPECT_NE(done.err.find(part), std::string::npos) << done.err;
  };
  usage({"--class", "300"}, "--class");
  usage({"--returns", "second"}, "--returns");
  usage({"--bounds", "1,2,3"}, "--bounds");
  usage({"--bounds", "1,2,0,4"}, "--bounds");
  usage({"--voxel", "0"}, "--voxel");
  usage({"--z-scale", "-1"}, "--z-scale");
  usage({"--ground-cell", "2"}, "--ground");
  usage({"--ground", "--ground-max", "2"}, "--ground-max");
  usage({"--ground=pmf", "--ground-scaling", "2"}, "--ground-scaling");
  usage({"--ground=best"}, "--ground");
}

TEST(Filters, WhatTheFileLacksIsToldByItsName) {
  const Folder f;
  Scan bare = scene();
  bare.fields.clear();
  const std::string in = written(f, "bare.pcd", bare);
  const auto failed = [&](const Arguments& options, const std::string& part) {
    const Outcome done = curvature(f, in, "out.ply", options);
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_NE(done.err.find("bare.pcd"), std::string::npos) << done.err;
    EXPECT_NE(done.err.find(part), std::string::npos) << done.err;
  };
  failed({"--class", "2"}, "no classification");
  failed({"--returns", "first"}, "no return number");
  failed({"--bounds", "0,0,1,1"}, "no point is left within the bounds");
  failed({"--voxel", "1e-16"}, "give larger");
}

TEST(Filters, OtherCommandsHaveThem) {
  const Folder f;
  const std::string in = written(f, "in.las", scene());
  const Outcome info = run({"info", in, "--class", "6"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("taken away"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("z 112.0"), std::string::npos) << info.out;
  for (const char* command : {"mesh", "normals", "segment"}) {
    const Outcome done = run({command, in, f.file("out.ply"), "--class", "2", "--voxel", "1"});
    EXPECT_EQ(done.exit_code, 0) << command << done.err;
    EXPECT_LT(read_scan(f.file("out.ply")).points.size(), 3500u) << command;
  }
  EXPECT_NE(run({"view", "--help"}).out.find("--voxel"), std::string::npos);
}

}  // namespace
}  // namespace kappa::apps
