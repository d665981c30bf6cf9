// SPDX-License-Identifier: BSD-3-Clause
// Every real file of a known extension, with the counts that its publisher or an independent program gives.
#include <algorithm>
#include <map>
#include <set>

#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

namespace fs = std::filesystem;

struct Expected {
  const char* path;
  std::size_t points, faces, non_finite;
  bool has_normals;
  std::size_t width = 0, height = 1;  ///< of an organised cloud
};

const std::vector<Expected>& expectations() {
  static const std::vector<Expected> table = {
      {"clouds/bun_zipper.ply", 35947, 0, 0, false},
      {"clouds/table_scene_mug_stereo_textured.pcd", 307200, 0, 97920, false, 640, 480},
      {"clouds/room_scan1.pcd", 112586, 0, 0, false},
      {"clouds/milk.pcd", 12575, 0, 0, false},
      {"clouds/learn37.pcd", 307200, 0, 136661, false, 640, 480},
      {"clouds/bun0.pcd", 397, 0, 0, true},
      {"clouds/bunny.pcd", 397, 0, 0, false},
      {"clouds/colored_cloud.pcd", 1000, 0, 0, true},
      {"clouds/autzen-utm.pcd", 1065, 0, 0, false},
      {"clouds/torus_010000.pts", 10000, 0, 0, true},
      {"clouds/goursat_010000.pts", 10000, 0, 0, true},
      {"clouds/torus-lidar.pts", 2086, 0, 0, true},
      {"clouds/kitten.xyz", 5210, 0, 0, true},
      {"clouds/poste_france.xyz", 9031, 0, 0, false},
      {"lidar/airborne-pcd/samp11-utm.pcd", 38010, 0, 0, false},
      {"lidar/airborne-pcd/samp11-utm-ground.pcd", 21786, 0, 0, false},
      {"lidar/airborne-pcd/samp21-utm.pcd", 12960, 0, 0, false},
      {"lidar/airborne-pcd/samp21-utm-ground.pcd", 10085, 0, 0, false},
      {"lidar/airborne-pcd/samp23-utm.pcd", 25095, 0, 0, false},
      {"lidar/airborne-pcd/samp23-utm-ground.pcd", 13223, 0, 0, false},
      {"lidar/airborne-pcd/samp31-utm.pcd", 28862, 0, 0, false},
      {"lidar/airborne-pcd/samp31-utm-ground.pcd", 15556, 0, 0, false},
      {"lidar/airborne-pcd/samp42-utm.pcd", 42470, 0, 0, false},
      {"lidar/airborne-pcd/samp42-utm-ground.pcd", 12443, 0, 0, false},
      {"lidar/airborne-pcd/samp51-utm.pcd", 17845, 0, 0, false},
      {"lidar/airborne-pcd/samp51-utm-ground.pcd", 13950, 0, 0, false},
      {"lidar/airborne-pcd/samp53-utm.pcd", 34378, 0, 0, false},
      {"lidar/airborne-pcd/samp53-utm-ground.pcd", 32989, 0, 0, false},
      {"lidar/airborne-pcd/FSite8_red1-utm.pcd", 86318, 0, 0, false},
      {"lidar/spinning/251370668.pcd", 69088, 0, 0, false},
      {"lidar/spinning/target.ply", 69088, 0, 0, false},
      {"lidar/spinning/car_cloud400.csv", 24989, 0, 0, true},
      {"lidar/spinning/min_cut_segmentation_tutorial.pcd", 9311, 0, 0, false},
      {"lidar/spinning/lamppost.pcd", 1771, 0, 0, false},
      {"meshes/lion.obj", 905, 974, 0, true},
      {"meshes/lion-tri.obj", 905, 1806, 0, true},
      {"meshes/bunnyhead.obj", 1550, 3000, 0, true},
      {"meshes/bimbaPoly.obj", 1896, 2739, 0, true},
      {"meshes/stanford-bunny.obj", 35947, 69451, 0, false},
      {"meshes/fandisk.obj", 6475, 12946, 0, false},
      {"meshes/rocker-arm.obj", 10044, 20088, 0, false},
      {"meshes/mountain.obj", 25600, 50562, 0, false},
      {"meshes/goathead.obj", 2763, 5522, 0, false},
      {"meshes/penguin_control_mesh.obj", 201, 221, 0, false},
      {"meshes/penguin.obj", 3362, 6720, 0, false},
      {"meshes/torus.obj", 2304, 4608, 0, false},
      {"meshes/1.2-with-color.obj", 911, 1672, 0, true},
      {"meshes/points.pcd", 32087, 0, 0, false},
      {"meshes/triangles.txt", 57619, 0, 0, false},  // a list of indices, but text all the same
      {"meshes/spot.ply", 2930, 5856, 0, false},
      {"meshes/elephant.off", 2775, 5558, 0, false},
      {"meshes/anchor_dense.off", 3793, 7598, 0, false},
      {"meshes/octa-flower17k.stl", 17641, 35278, 0, false}};  // faces: its header; points: V = 2 + E - F
  return table;
}

class RealFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(KAPPA_SHARED_DATA)) GTEST_SKIP() << "no real data at " << KAPPA_SHARED_DATA;
  }
  static Scan read(const std::string& name) { return read_scan(std::string(KAPPA_SHARED_DATA "/") + name); }
};

TEST_F(RealFiles, HaveTheirPublishedCounts) {
  for (const Expected& expected : expectations()) {
    SCOPED_TRACE(expected.path);
    const Scan scan = read(expected.path);
    EXPECT_EQ(scan.points.size(), expected.points);
    EXPECT_EQ(scan.faces.size(), expected.faces);
    EXPECT_EQ(scan.normals.size(), expected.has_normals ? expected.points : 0);
    EXPECT_EQ(scan.width, expected.width ? expected.width : expected.points);
    EXPECT_EQ(scan.height, expected.height);
    const auto bad = std::count_if(scan.points.begin(), scan.points.end(), [](const Vec3& p) { return !is_finite(p); });
    EXPECT_EQ(static_cast<std::size_t>(bad), expected.non_finite);
  }
}

/// Files of the folders of the table whose extension is read.
std::set<std::string> files_of_the_data() {
  const std::vector<std::string>& known = readable_extensions();
  std::set<std::string> names;
  for (const std::string folder : {"clouds", "meshes", "lidar/airborne-pcd", "lidar/spinning"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(KAPPA_SHARED_DATA) / folder)) {
      const std::string extension = entry.path().extension().string();
      if (std::find(known.begin(), known.end(), extension) == known.end()) continue;
      names.insert(folder + "/" + entry.path().filename().string());
    }
  }
  return names;
}

TEST_F(RealFiles, AreThoseOfTheTable) {
  std::set<std::string> listed;
  for (const Expected& expected : expectations()) listed.insert(expected.path);
  const std::set<std::string> found = files_of_the_data();
  for (const std::string& name : found) {
    EXPECT_EQ(listed.count(name), 1u) << name << " is in " << KAPPA_SHARED_DATA
                                      << " but not in the table of this test: "
                                      << "add a row with its published counts";
  }
  for (const std::string& name : listed) {
    EXPECT_EQ(found.count(name), 1u) << name << " is in the table of this test but not in " << KAPPA_SHARED_DATA
                                     << ": get the file, or remove its row";
  }
}

TEST_F(RealFiles, GeoreferencedDoublesAreExact) {
  // The extents that the publisher states; a float would miss them by up to 0.25.
  const Scan scan = read("clouds/autzen-utm.pcd");
  const Bounds box = bounds(scan.points);
  EXPECT_DOUBLE_EQ(scan.origin.x() + box.min.x(), 493994.87);
  EXPECT_DOUBLE_EQ(scan.origin.y() + box.max.y(), 4878817.02);
  EXPECT_EQ(scan.fields.size(), 13u);
  ASSERT_NE(scan.field("GpsTime"), nullptr);
  EXPECT_EQ(scan.field("GpsTime")->type, Field::Type::Float64);
  ASSERT_NE(scan.field("Red"), nullptr);
  EXPECT_EQ(scan.field("Red")->type, Field::Type::UInt16);
}

TEST_F(RealFiles, PcdAndPlyOfOneScanAgree) {
  const Scan pcd = read("lidar/spinning/251370668.pcd"), ply = read("lidar/spinning/target.ply");
  ASSERT_EQ(pcd.points.size(), ply.points.size());
  for (std::size_t i = 0; i < pcd.points.size(); ++i) ASSERT_EQ(test::position(pcd, i), test::position(ply, i)) << i;
  ASSERT_NE(pcd.field("intensity"), nullptr);
  ASSERT_NE(ply.field("scalar_intensity"), nullptr);
  EXPECT_EQ(pcd.field("intensity")->values, ply.field("scalar_intensity")->values);
}

TEST_F(RealFiles, MisleadingHeaderOfTheTorusIsIgnored) {
  const Scan scan = read("clouds/torus_010000.pts");
  EXPECT_TRUE(scan.fields.empty());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {  // R = 6, r = 2, outward normals
    const Vec3 p = test::position(scan, i);
    const double to_axis = std::hypot(p.x(), p.y());
    const Vec3 centre = Vec3(p.x(), p.y(), 0) * (6.0 / to_axis);
    ASSERT_NEAR((p - centre - 2.0 * scan.normals[i]).norm(), 0.0, 2e-4) << i;
  }
}

TEST_F(RealFiles, ObjColoursAndLargeCoordinates) {
  const Scan scan = read("meshes/1.2-with-color.obj");
  ASSERT_NE(scan.field("green"), nullptr);
  const Bounds box = bounds(scan.points);
  EXPECT_NEAR(scan.origin.x() + box.min.x(), 635619.88, 0.006);
  EXPECT_NEAR(scan.origin.y() + box.max.y(), 853535.44, 0.006);
}

TEST_F(RealFiles, ExtraFieldsBeforeTheCoordinates) {
  const Scan scan = read("clouds/learn37.pcd");
  ASSERT_EQ(scan.fields.size(), 2u);
  EXPECT_EQ(scan.fields[0].name, "label");
  EXPECT_EQ(scan.fields[1].name, "rgba");
  const Bounds box = bounds(scan.points);
  EXPECT_NEAR(scan.origin.x() + box.min.x(), -0.5984, 1e-4);
  EXPECT_NEAR(scan.origin.z() + box.max.z(), 1.657, 1e-3);
}

}  // namespace
}  // namespace kappa
