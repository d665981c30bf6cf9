// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/Vertices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "kappa/core/types.hpp"
#include "kappa/pcl/point_types.hpp"

namespace kappa::test {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using NormalCloud = pcl::PointCloud<pcl::Normal>;
using Output = pcl::PointCloud<PointCurvature>;

/// A cloud with its true normals.
struct Shape {
  Cloud::Ptr cloud{new Cloud};
  NormalCloud::Ptr normals{new NormalCloud};

  void add(const Vec3& x, const Vec3& u) {
    const Eigen::Vector3f p = x.cast<float>(), n = u.cast<float>();
    cloud->emplace_back(p.x(), p.y(), p.z());
    normals->emplace_back(n.x(), n.y(), n.z());
  }
};

/// Points evenly spread along a spiral on a sphere, outward normals.
inline Shape sphere(double radius, int count) {
  Shape shape;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
    const Vec3 u(r * std::cos(angle), r * std::sin(angle), z);
    shape.add(radius * u, u);
  }
  return shape;
}

/// Grid of `around` x `across` points on a torus of radii R = 3 and r = 1, organised with `across` columns.
inline Shape torus(int around, int across) {
  Shape shape;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * kPi * i / around, b = 2 * kPi * j / across;
      const Vec3 u(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
      shape.add(Vec3(3 * std::cos(a), 3 * std::sin(a), 0) + u, u);
    }
  }
  shape.cloud->width = static_cast<std::uint32_t>(across);
  shape.cloud->height = static_cast<std::uint32_t>(around);
  return shape;
}

/// The quads between the points of `torus`, outward.
inline std::vector<pcl::Vertices> torus_quads(int around, int across) {
  std::vector<pcl::Vertices> quads;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const int i1 = (i + 1) % around, j1 = (j + 1) % across;
      quads.emplace_back();
      quads.back().vertices = {i * across + j, i1 * across + j, i1 * across + j1, i * across + j1};
    }
  }
  return quads;
}

/// Curvatures and position of a point of the torus.
struct TorusTruth {
  double k_min, mean, gaussian;
  Vec3 dir_max;  ///< along the small circle, where k_max = 1
};
inline TorusTruth torus_truth(const PointCurvature& p) {
  const Vec3 x(p.x, p.y, p.z);
  const Vec3 axis = Vec3(x.x(), x.y(), 0).normalized();
  const Vec3 u = (x - 3 * axis).normalized();
  const double k_min = u.dot(axis) / (3 + u.dot(axis));
  return {k_min, (1 + k_min) / 2, k_min, Vec3(0, 0, 1).cross(axis).cross(u)};
}

/// All fields of a point but its position, face count and status, in order.
inline std::array<float, 18> values(const PointCurvature& p) {
  return {p.normal_x,  p.normal_y,  p.normal_z,  p.mean_curvature, p.gaussian_curvature, p.k_min,     p.k_max,
          p.dir_min_x, p.dir_min_y, p.dir_min_z, p.dir_max_x,      p.dir_max_y,          p.dir_max_z, p.mu0,
          p.mu1,       p.mu2,       p.area,      p.coverage};
}

/// Whether two points are equal to the last bit, NaN included.
inline bool same_bits(const PointCurvature& a, const PointCurvature& b) {
  const auto va = values(a), vb = values(b);
  return std::memcmp(va.data(), vb.data(), sizeof va) == 0 && std::memcmp(a.data, b.data, 3 * sizeof(float)) == 0 &&
         a.face_count == b.face_count && a.status == b.status;
}

}  // namespace kappa::test
