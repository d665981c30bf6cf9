// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/ground.hpp"

#include <cmath>
#include <string>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/progressive_morphological_filter.h>

// Instantiated here: the library that has the filter brings four others, whose symbols took most of the time in which
// the program starts.
#include <pcl/filters/impl/morphological_filter.hpp>
#include <pcl/segmentation/impl/progressive_morphological_filter.hpp>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

void check(const char* name, double value, double least) {
  if (std::isfinite(value) && value >= least && (value > 0 || least == 0)) return;
  throw Error(ErrorCode::InvalidArgument, std::string("the progressive ground filter's ") + name + " is " +
                                              std::to_string(value) + ": give a positive number");
}

void check(const ProgressiveGroundOptions& options) {
  constexpr double kPositive = std::numeric_limits<double>::min();
  check("cell", options.cell, kPositive);
  check("window", options.window, 1);
  check("max distance", options.max_distance, kPositive);
  check("slope", options.slope, 0);
  check("initial distance", options.initial_distance, 0);
}

}  // namespace

std::vector<char> find_ground_progressively(const std::vector<Vec3>& points, const ProgressiveGroundOptions& options) {
  check(options);
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  std::vector<std::size_t> source;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const Eigen::Vector3f p = points[i].cast<float>();
    cloud->push_back({p.x(), p.y(), p.z()});
    source.push_back(i);
  }
  std::vector<char> ground(points.size(), 0);
  if (source.empty()) return ground;
  pcl::ProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(static_cast<float>(options.cell));
  filter.setSlope(static_cast<float>(options.slope));
  filter.setMaxWindowSize(options.window);
  filter.setInitialDistance(static_cast<float>(options.initial_distance));
  filter.setMaxDistance(static_cast<float>(options.max_distance));
  pcl::Indices kept;
  filter.extract(kept);
  for (const auto k : kept) ground[source[static_cast<std::size_t>(k)]] = 1;
  return ground;
}

std::vector<char> progressive_ground(const std::vector<Vec3>& points, const GroundFilter& filter, double metre) {
  ProgressiveGroundOptions options;
  options.cell = filter.cell.value_or(options.cell * metre);
  options.slope = filter.slope.value_or(options.slope);
  options.window = static_cast<int>(std::lround(filter.window.value_or(options.window * metre)));
  options.initial_distance = filter.threshold.value_or(options.initial_distance * metre);
  options.max_distance = filter.max_rise.value_or(options.max_distance * metre);
  return find_ground_progressively(points, options);
}

}  // namespace kappa
