// SPDX-License-Identifier: BSD-3-Clause
#include "ball_sums.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace kappa::test {
namespace {

void add_absolute(const MeasureSum& m, MeasureSum& to) {
  to.area += std::abs(m.area);
  to.mu0 += std::abs(m.mu0);
  to.mu2 += std::abs(m.mu2);
  for (std::size_t k = 0; k < m.mu_sym.size(); ++k) to.mu_sym[k] += std::abs(m.mu_sym[k]);
}

ScaledSum all_triangles(const Triangles& triangles, const std::vector<MeasureSum>& measures, const Vec3& centre,
                        double radius, BallDefinition ball) {
  ScaledSum s;
  for (std::size_t t = 0; t < triangles.size() && is_finite(centre); ++t) {
    BallMeasures one;
    if (!add_triangle_in_ball(triangles, t, measures[t], centre, radius, ball, one)) continue;
    s.ball.sum += one.sum;
    ++s.ball.face_count;
    add_absolute(one.sum, s.scale);
  }
  return s;
}

}  // namespace

std::vector<Vec3> places(const Mesh& mesh, std::size_t count, double spread) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, spread);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& x =
        mesh.vertices[count < mesh.vertices.size() ? random() % mesh.vertices.size() : i % mesh.vertices.size()];
    out.push_back(x);
    out.push_back(x + Vec3(normal(random), normal(random), normal(random)));
  }
  return out;
}

std::vector<BallMeasures> sums(const BallSum& balls, const std::vector<Vec3>& centres, const std::vector<double>& radii,
                               BallDefinition ball, const Execution& run) {
  std::vector<BallMeasures> out(centres.size() * radii.size());
  balls.sum(centres, radii, ball, run, [&](std::size_t query, const BallMeasures* per_radius) {
    std::copy_n(per_radius, radii.size(), out.begin() + static_cast<std::ptrdiff_t>(query * radii.size()));
  });
  return out;
}

std::vector<ScaledSum> brute_force(const Triangles& triangles, const std::vector<Vec3>& centres,
                                   const std::vector<double>& radii, BallDefinition ball) {
  const std::vector<MeasureSum> measures = measure_triangles(triangles);
  std::vector<ScaledSum> out;
  for (const Vec3& centre : centres) {
    for (const double radius : radii) out.push_back(all_triangles(triangles, measures, centre, radius, ball));
  }
  return out;
}

double relative_error(const MeasureSum& got, const ScaledSum& expected) {
  const MeasureSum &sum = expected.ball.sum, &scale = expected.scale;
  const auto relative = [](double difference, double unit) {
    return difference == 0 ? 0.0 : std::abs(difference) / unit;
  };
  double tensor = 0, tensor_scale = 0;
  for (std::size_t k = 0; k < sum.mu_sym.size(); ++k) {
    tensor = std::max(tensor, std::abs(got.mu_sym[k] - sum.mu_sym[k]));
    tensor_scale += scale.mu_sym[k];
  }
  return std::max({relative(got.area - sum.area, scale.area), relative(got.mu0 - sum.mu0, scale.mu0),
                   relative(got.mu2 - sum.mu2, scale.mu2), relative(tensor, tensor_scale)});
}

}  // namespace kappa::test
