// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>

#include "kappa/pcl/corrected_curvature_estimation.hpp"

/// Points of a spherical spiral, evenly spread over the sphere, with its outward normals.
void make_sphere(float radius, int count, pcl::PointCloud<pcl::PointXYZ>& cloud,
                 pcl::PointCloud<pcl::Normal>& normals) {
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    const pcl::Normal n(static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
                        static_cast<float>(z));
    normals.push_back(n);
    cloud.push_back({radius * n.normal_x, radius * n.normal_y, radius * n.normal_z});
  }
}

int main() {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  make_sphere(2.0F, 2000, *cloud, *normals);

  kappa::CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal> est;
  est.setInputCloud(cloud);
  est.setInputNormals(normals);
  est.setRadiusSearch(0.4);
  est.setNumberOfThreads(0);
  pcl::PointCloud<kappa::PointCurvature> out;
  est.compute(out);
  if (!est.status().ok()) std::cerr << est.status().message() << '\n';

  int wrong = out.size() == cloud->size() ? 0 : 1;
  for (const auto& p : out) {
    if (!(std::abs(p.mean_curvature - 0.5F) < 1e-4F && std::abs(p.gaussian_curvature - 0.25F) < 1e-4F)) ++wrong;
  }
  if (!out.empty()) std::cout << "mean " << out[0].mean_curvature << " of 0.5, " << wrong << " points wrong\n";
  return wrong == 0 ? 0 : 1;
}
