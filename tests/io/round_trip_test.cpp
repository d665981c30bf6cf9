// SPDX-License-Identifier: BSD-3-Clause
// What is written comes back bit by bit.
#include <random>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::position;
using test::same_bits;
using test::TemporaryFolder;

constexpr unsigned kSeed = 7;

Field random_field(const std::string& name, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> real(-1.0, 1.0);
  Field field;
  field.name = name;
  for (std::size_t i = 0; i < count; ++i)
    field.values.push_back(std::ldexp(real(random), static_cast<int>(i % 40) - 20));
  field.values[0] = kNaN;
  return field;
}

/// Points at UTM coordinates that no float holds, with normals, directions and typed fields.
Scan georeferenced_scan(std::size_t count) {
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> east(512700.0, 512834.0), north(5403547.0, 5403850.0), up(-3.0, 404.0);
  std::normal_distribution<double> normal;
  Scan scan;
  for (std::size_t i = 0; i < count; ++i) {
    scan.points.emplace_back(east(random), north(random), up(random));
    scan.normals.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  }
  scan.normals[1] = Vec3::Constant(kNaN);
  scan.width = count;
  for (const char* name : {"mean_curvature", "k_min_r0.25", "dir_min_x", "dir_min_y", "dir_min_z", "dir_max_x_r8",
                           "dir_max_y_r8", "dir_max_z_r8", "intensity"}) {
    scan.fields.push_back(random_field(name, count, random));
  }
  Field status{"status", Field::Type::UInt8, {}}, region{"region", Field::Type::UInt32, {}};
  for (std::size_t i = 0; i < count; ++i) {
    status.values.push_back(static_cast<double>(i % 4));
    region.values.push_back(i == 0 ? 4294967295.0 : static_cast<double>(i));
  }
  scan.fields.push_back(status);
  scan.fields.push_back(region);
  return scan;
}

Scan georeferenced_mesh() {
  Scan scan = georeferenced_scan(300);
  std::mt19937_64 random(kSeed);
  std::vector<Index> corners;
  for (std::size_t size = 3; size < 9; ++size) {
    corners.clear();
    for (std::size_t k = 0; k < size; ++k) corners.push_back(static_cast<Index>(random() % 300));
    scan.faces.add(corners);
  }
  return scan;
}

void expect_same_vectors(const Vec3& a, const Vec3& b, std::size_t i) {
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(same_bits(a[k], b[k])) << i << ": " << a[k] << " and " << b[k];
}

void expect_same(const Scan& a, const Scan& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.normals.size(), b.normals.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    expect_same_vectors(position(a, i), position(b, i), i);
    if (!a.normals.empty()) expect_same_vectors(a.normals[i], b.normals[i], i);
  }
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (std::size_t f = 0; f < a.fields.size(); ++f) {
    EXPECT_EQ(a.fields[f].name, b.fields[f].name);
    EXPECT_EQ(a.fields[f].type, b.fields[f].type) << a.fields[f].name;
    for (std::size_t i = 0; i < a.points.size(); ++i) {
      ASSERT_TRUE(same_bits(a.fields[f].values[i], b.fields[f].values[i])) << a.fields[f].name << " " << i;
    }
  }
}

void expect_same_faces(const Scan& a, const Scan& b) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  EXPECT_EQ(a.faces.corners(), b.faces.corners());
  for (std::size_t f = 0; f < a.faces.size(); ++f) EXPECT_EQ(a.faces.offset(f), b.faces.offset(f));
}

Scan written_and_read(const std::string& name, const Scan& scan) {
  const TemporaryFolder folder;
  write_scan(folder.file(name), scan);
  EXPECT_EQ(folder.size(), 1u) << "a temporary file was left";
  return read_scan(folder.file(name));
}

class RoundTrip : public testing::TestWithParam<const char*> {
 protected:
  std::string name() const { return std::string("scan") + GetParam(); }
};

TEST_P(RoundTrip, GeoreferencedCloud) {
  const Scan scan = georeferenced_scan(2000);
  expect_same(scan, written_and_read(name(), scan));
}

TEST_P(RoundTrip, FromALocalOrigin) {
  const Scan scan = georeferenced_scan(2000);
  Scan moved = scan;
  move_to_local_origin(moved);
  ASSERT_GT(moved.origin.norm(), 1e6);
  const Scan back = written_and_read(name(), moved);
  EXPECT_EQ(back.origin, moved.origin);
  expect_same(scan, back);
}

TEST_P(RoundTrip, PointsWithoutReturn) {
  Scan scan = georeferenced_scan(50);
  scan.points[7] = Vec3::Constant(kNaN);
  scan.points[9].z() = -std::numeric_limits<double>::infinity();
  expect_same(scan, written_and_read(name(), scan));
}

TEST_P(RoundTrip, ExtremeNumbers) {
  Scan scan;
  scan.points = {Vec3(-0.0, 5e-324, 1.7976931348623157e308), Vec3(0.1, 1.0 / 3.0, -2.2250738585072014e-308)};
  scan.width = 2;
  expect_same(scan, written_and_read(name(), scan));
}

TEST_P(RoundTrip, Mesh) {
  const std::vector<std::string>& with_faces = writable_mesh_extensions();
  if (std::find(with_faces.begin(), with_faces.end(), GetParam()) == with_faces.end())
    GTEST_SKIP() << "no faces in this format";
  const Scan scan = georeferenced_mesh();
  const Scan back = written_and_read(name(), scan);
  expect_same(scan, back);
  expect_same_faces(scan, back);
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(".csv", ".ply", ".pcd", ".vtp"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

TEST(RoundTripOfPcd, KeepsGridAndViewpoint) {
  Scan scan = georeferenced_scan(60);
  scan.width = 12;
  scan.height = 5;
  scan.viewpoint = Vec3(512700.123456789, 5403547.987654321, 1200.5);
  const Scan back = written_and_read("grid.pcd", scan);
  EXPECT_EQ(back.width, 12u);
  EXPECT_EQ(back.height, 5u);
  ASSERT_TRUE(back.viewpoint.has_value());
  EXPECT_EQ(*back.viewpoint, *scan.viewpoint);
}

TEST(RoundTripOfPly, FaceOfManyCorners) {
  Scan scan = georeferenced_scan(1000);
  std::vector<Index> corners(1000);
  for (Index i = 0; i < 1000; ++i) corners[i] = i;
  scan.faces.add(corners);
  scan.faces.add(0, 1, 2);
  expect_same_faces(scan, written_and_read("large.ply", scan));
}

TEST(RoundTripOfVtp, UsesTheNamesOfVtk) {
  const TemporaryFolder folder;
  write_scan(folder.file("a.vtp"), georeferenced_scan(20));
  const std::string content = test::content_of(folder.file("a.vtp"));
  for (const char* name : {"Mean_Curvature", "Minimum_Curvature_r0.25", "dir_min", "dir_max_r8", "Normals", "status"}) {
    EXPECT_NE(content.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
  EXPECT_EQ(content.find("dir_min_x"), std::string::npos);
  EXPECT_NE(content.find("NumberOfVerts=\"20\""), std::string::npos);  // or ParaView shows nothing
}

TEST(RoundTripOfCsv, HasAHeaderAndExactNumbers) {
  const TemporaryFolder folder;
  Scan scan;
  scan.origin = Vec3(500000, 0, 0);
  scan.points = {Vec3(0.125, 0.1, -2)};
  scan.fields.push_back({"k_min", Field::Type::Float64, {kNaN}});
  scan.fields.push_back({"label", Field::Type::UInt8, {6}});
  write_scan(folder.file("a.csv"), scan);
  EXPECT_EQ(test::content_of(folder.file("a.csv")), "x,y,z,k_min,label\n500000.125,0.1,-2,nan,6\n");
}

}  // namespace
}  // namespace kappa
