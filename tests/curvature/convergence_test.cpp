// SPDX-License-Identifier: BSD-3-Clause
// Slopes of the error on finer and finer meshes, and totals over closed ones.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/normals.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

struct Errors {
  double mean = 0, k_min = 0, k_max = 0;
};

Errors l2_errors(const Shape& s, const Normals& u) {
  const CurvatureField f = curvatures_at_vertices(BruteForceBallSum(triangles_of(s.mesh, u)), u, VertexLimit::Star);
  Errors e;
  for (std::size_t i = 0; i < f.samples.size(); ++i) {
    const Curvatures& k = f.samples[i].k;
    e.mean += std::pow(k.mean - s.mean[i], 2);
    e.k_min += std::pow(k.k_min - s.k_min[i], 2);
    e.k_max += std::pow(k.k_max - s.k_max[i], 2);
  }
  const double n = static_cast<double>(f.samples.size());
  return {std::sqrt(e.mean / n), std::sqrt(e.k_min / n), std::sqrt(e.k_max / n)};
}

/// Order of convergence: minus the slope of log(error) over log(slices) by least squares.
double order(const std::vector<int>& slices, const std::vector<double>& errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(slices.size());
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const double x = std::log(slices[i]), y = std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return -(n * sxy - sx * sy) / (n * sxx - sx * sx);
}

enum class Kind { True, Geometric, Max };

Normals normals_of(const Shape& s, Kind kind) {
  if (kind == Kind::True) return s.normals;
  return vertex_normals(s.mesh, kind == Kind::Max ? NormalWeights::Max : NormalWeights::Uniform);
}

class TorusSlopes : public ::testing::TestWithParam<Kind> {};

TEST_P(TorusSlopes, SecondOrderAtRadiusZero) {
  const std::vector<int> slices = {16, 32, 64, 128, 256};
  std::vector<double> mean, k_min, k_max;
  for (const int m : slices) {
    const Shape s = shapes::torus(3, 1, m, m);
    const Errors e = l2_errors(s, normals_of(s, GetParam()));
    mean.push_back(e.mean);
    k_min.push_back(e.k_min);
    k_max.push_back(e.k_max);
  }
  EXPECT_GE(order(slices, mean), 1.9) << "mean, finest error " << mean.back();
  EXPECT_GE(order(slices, k_min), 1.9) << "k_min, finest error " << k_min.back();
  EXPECT_GE(order(slices, k_max), 1.9) << "k_max, finest error " << k_max.back();
  EXPECT_LT(mean.back(), 1e-3);
  EXPECT_LT(k_max.back(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Normals, TorusSlopes, ::testing::Values(Kind::True, Kind::Geometric, Kind::Max));

double total_gaussian(const Mesh& mesh, const Normals& u) {
  double sum = 0;
  for (const MeasureSum& m : measure_triangles(triangles_of(mesh, u))) sum += m.mu2;
  return sum;
}

/// 3 x signed volume of the polyhedron of the normals, by the cones from an arbitrary apex.
double three_volumes(const Mesh& mesh, const Normals& u, const Vec3& apex) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Faces::View v = mesh.faces[f];
    sum += (u[v[0]] - apex).dot((u[v[1]] - apex).cross(u[v[2]] - apex)) / 2;
  }
  return sum;
}

TEST(GaussBonnet, TotalIsThreeVolumesOfTheNormals) {
  const Shape torus = shapes::torus(3, 1, 24, 16), sphere = shapes::sphere(2, 3);
  for (const Shape* s : {&torus, &sphere}) {
    for (const Normals& u : {s->normals, vertex_normals(s->mesh, NormalWeights::Area)}) {
      EXPECT_NEAR(total_gaussian(s->mesh, u), three_volumes(s->mesh, u, Vec3(0.3, -0.7, 2)), 1e-12);
    }
  }
}

TEST(GaussBonnet, TotalConvergesToTheEulerCharacteristic) {
  double before = 0;
  for (const int levels : {2, 3, 4, 5}) {
    const Shape s = shapes::sphere(2, levels);
    const double error = std::abs(total_gaussian(s.mesh, s.normals) - 4 * kPi);
    if (before > 0) {
      EXPECT_NEAR(before / error, 4, 0.3) << "second order in the edge length";
    }
    before = error;
  }
  for (const int m : {16, 64}) {
    const Shape s = shapes::torus(3, 1, m, m);
    EXPECT_NEAR(total_gaussian(s.mesh, s.normals), 0, 1e-12);
    const Normals u = vertex_normals(s.mesh, NormalWeights::Uniform);
    EXPECT_NEAR(total_gaussian(s.mesh, u), 0, 40.0 / (m * m));
  }
}

}  // namespace
}  // namespace kappa
