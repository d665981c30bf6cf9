// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <sstream>

#include "kappa/shapes/random.hpp"

namespace kappa::clouds {

ImplicitJet torus_function(const Vec3& x) {
  constexpr double R = 6, r = 2;
  const double s = std::hypot(x.x(), x.y()), a = (s - R) / s, b = R / (s * s * s);
  ImplicitJet jet;
  jet.value = (s - R) * (s - R) + x.z() * x.z() - r * r;
  jet.gradient = 2 * Vec3(a * x.x(), a * x.y(), x.z());
  jet.hessian.setZero();
  jet.hessian(0, 0) = 2 * (a + b * x.x() * x.x());
  jet.hessian(1, 1) = 2 * (a + b * x.y() * x.y());
  jet.hessian(0, 1) = jet.hessian(1, 0) = 2 * b * x.x() * x.y();
  jet.hessian(2, 2) = 2;
  return jet;
}

std::vector<SurfacePoint> torus(std::size_t count, std::uint64_t seed) {
  constexpr double R = 6, r = 2;
  Random random(seed);
  std::vector<SurfacePoint> points;
  while (points.size() < count) {
    const double a = random.uniform(0, 2 * kPi), b = random.uniform(0, 2 * kPi);
    if (random.uniform(0, R + r) > R + r * std::cos(b)) continue;
    const double s = R + r * std::cos(b);
    const Vec3 x(s * std::cos(a), s * std::sin(a), r * std::sin(b));
    points.push_back(surface_point(x, torus_function(x)));
  }
  return points;
}

std::vector<SurfacePoint> sphere(double radius, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<SurfacePoint> points(count);
  for (SurfacePoint& p : points) {
    p.normal = random.direction();
    p.x = radius * p.normal;
    p.curvature.mean = p.curvature.k_min = p.curvature.k_max = 1 / radius;
    p.curvature.gaussian = 1 / (radius * radius);
  }
  return points;
}

std::vector<Vec3> positions(const std::vector<SurfacePoint>& points) {
  std::vector<Vec3> x;
  for (const SurfacePoint& p : points) x.push_back(p.x);
  return x;
}

Normals normals(const std::vector<SurfacePoint>& points) {
  Normals u;
  for (const SurfacePoint& p : points) u.push_back(p.normal);
  return u;
}

TextCloud read_text(const std::string& path) {
  TextCloud cloud;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream words(line);
    Vec3 x, u;
    if (!(words >> x[0] >> x[1] >> x[2] >> u[0] >> u[1] >> u[2])) continue;
    cloud.x.push_back(x);
    cloud.u.push_back(u);
  }
  return cloud;
}

Refusal refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {};
}

bool same_faces(const Mesh& a, const Mesh& b) {
  return a.faces.size() == b.faces.size() && a.faces.corners() == b.faces.corners();
}

Vec3 area_vector(const Mesh& mesh, std::size_t face) {
  const auto f = mesh.faces[face];
  return (mesh.vertices[f[1]] - mesh.vertices[f[0]]).cross(mesh.vertices[f[2]] - mesh.vertices[f[0]]);
}

}  // namespace kappa::clouds
