// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "program.hpp"

namespace kappa::apps {
namespace {

void expect_usage_error(const Arguments& arguments, const std::string& expected) {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << expected;
  EXPECT_NE((outcome.err + outcome.out).find(expected), std::string::npos) << outcome.err;
}

/// Fails with one line that holds `expected`, and leaves no file.
void expect_failure(const Arguments& arguments, const std::string& expected, const Folder& folder) {
  const auto before = folder.names();
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 1) << expected;
  EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(folder.names(), before);
}

TEST(Robustness, HelpAndVersion) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command :
       {"curvature", "segment", "mesh", "normals", "generate", "compare", "render", "view", "info"})
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
  EXPECT_EQ(run({"--version"}).out.rfind("kappa ", 0), 0u);
  EXPECT_EQ(run({"curvature", "--help"}).exit_code, 0);
}

TEST(Robustness, WrongUseIsExitCode2) {
  expect_usage_error({}, "give a command");
  expect_usage_error({"sing"}, "sing");
  expect_usage_error({"curvature"}, "input");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--radius", "-1"}, "negative");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--radius", "nan"}, "--radius");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--radius", "1,two"}, "two");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--threads", "-3"}, "--threads");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--neighbours", "2"}, "--neighbours");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--orient", "sideways"}, "sideways");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--orient", "viewpoint", "1,2"}, "3 numbers");
  expect_usage_error({"curvature", "a.ply", "b.ply", "--ball", "cube"}, "--ball");
  expect_usage_error({"segment", "a.ply", "b.ply", "--flatness", "3"}, "--flatness");
  expect_usage_error({"generate", "klein", "b.ply"}, "'klein' is none of sphere");
  expect_usage_error({"curv", "a.ply", "b.ply"}, "'curv' is none of curvature, segment");
  expect_usage_error({"segment", "a.ply", "b.ply", "--kappa-max", "-3"}, "'-3' is not above 0");
  expect_usage_error({"segment", "a.ply", "b.ply", "--min-region", "-3"}, "'-3' is not 0 or more");
  expect_usage_error({"render", "a.ply", "b.png", "--directions", "up"}, "'up' is none of none, min, max, both");
}

TEST(Robustness, FailuresNameTheFileAndTheRemedy) {
  const Folder f;
  expect_failure({"curvature", f.file("absent.ply"), f.file("o.ply")}, "absent.ply", f);
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--no-normals"}).exit_code, 0);
  ASSERT_EQ(run({"generate", "sphere", f.file("cloud.csv"), "--points", "300"}).exit_code, 0);
  expect_failure({"curvature", f.file("t.ply"), f.file("o.xyzzy")}, "o.xyzzy", f);
  expect_failure({"curvature", f.file("t.ply"), f.file("no/such/folder/o.ply")}, "no/such/folder", f);
  expect_failure({"curvature", f.file("t.ply"), f.file("o.ply"), "--normals", "input"}, "no normals", f);
  expect_failure({"curvature", f.file("cloud.csv"), f.file("o.ply"), "--radius", "0"}, "radius 0 is for meshes", f);
  expect_failure({"curvature", f.file("cloud.csv"), f.file("o.ply"), "--surface", "faces"}, "no faces", f);
  expect_failure({"generate", "torus", f.file("u.ply"), "--minor", "9"}, "minor_radius", f);
  expect_failure({"compare", f.file("t.ply"), f.file("cloud.csv")}, "points", f);
  expect_failure({"render", f.file("t.ply"), f.file("o.png"), "--labels"}, "kappa segment", f);
}

TEST(Robustness, PointsWithoutPositionOrNormalAreMarkedAndCounted) {
  const Folder f;
  {
    std::ofstream csv(f.file("c.csv"));
    csv << "x,y,z,nx,ny,nz\n";
    for (int i = 0; i < 400; ++i) {
      csv << i % 20 << ',' << i / 20 << ",0,";
      csv << (i == 7 ? "nan,nan,nan\n" : i == 8 ? "0,0,0\n" : "0,0,1\n");
    }
    csv << "nan,nan,nan,0,0,1\n";
  }
  const Outcome done = run({"curvature", f.file("c.csv"), f.file("o.csv"), "--radius", "2.5"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("1 without a position"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("2 without a normal"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("398 valid"), std::string::npos) << done.out;
  std::ifstream csv(f.file("o.csv"));
  std::string line;
  for (int i = 0; i <= 8; ++i) std::getline(csv, line);
  EXPECT_NE(line.find("nan"), std::string::npos) << "line of point 7: " << line;
}

TEST(Robustness, NothingLeftIsAnErrorAndNotAnEmptyFile) {
  const Folder f;
  std::ofstream(f.file("nan.csv")) << "x,y,z\nnan,nan,nan\nnan,nan,nan\n";
  std::ofstream(f.file("two.xyz")) << "0 0 0\n1 0 0\n";
  std::ofstream(f.file("line.xyz")) << "0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n";
  std::ofstream(f.file("empty.xyz")) << "";
  expect_failure({"curvature", f.file("nan.csv"), f.file("o.ply")}, "nan.csv", f);
  expect_failure({"curvature", f.file("two.xyz"), f.file("o.ply")}, "points", f);
  expect_failure({"curvature", f.file("line.xyz"), f.file("o.ply")}, "points", f);
  expect_failure({"curvature", f.file("empty.xyz"), f.file("o.ply")}, "empty.xyz", f);
}

TEST(Robustness, ThreadsGiveTheSameBytes) {
  const Folder f;
  ASSERT_EQ(run({"generate", "airborne", f.file("s.pcd"), "--width", "60", "--depth", "60"}).exit_code, 0);
  for (const std::string threads : {"1", "2", "3"}) {
    const Outcome done = run({"segment", f.file("s.pcd"), f.file("o" + threads + ".ply"), "--radius", "4", "--smooth",
                              "2", "--threads", threads});
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  const std::string one = contents(f.file("o1.ply"));
  EXPECT_GT(one.size(), 100000u);
  EXPECT_EQ(one, contents(f.file("o2.ply")));
  EXPECT_EQ(one, contents(f.file("o3.ply")));
  EXPECT_EQ(contents(f.file("o1.regions.csv")), contents(f.file("o2.regions.csv")));
}

TEST(Robustness, InterruptLeavesNoFile) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--slices", "400", "--sides", "300"}).exit_code, 0);
  const auto before = f.names();
  // Many seconds of work, so that it is running when the signal comes.
  const Outcome stopped = run({"curvature", f.file("t.ply"), f.file("o.ply"), "--radius", "2"}, 1500);
  EXPECT_EQ(stopped.exit_code, 130) << stopped.out;
  EXPECT_NE(stopped.err.find("cancelled"), std::string::npos) << stopped.err;
  EXPECT_EQ(f.names(), before);
}

}  // namespace
}  // namespace kappa::apps
