// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/greedy.hpp"

#include <cmath>
#include <string>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <pcl/surface/impl/gp3.hpp>  // instantiated here: see ground.cpp

#include "kappa/core/error.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/search/neighbours.hpp"

namespace kappa {
namespace {

void check(const std::vector<Vec3>& points, const Normals& normals, const GreedyOptions& options) {
  const auto refuse = [](const std::string& message) {
    throw Error(ErrorCode::InvalidArgument, "greedy projection: " + message);
  };
  if (points.size() != normals.size())
    refuse(std::to_string(points.size()) + " points but " + std::to_string(normals.size()) +
           " normals: give one a point");
  if (!(options.radius >= 0 && std::isfinite(options.radius)))
    refuse("radius " + std::to_string(options.radius) + ": give a positive length, or 0 for five spacings");
  if (!(options.mu > 0 && std::isfinite(options.mu)))
    refuse("mu " + std::to_string(options.mu) + ": give a positive number");
  if (options.neighbours < 3) refuse("neighbours " + std::to_string(options.neighbours) + ": give at least 3");
}

/// The points that PCL is given, and where they come from.
struct Given {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  std::vector<Index> source;
};

Given give(const std::vector<Vec3>& points, const Normals& normals) {
  std::vector<Vec3> rounded;
  for (const Vec3& x : points) rounded.push_back(x.cast<float>().cast<double>());
  const std::vector<Index> distinct = find_duplicates(rounded);
  Given given;
  for (Index i = 0; i < points.size(); ++i) {
    if (distinct[i] != i || normals[i].isZero(0) || !is_finite(normals[i])) continue;
    pcl::PointNormal p;
    p.getVector3fMap() = points[i].cast<float>();
    p.getNormalVector3fMap() = normals[i].cast<float>();
    given.cloud->push_back(p);
    given.source.push_back(i);
  }
  return given;
}

std::vector<pcl::Vertices> triangulate(const Given& given, double radius, const GreedyOptions& options) {
  constexpr double kDegree = kPi / 180;
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
  greedy.setInputCloud(given.cloud);
  greedy.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  greedy.setSearchRadius(radius);
  greedy.setMu(options.mu);
  greedy.setMaximumNearestNeighbors(options.neighbours);
  greedy.setMaximumSurfaceAngle(45 * kDegree);
  greedy.setMinimumAngle(10 * kDegree);
  greedy.setMaximumAngle(120 * kDegree);
  greedy.setNormalConsistency(true);
  std::vector<pcl::Vertices> faces;
  greedy.reconstruct(faces);
  return faces;
}

/// The corners in the points' own numbers, counter-clockwise seen from the side of their normals.
std::vector<Index> turned(const pcl::Vertices& face, const Given& given, const std::vector<Vec3>& points,
                          const Normals& normals) {
  std::vector<Index> c(3);
  for (std::size_t i = 0; i < 3; ++i) c[i] = given.source[static_cast<std::size_t>(face.vertices[i])];
  const Vec3 across = (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]);
  if (across.dot(normals[c[0]] + normals[c[1]] + normals[c[2]]) < 0) std::swap(c[1], c[2]);
  return c;
}

void count(const std::vector<Vec3>& points, const Normals& normals, CloudSurface& surface) {
  std::vector<char> met(points.size(), 0);
  for (std::size_t f = 0; f < surface.mesh.faces.size(); ++f) {
    for (const Index corner : surface.mesh.faces[f]) met[corner] = 1;
  }
  for (Index i = 0; i < points.size(); ++i) {
    const Index twin = surface.representative[i];
    const bool valid = twin != kNoIndex && !normals[i].isZero(0) && is_finite(normals[i]);
    surface.invalid_points += !valid;
    surface.duplicate_points += valid && twin != i;
    surface.starless_points += valid && twin == i && !met[i];
  }
}

}  // namespace

CloudSurface greedy_surface(const Vec3& origin, const std::vector<Vec3>& points, const Normals& normals,
                            const GreedyOptions& options) {
  check(points, normals, options);
  const Given given = give(points, normals);
  if (given.source.empty())
    throw Error(ErrorCode::InvalidData,
                "greedy projection: none of the " + std::to_string(points.size()) +
                    " points has a finite position and a normal; give normals, or use umbrella");
  constexpr double kSpacings = 5;
  const double radius = options.radius > 0 ? options.radius : kSpacings * median_spacing(points);
  CloudSurface surface;
  surface.mesh.origin = origin;
  surface.mesh.vertices = points;
  surface.representative = find_duplicates(points);
  // PCL wants three points at least.
  if (given.source.size() >= 3) {
    for (const pcl::Vertices& face : triangulate(given, radius, options))
      surface.mesh.faces.add(turned(face, given, points, normals));
  }
  count(points, normals, surface);
  return surface;
}

}  // namespace kappa
