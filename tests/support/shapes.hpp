// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "kappa/mesh/mesh.hpp"

/// Small meshes with the truth beside them, for the tests alone.
namespace kappa::shapes {

/// A mesh with the true normals and curvatures at its vertices.
struct Shape {
  Mesh mesh;
  Normals normals;
  std::vector<double> mean, gaussian, k_min, k_max;
};

/// Vertices, true normals and curvatures of a torus of radii R and r around z, cut in `slices` x `rings` quads of two
/// triangles each, normals outward.
Shape torus(double R, double r, int slices, int rings);

/// Sphere from an octahedron refined `levels` times; unit normals x / radius.
Shape sphere(double radius, int levels);

/// `count` triangles with random corners on a sphere: they cross, overlap and share nothing or single corners.
/// Normals are x / radius; faces turn outward.
Shape sphere_soup(double radius, int count, std::uint64_t seed);

/// Open cylinder around z with `n` x `m` quads split in two; with `twist` 0.5 rings alternate as in Schwarz's lantern.
Shape cylinder(double radius, double height, int n, int m, double twist = 0);

/// A wavy sheet of 8 x 8 quads with normals of their own; no curvatures.
Shape wavy_quads();

/// The flat square [0, 1]^2 of n x n vertices, normals up.
Shape square(int n);

/// Moebius band of `n` quads in two triangles each.
Mesh moebius(int n);

Mesh tetrahedron();

/// A fan of `n` triangles around vertex 0, at random heights: an irregular cone.
Mesh fan(int n, std::uint64_t seed);

/// Each face in four, a normal at a midpoint being the mean of two and not renormalised.
Shape subdivided(const Shape& shape);

/// The same faces turned the other way, normals kept.
Mesh reversed(const Mesh& mesh);

/// One ill-behaved mesh of the zoo.
struct Specimen {
  std::string name;
  Mesh mesh;
  Normals normals;
};

/// Three sheets on an edge, a bow tie, duplicate and opposite faces, zero-area faces (collinear, coincident, repeated
/// corners), isolated vertices, a triangle 1e4 times the others, a soup, mixed polygons, NaN corners, weights.
std::vector<Specimen> zoo();

}  // namespace kappa::shapes
