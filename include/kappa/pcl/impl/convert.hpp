// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/pcl/convert.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

template <class PointT>
std::vector<Vec3> points_of(const pcl::PointCloud<PointT>& cloud, const Vec3& origin) {
  std::vector<Vec3> points;
  points.reserve(cloud.size());
  for (const PointT& p : cloud.points) points.push_back(Vec3(p.x, p.y, p.z) - origin);
  return points;
}

template <class PointNT>
Normals normals_of(const pcl::PointCloud<PointNT>& cloud) {
  Normals normals;
  normals.reserve(cloud.size());
  for (const PointNT& p : cloud.points) normals.emplace_back(p.normal_x, p.normal_y, p.normal_z);
  return normals;
}

template <class PointT>
Scan to_scan(const pcl::PointCloud<PointT>& cloud) {
  Scan scan;
  scan.points = points_of(cloud);
  if constexpr (pcl::traits::has_normal_v<PointT>) scan.normals = normals_of(cloud);
  const bool organised = cloud.height > 1 && std::size_t{cloud.width} * cloud.height == cloud.size();
  scan.width = organised ? cloud.width : cloud.size();
  scan.height = organised ? cloud.height : 1;
  move_to_local_origin(scan);
  return scan;
}

template <class PointT>
pcl::PointCloud<PointT> to_cloud(const Scan& scan, const Vec3& origin) {
  pcl::PointCloud<PointT> cloud;
  cloud.resize(scan.points.size());
  cloud.is_dense = true;
  const Vec3 shift = scan.origin - origin;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3 x = scan.points[i] + shift;
    cloud[i].getVector3fMap() = x.cast<float>();
    cloud.is_dense = cloud.is_dense && is_finite(x);
    if constexpr (pcl::traits::has_normal_v<PointT>) {
      if (!scan.normals.empty()) cloud[i].getNormalVector3fMap() = scan.normals[i].cast<float>();
    }
  }
  if (scan.is_organised()) {
    cloud.width = static_cast<std::uint32_t>(scan.width);
    cloud.height = static_cast<std::uint32_t>(scan.height);
  }
  return cloud;
}

}  // namespace kappa
