// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "kappa/io/read.hpp"
#include "kappa/scan/scan.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

/// Segments a file of ../shared/data; the test is skipped where it is absent.
struct RealData : testing::Test {
  Folder folder;
  Scan in, out;

  void segment(const std::string& name, const Arguments& options) {
    const std::string input = shared_file(name);
    if (input.empty()) GTEST_SKIP() << name << " is not there: no ../shared/data";
    Arguments arguments = {"segment", input, folder.file("out.ply")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome done = run(arguments);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    in = read_scan(input);
    out = read_scan(folder.file("out.ply"));
    expect_same_points();
  }

  void expect_same_points() const {
    ASSERT_EQ(out.points.size(), in.points.size());
    for (std::size_t i = 0; i < in.points.size(); ++i) {
      if (!is_finite(in.points[i])) continue;
      ASSERT_EQ((out.points[i] + out.origin).eval(), (in.points[i] + in.origin).eval());
    }
  }

  const std::vector<double>& values(const std::string& field) const {
    const Field* found = out.field(field);
    if (!found) throw std::runtime_error("no field " + field);
    return found->values;
  }

  double share(const std::string& field, double value) const {
    const auto& all = values(field);
    return static_cast<double>(std::count(all.begin(), all.end(), value)) / static_cast<double>(all.size());
  }

  /// A value is NaN exactly where the status is not 0, k_min <= k_max, and the mean is near half their sum.
  void expect_consistent(const std::string& suffix = "") const {
    const auto &mean = values("mean_curvature" + suffix), &status = values("status" + suffix);
    const auto &k_min = values("k_min" + suffix), &k_max = values("k_max" + suffix);
    for (std::size_t i = 0; i < mean.size(); ++i) {
      ASSERT_EQ(std::isnan(mean[i]), status[i] != 0) << i;
      ASSERT_EQ(std::isnan(k_min[i]), status[i] != 0) << i;
      ASSERT_FALSE(k_min[i] > k_max[i]) << i;
    }
  }
};

TEST_F(RealData, AirborneGroundInProjectedCoordinates) {
  segment("lidar/airborne-pcd/samp11-utm-ground.pcd", {"--radius", "8"});
  if (IsSkipped()) return;
  expect_consistent();
  EXPECT_EQ(share("status", 0), 1.0);
  for (const double mean : values("mean_curvature")) EXPECT_LT(std::abs(mean), 1.0);
  // A natural slope has ridges as well as valleys.
  EXPECT_GT(share("label", 5) + share("label", 2), 0.1);
  EXPECT_GT(share("label", 6) + share("label", 3), 0.1);
}

TEST_F(RealData, LionWithItsOwnNormals) {
  segment("meshes/lion.obj", {"--radius", "0,12.7"});
  if (IsSkipped()) return;
  expect_consistent("_r0");
  expect_consistent("_r12.7");
  EXPECT_EQ(share("status_r0", 0), 1.0);
  EXPECT_EQ(out.faces.size(), 974u);
  // Most of an animal is convex, with outward normals.
  double sum = 0;
  for (const double mean : values("mean_curvature_r12.7")) sum += mean;
  EXPECT_GT(sum, 0);
}

TEST_F(RealData, StanfordBunnyWithIsolatedVertices) {
  segment("meshes/stanford-bunny.obj", {});
  if (IsSkipped()) return;
  expect_consistent();
  EXPECT_EQ(std::count(values("status").begin(), values("status").end(), 3), 1113);
  EXPECT_EQ(std::count(values("region").begin(), values("region").end(), 0), 1113);
}

TEST_F(RealData, RoomScanWithEveryPointTwice) {
  segment("clouds/room_scan1.pcd", {"--radius", "0.1"});
  if (IsSkipped()) return;
  expect_consistent();
  // Points at one position have one curvature, label and region.
  std::map<std::array<double, 3>, std::size_t> first;
  std::size_t twins = 0;
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    const Vec3& p = out.points[i];
    const auto [entry, fresh] = first.try_emplace({p.x(), p.y(), p.z()}, i);
    if (fresh) continue;
    ++twins;
    const double a = values("mean_curvature")[entry->second], b = values("mean_curvature")[i];
    ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    ASSERT_EQ(values("region")[entry->second], values("region")[i]);
  }
  EXPECT_EQ(twins, 56427u);
  EXPECT_GT(share("label", 1), 0.2) << "walls and floor are flat";
}

TEST_F(RealData, LionAndItsTriangulationAgree) {
  const std::string quads = shared_file("meshes/lion.obj"), triangles = shared_file("meshes/lion-tri.obj");
  if (quads.empty() || triangles.empty()) GTEST_SKIP() << "no ../shared/data";
  ASSERT_EQ(run({"curvature", quads, folder.file("a.ply"), "--radius", "20"}).exit_code, 0);
  ASSERT_EQ(run({"curvature", triangles, folder.file("b.ply"), "--radius", "20"}).exit_code, 0);
  const Scan a = read_scan(folder.file("a.ply")), b = read_scan(folder.file("b.ply"));
  ASSERT_EQ(a.points.size(), b.points.size());
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    difference += std::abs(a.field("mean_curvature")->values[i] - b.field("mean_curvature")->values[i]);
    size += std::abs(a.field("mean_curvature")->values[i]);
  }
  EXPECT_LT(difference, 0.1 * size);
}

}  // namespace
}  // namespace kappa::apps
