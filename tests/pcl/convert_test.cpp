// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/convert.hpp"

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <string>

#include "clouds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::test {
namespace {

/// Message of the Error that `call` throws, with its code checked.
template <class Call>
std::string refusal(ErrorCode code, const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    return e.what();
  }
  ADD_FAILURE() << "nothing thrown";
  return "";
}

void expect_message(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(Convert, CloudBecomesAScanRelativeToALocalOrigin) {
  pcl::PointCloud<pcl::PointNormal> cloud(2, 3);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float step = static_cast<float>(i);
    cloud[i].getVector3fMap() = Eigen::Vector3f(500000 + 0.25F * step, 5400000 + 0.5F * step, 100 + step);
    cloud[i].getNormalVector3fMap() = Eigen::Vector3f(step, 2, -3);
  }
  const Scan scan = to_scan(cloud);
  EXPECT_EQ(scan.width, 2U);
  EXPECT_EQ(scan.height, 3U);
  EXPECT_TRUE(scan.faces.empty());
  ASSERT_EQ(scan.points.size(), 6U);
  EXPECT_GT(scan.origin.y(), 5e6);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT(scan.points[i].norm(), 2000);
    EXPECT_EQ(Vec3(scan.points[i] + scan.origin), cloud[i].getVector3fMap().cast<double>());
    EXPECT_EQ(scan.normals[i], Vec3(static_cast<double>(i), 2, -3));
  }
}

TEST(Convert, CloudWithoutNormalsGivesNone) {
  const Scan scan = to_scan(*sphere(1, 10).cloud);
  EXPECT_TRUE(scan.normals.empty());
  EXPECT_FALSE(scan.is_organised());
  EXPECT_EQ(scan.width, 10U);
}

TEST(Convert, ScanBecomesACloudAboutAnyOrigin) {
  Scan scan;
  scan.origin = Vec3(500000, 5400000, 0);
  scan.points = {Vec3(0.125, 0.25, 7), Vec3(1, kNaN, 2), Vec3(3, 4, 5), Vec3(6, 7, 8)};
  scan.normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ()};
  scan.width = scan.height = 2;
  const auto local = to_cloud<pcl::PointNormal>(scan, scan.origin);
  EXPECT_EQ(local.width, 2U);
  EXPECT_EQ(local.height, 2U);
  EXPECT_FALSE(local.is_dense);
  EXPECT_EQ(local[0].y, 0.25F);
  EXPECT_EQ(local[3].normal_z, -1);
  const auto absolute = to_cloud<pcl::PointXYZ>(scan);
  EXPECT_EQ(absolute[2].x, 500003.0F);
  EXPECT_EQ(absolute[0].y, 5400000.0F);  // The quarter is lost in float.
  EXPECT_TRUE(std::isnan(absolute[1].y));
}

TEST(Convert, PolygonsAndFacesGoBothWays) {
  const auto quads = torus_quads(5, 4);
  const Faces faces = to_faces(quads, 20);
  ASSERT_EQ(faces.size(), 20U);
  EXPECT_EQ(faces[3].size(), 4U);
  EXPECT_EQ(faces[3][1], static_cast<Index>(quads[3].vertices[1]));
  const auto back = to_polygons(faces);
  ASSERT_EQ(back.size(), quads.size());
  for (std::size_t i = 0; i < quads.size(); ++i) EXPECT_EQ(back[i].vertices, quads[i].vertices);
}

TEST(Convert, PolygonsOutOfRangeAreNamed) {
  auto quads = torus_quads(5, 4);
  expect_message(refusal(ErrorCode::InvalidData, [&] { to_faces(quads, 19); }), "corner 19 but there are 19 points");
  quads[2].vertices = {1, 2};
  expect_message(refusal(ErrorCode::InvalidData, [&] { to_faces(quads, 20); }), "Polygon 2 has 2 corners");
}

TEST(Convert, MeshGoesBothWays) {
  pcl::PolygonMesh mesh;
  const Shape shape = torus(5, 4);
  pcl::toPCLPointCloud2(*shape.cloud, mesh.cloud);
  mesh.polygons = torus_quads(5, 4);
  Scan scan = to_scan(mesh);
  EXPECT_TRUE(scan.normals.empty());
  EXPECT_EQ(scan.faces.size(), 20U);
  EXPECT_EQ(mesh_of(scan).vertices.size(), 20U);
  scan.normals.assign(20, Vec3(0.25, 0.5, 1));

  const Scan again = to_scan(to_polygon_mesh(scan));
  ASSERT_EQ(again.points.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(Vec3(again.points[i] + again.origin), (*shape.cloud)[i].getVector3fMap().cast<double>());
    EXPECT_EQ(again.normals[i], Vec3(0.25, 0.5, 1));
  }
  EXPECT_EQ(again.faces.corners(), scan.faces.corners());
}

/// A mesh of one point whose three coordinates are doubles.
pcl::PolygonMesh double_mesh(const Vec3& x) {
  pcl::PolygonMesh mesh;
  mesh.cloud.width = mesh.cloud.height = 1;
  mesh.cloud.point_step = mesh.cloud.row_step = sizeof(double) * 3;
  mesh.cloud.data.resize(mesh.cloud.point_step);
  for (int axis = 0; axis < 3; ++axis) {
    pcl::PCLPointField field;
    field.name = std::string(1, "xyz"[axis]);
    field.offset = static_cast<pcl::uindex_t>(axis * 8);
    field.datatype = pcl::PCLPointField::FLOAT64;
    field.count = 1;
    mesh.cloud.fields.push_back(field);
    std::memcpy(&mesh.cloud.data[field.offset], &x[axis], sizeof(double));
  }
  return mesh;
}

TEST(Convert, MeshCoordinatesInDoubleKeepAllDigits) {
  const Vec3 x(500000.123456, 5400000.654321, 0.1);
  const Scan scan = to_scan(double_mesh(x));
  ASSERT_EQ(scan.points.size(), 1U);
  EXPECT_EQ(Vec3(scan.points[0] + scan.origin), x);
}

TEST(Convert, MeshWithoutCoordinatesOrDataIsRefused) {
  pcl::PolygonMesh mesh = double_mesh(Vec3::Zero());
  mesh.cloud.width = 2;
  expect_message(refusal(ErrorCode::InvalidData, [&] { to_scan(mesh); }), "24 bytes for 2 points");
  mesh.cloud.fields[1].name = "intensity";
  expect_message(refusal(ErrorCode::InvalidData, [&] { to_scan(mesh); }), "lacks x, y or z");
}

TEST(PointCurvature, HasTheFieldsOfTheFilesInTheirOrder) {
  pcl::PCLPointCloud2 message;
  pcl::toPCLPointCloud2(Output(1, 1), message);
  std::string names;
  for (const auto& field : message.fields) names += field.name + " ";
  EXPECT_EQ(names,
            "x y z normal_x normal_y normal_z mean_curvature gaussian_curvature k_min k_max dir_min_x dir_min_y "
            "dir_min_z dir_max_x dir_max_y dir_max_z mu0 mu1 mu2 area coverage face_count status ");
  EXPECT_EQ(sizeof(PointCurvature) % 16, 0U);
  EXPECT_TRUE(pcl::traits::has_normal_v<PointCurvature>);
  EXPECT_TRUE(pcl::traits::has_xyz_v<PointCurvature>);
}

TEST(PointCurvature, IsInvalidUntilItIsFilled) {
  const PointCurvature p;
  EXPECT_TRUE(std::isnan(p.x) && std::isnan(p.normal_z) && std::isnan(p.k_min) && std::isnan(p.coverage));
  EXPECT_EQ(p.status, static_cast<int>(PointStatus::Invalid));
  EXPECT_EQ(p.data[3], 1);
}

/// A sample whose values are all different.
CurvatureSample sample() {
  CurvatureSample s;
  s.k = {1, 2, 3, 4, Vec3(5, 6, 7), Vec3(8, 9, 10), PointStatus::Valid};
  s.mu0 = 11;
  s.mu1 = 12;
  s.mu2 = 13;
  s.area = 14;
  s.coverage = 15;
  s.face_count = 4000000000U;
  return s;
}

TEST(PointCurvature, HoldsEveryValueOfASampleThroughPclsMessage) {
  CurvatureField field;
  field.samples = {sample(), CurvatureSample{}};
  field.samples[1].k.status = PointStatus::Degenerate;
  const Output cloud =
      to_curvature_cloud({Vec3(1, 2, 3), Vec3(4, 5, 6)}, {Vec3::UnitX(), Vec3::UnitY()}, field, Vec3(10, 20, 30));
  EXPECT_FALSE(cloud.is_dense);

  pcl::PCLPointCloud2 message;
  pcl::toPCLPointCloud2(cloud, message);
  Output back;
  pcl::fromPCLPointCloud2(message, back);
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(same_bits(back[i], cloud[i]));
  EXPECT_EQ(back[0].x, 11);
  EXPECT_EQ(back[0].face_count, 4000000000U);
  EXPECT_EQ(back[1].status, static_cast<int>(PointStatus::Degenerate));
  const std::array<float, 18> expected = {1, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  EXPECT_EQ(values(back[0]), expected);
}

TEST(PointCurvature, FieldOfAnotherSizeIsRefused) {
  CurvatureField field;
  field.samples.resize(2);
  const std::vector<Vec3> two(2, Vec3::Zero()), one(1, Vec3::Zero());
  expect_message(refusal(ErrorCode::InvalidArgument, [&] { to_curvature_cloud(one, two, field); }), "1 points");
  expect_message(refusal(ErrorCode::InvalidArgument, [&] { to_curvature_cloud(two, one, field); }), "1 normals");
}

TEST(ToPoint, PrincipalCurvaturesPutTheLargestFirst) {
  pcl::PrincipalCurvatures p;
  to_point(sample(), Vec3::Zero(), Vec3::Zero(), p);
  EXPECT_EQ(p.pc1, 4);
  EXPECT_EQ(p.pc2, 3);
  EXPECT_EQ(p.principal_curvature[0], 8);
  EXPECT_EQ(p.principal_curvature[2], 10);
}

}  // namespace
}  // namespace kappa::test
