// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PolygonMesh.h>
#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/type_traits.h>

#include <vector>

#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/pcl/point_types.hpp"
#include "kappa/scan/scan.hpp"

// PCL's clouds and meshes to kappa's structs and back. PCL keeps float coordinates: a cloud in georeferenced
// coordinates has lost digits before it comes here (0.5 m at a UTM northing), and loses them when it leaves with
// the origin added back. Keep such clouds relative to an origin, as `to_cloud(scan, scan.origin)` makes them.

namespace kappa {

/// Points of `cloud` in double, relative to `origin` (in the coordinates of the cloud); NaN stays NaN.
template <class PointT>
std::vector<Vec3> points_of(const pcl::PointCloud<PointT>& cloud, const Vec3& origin = Vec3::Zero());

/// Normals of `cloud` as they are, neither normalised nor checked.
template <class PointNT>
Normals normals_of(const pcl::PointCloud<PointNT>& cloud);

/// Polygons as faces on `vertex_count` points.
/// @throws Error InvalidData that names the first polygon with a corner out of [0, vertex_count) or with fewer
/// than three corners.
Faces to_faces(const std::vector<pcl::Vertices>& polygons, std::size_t vertex_count);
std::vector<pcl::Vertices> to_polygons(const Faces& faces);

/// A cloud as a scan relative to `choose_origin` of its bounds, with its normals if PointT has them and with its
/// rows and columns; other fields are left out.
template <class PointT>
Scan to_scan(const pcl::PointCloud<PointT>& cloud);

/// A mesh as a scan with faces; its cloud may have coordinates and normals in float or double.
/// @throws Error InvalidData if the cloud has no field x, y or z of one of these types, or as `to_faces` does.
Scan to_scan(const pcl::PolygonMesh& mesh);

/// Points of `scan`, in float and relative to `origin` (in the coordinates of the file), with the normals if both
/// have them, and rows and columns. `is_dense` tells whether all points are finite.
template <class PointT>
pcl::PointCloud<PointT> to_cloud(const Scan& scan, const Vec3& origin = Vec3::Zero());

/// Points (with normals if it has them) and faces of `scan`, in float and relative to `origin`.
pcl::PolygonMesh to_polygon_mesh(const Scan& scan, const Vec3& origin = Vec3::Zero());

/// One sample as a PCL point. `x` and `u` are the position and the unit normal there, kept whatever the status.
void to_point(const CurvatureSample& sample, const Vec3& x, const Vec3& u, PointCurvature& point);

/// The same in PCL's own type: pc1 = k_max with its direction, pc2 = k_min (SPEC: PCL orders the other way round).
void to_point(const CurvatureSample& sample, const Vec3& x, const Vec3& u, pcl::PrincipalCurvatures& point);

/// A field as a cloud, one point a sample. `points` are relative to `from_origin`, the cloud to `to_origin`.
/// `is_dense` tells whether every sample is valid.
/// @throws Error InvalidArgument if sizes differ.
pcl::PointCloud<PointCurvature> to_curvature_cloud(const std::vector<Vec3>& points, const Normals& normals,
                                                   const CurvatureField& field, const Vec3& from_origin = Vec3::Zero(),
                                                   const Vec3& to_origin = Vec3::Zero());

}  // namespace kappa

#include "kappa/pcl/impl/convert.hpp"
