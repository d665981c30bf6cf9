// SPDX-License-Identifier: BSD-3-Clause
// Files exchanged with PCL, an independent reader and writer of PCD.
#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <random>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

pcl::PointCloud<pcl::PointNormal> random_cloud() {
  constexpr unsigned kSeed = 3;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> value(-10.f, 10.f);
  pcl::PointCloud<pcl::PointNormal> cloud(80, 60);
  for (pcl::PointNormal& p : cloud) {
    p.getVector3fMap() = Eigen::Vector3f(value(random), 0.25f, value(random));  // a constant compresses
    p.getNormalVector3fMap() = Eigen::Vector3f(0, 0, 1);
    p.curvature = value(random);
  }
  cloud.is_dense = false;
  cloud[5].x = std::numeric_limits<float>::quiet_NaN();
  cloud.sensor_origin_ = Eigen::Vector4f(1, 2, 3, 0);
  return cloud;
}

void expect_equal(const Scan& scan, const pcl::PointCloud<pcl::PointNormal>& cloud, double tolerance) {
  ASSERT_EQ(scan.points.size(), cloud.size());
  EXPECT_EQ(scan.width, 80u);
  EXPECT_EQ(scan.height, 60u);
  EXPECT_EQ(*scan.viewpoint, Vec3(1, 2, 3));
  ASSERT_EQ(scan.normals.size(), cloud.size());
  ASSERT_NE(scan.field("curvature"), nullptr);
  EXPECT_TRUE(std::isnan(scan.points[5].x()));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i == 5) continue;
    ASSERT_LE((test::position(scan, i) - cloud[i].getVector3fMap().cast<double>()).norm(), tolerance) << i;
    ASSERT_LE((scan.normals[i] - cloud[i].getNormalVector3fMap().cast<double>()).norm(), tolerance) << i;
    ASSERT_NEAR(scan.field("curvature")->values[i], static_cast<double>(cloud[i].curvature), tolerance) << i;
  }
}

TEST(PclExchange, ReadsWhatPclWrites) {
  const test::TemporaryFolder folder;
  const auto cloud = random_cloud();
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeASCII(folder.file("ascii.pcd"), cloud, 9), 0);
  ASSERT_EQ(writer.writeBinary(folder.file("binary.pcd"), cloud), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(folder.file("compressed.pcd"), cloud), 0);
  expect_equal(read_scan(folder.file("ascii.pcd")), cloud, 1e-7);
  expect_equal(read_scan(folder.file("binary.pcd")), cloud, 0.0);
  expect_equal(read_scan(folder.file("compressed.pcd")), cloud, 0.0);
}

TEST(PclExchange, WritesWhatPclReads) {
  const test::TemporaryFolder folder;
  Scan scan;
  for (int i = 0; i < 12; ++i) {
    scan.points.emplace_back(512700.123456789 + i, 5403547.987654321, -i);
    scan.normals.push_back(Vec3::UnitZ());
  }
  scan.width = 4;
  scan.height = 3;
  scan.fields.push_back({"label", Field::Type::UInt8, std::vector<double>(12, 6)});
  scan.fields.push_back({"region", Field::Type::UInt32, std::vector<double>(12, 4294967295.0)});
  write_scan(folder.file("a.pcd"), scan);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read(folder.file("a.pcd"), cloud), 0);
  EXPECT_EQ(cloud.width, 4u);
  EXPECT_EQ(cloud.height, 3u);
  ASSERT_EQ(cloud.fields.size(), 8u);
  EXPECT_EQ(cloud.fields[3].name, "normal_x");
  EXPECT_EQ(cloud.fields[0].datatype, pcl::PCLPointField::FLOAT64);
  for (std::size_t i = 0; i < 12; ++i) {
    double x;
    std::uint32_t region;
    std::memcpy(&x, &cloud.data[i * cloud.point_step + cloud.fields[0].offset], sizeof x);
    std::memcpy(&region, &cloud.data[i * cloud.point_step + cloud.fields[7].offset], sizeof region);
    EXPECT_EQ(x, scan.points[i].x());
    EXPECT_EQ(region, 4294967295u);
    EXPECT_EQ(cloud.data[i * cloud.point_step + cloud.fields[6].offset], 6);
  }
}

}  // namespace
}  // namespace kappa
