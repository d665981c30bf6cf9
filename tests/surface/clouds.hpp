// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/shapes/truth.hpp"

/// Clouds and comparisons for the tests of scans.
namespace kappa::clouds {

/// Random points of a torus around z with R = 6, r = 2, uniform by area, with outward normals and true curvatures.
std::vector<SurfacePoint> torus(std::size_t count, std::uint64_t seed);

/// Random points of a sphere around the origin, normals outward.
std::vector<SurfacePoint> sphere(double radius, std::size_t count, std::uint64_t seed);

std::vector<Vec3> positions(const std::vector<SurfacePoint>& points);
Normals normals(const std::vector<SurfacePoint>& points);

/// f = (sqrt(x^2 + y^2) - R)^2 + z^2 - r^2 of the torus, with R = 6, r = 2.
ImplicitJet torus_function(const Vec3& x);

/// A text cloud x y z nx ny nz after one line of header; empty if there is no such file.
struct TextCloud {
  std::vector<Vec3> x;
  Normals u;
};
TextCloud read_text(const std::string& path);

/// Code and message of the Error that `call` throws.
struct Refusal {
  ErrorCode code{};
  std::string message;
};
Refusal refusal(const std::function<void()>& call);

/// Faces of two meshes in the same order with the same corners.
bool same_faces(const Mesh& a, const Mesh& b);

/// Area vector of the triangle `face`: its length is twice the area.
Vec3 area_vector(const Mesh& mesh, std::size_t face);

}  // namespace kappa::clouds
