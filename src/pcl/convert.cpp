// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/convert.hpp"

#include <pcl/conversions.h>

#include <cstring>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

namespace {

using Column = const pcl::PCLPointField*;

Column find_column(const pcl::PCLPointCloud2& cloud, const char* name) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    const bool real = field.datatype == pcl::PCLPointField::FLOAT32 || field.datatype == pcl::PCLPointField::FLOAT64;
    if (field.name == name && real) return &field;
  }
  return nullptr;
}

double value_at(const pcl::PCLPointCloud2& cloud, std::size_t point, Column column) {
  const auto* bytes = cloud.data.data() + point * cloud.point_step + column->offset;
  if (column->datatype == pcl::PCLPointField::FLOAT64) {
    double value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  float value = 0;
  std::memcpy(&value, bytes, sizeof value);
  return double{value};
}

/// Vectors of three columns, none if a column is missing.
std::vector<Vec3> vectors(const pcl::PCLPointCloud2& cloud, const char* x, const char* y, const char* z) {
  const Column columns[3] = {find_column(cloud, x), find_column(cloud, y), find_column(cloud, z)};
  if (!columns[0] || !columns[1] || !columns[2]) return {};
  std::vector<Vec3> result(std::size_t{cloud.width} * cloud.height);
  if (cloud.data.size() < result.size() * cloud.point_step) {
    throw Error(ErrorCode::InvalidData, "The cloud of the polygon mesh has " + std::to_string(cloud.data.size()) +
                                            " bytes for " + std::to_string(result.size()) +
                                            " points: fill its data, or correct width and height.");
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) result[i][axis] = value_at(cloud, i, columns[axis]);
  }
  return result;
}

template <class PointT>
void set_cloud(const Scan& scan, const Vec3& origin, pcl::PolygonMesh& mesh) {
  pcl::toPCLPointCloud2(to_cloud<PointT>(scan, origin), mesh.cloud);
}

void set(const Vec3& v, float& x, float& y, float& z) {
  x = static_cast<float>(v.x());
  y = static_cast<float>(v.y());
  z = static_cast<float>(v.z());
}

[[noreturn]] void refuse_polygon(std::size_t polygon, const std::string& why) {
  throw Error(ErrorCode::InvalidData, "Polygon " + std::to_string(polygon) + " " + why);
}

}  // namespace

Faces to_faces(const std::vector<pcl::Vertices>& polygons, std::size_t vertex_count) {
  Faces faces;
  std::vector<Index> corners;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto& vertices = polygons[i].vertices;
    if (vertices.size() < 3) {
      refuse_polygon(i, "has " + std::to_string(vertices.size()) + " corners: leave it out, a face has three or more.");
    }
    corners.clear();
    for (const pcl::index_t v : vertices) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertex_count) {
        refuse_polygon(i, "has corner " + std::to_string(v) + " but there are " + std::to_string(vertex_count) +
                              " points: polygons index the points of the search surface.");
      }
      corners.push_back(static_cast<Index>(v));
    }
    faces.add(corners);
  }
  return faces;
}

std::vector<pcl::Vertices> to_polygons(const Faces& faces) {
  std::vector<pcl::Vertices> polygons(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) polygons[i].vertices.assign(faces[i].begin(), faces[i].end());
  return polygons;
}

Scan to_scan(const pcl::PolygonMesh& mesh) {
  Scan scan;
  scan.points = vectors(mesh.cloud, "x", "y", "z");
  if (scan.points.empty() && std::size_t{mesh.cloud.width} * mesh.cloud.height > 0) {
    throw Error(ErrorCode::InvalidData,
                "The cloud of the polygon mesh lacks x, y or z as float or double: give it these fields.");
  }
  scan.normals = vectors(mesh.cloud, "normal_x", "normal_y", "normal_z");
  scan.faces = to_faces(mesh.polygons, scan.points.size());
  scan.width = scan.points.size();
  move_to_local_origin(scan);
  return scan;
}

pcl::PolygonMesh to_polygon_mesh(const Scan& scan, const Vec3& origin) {
  pcl::PolygonMesh mesh;
  if (scan.normals.empty()) {
    set_cloud<pcl::PointXYZ>(scan, origin, mesh);
  } else {
    set_cloud<pcl::PointNormal>(scan, origin, mesh);
  }
  mesh.polygons = to_polygons(scan.faces);
  return mesh;
}

void to_point(const CurvatureSample& sample, const Vec3& x, const Vec3& u, PointCurvature& point) {
  const auto narrow = [](double value) { return static_cast<float>(value); };
  set(x, point.x, point.y, point.z);
  set(u, point.normal_x, point.normal_y, point.normal_z);
  point.mean_curvature = narrow(sample.k.mean);
  point.gaussian_curvature = narrow(sample.k.gaussian);
  point.k_min = narrow(sample.k.k_min);
  point.k_max = narrow(sample.k.k_max);
  set(sample.k.dir_min, point.dir_min_x, point.dir_min_y, point.dir_min_z);
  set(sample.k.dir_max, point.dir_max_x, point.dir_max_y, point.dir_max_z);
  point.mu0 = narrow(sample.mu0);
  point.mu1 = narrow(sample.mu1);
  point.mu2 = narrow(sample.mu2);
  point.area = narrow(sample.area);
  point.coverage = narrow(sample.coverage);
  point.face_count = sample.face_count;
  point.status = static_cast<std::uint8_t>(sample.k.status);
}

void to_point(const CurvatureSample& sample, const Vec3&, const Vec3&, pcl::PrincipalCurvatures& point) {
  set(sample.k.dir_max, point.principal_curvature_x, point.principal_curvature_y, point.principal_curvature_z);
  point.pc1 = static_cast<float>(sample.k.k_max);
  point.pc2 = static_cast<float>(sample.k.k_min);
}

pcl::PointCloud<PointCurvature> to_curvature_cloud(const std::vector<Vec3>& points, const Normals& normals,
                                                   const CurvatureField& field, const Vec3& from_origin,
                                                   const Vec3& to_origin) {
  const std::size_t count = field.samples.size();
  if (points.size() != count || normals.size() != count) {
    throw Error(ErrorCode::InvalidArgument, "There are " + std::to_string(points.size()) + " points and " +
                                                std::to_string(normals.size()) + " normals for " +
                                                std::to_string(count) + " samples: give one of each a sample.");
  }
  pcl::PointCloud<PointCurvature> cloud;
  cloud.resize(count);
  cloud.is_dense = true;
  const Vec3 shift = from_origin - to_origin;
  for (std::size_t i = 0; i < count; ++i) {
    to_point(field.samples[i], points[i] + shift, normals[i], cloud[i]);
    if (field.samples[i].k.status != PointStatus::Valid) cloud.is_dense = false;
  }
  return cloud;
}

}  // namespace kappa
