// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "kappa/core/curvatures.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"

int main() {
  // A triangle on a sphere of radius 2, with the sphere's normals.
  const double radius = 2;
  const kappa::Vec3 a = radius * kappa::Vec3(0, 0, 1), b = radius * kappa::Vec3(0.6, 0, 0.8),
                    c = radius * kappa::Vec3(0, 0.6, 0.8);
  const kappa::Vec3 ua = a / radius, ub = b / radius, uc = c / radius;

  const kappa::Measures m = kappa::triangle_measures({a, b, c}, {ua, ub, uc});
  const kappa::Curvatures k = kappa::curvatures(m, (ua + ub + uc).normalized());
  std::printf("mean %.15g of %.15g, gaussian %.15g of %.15g\n", k.mean, 1 / radius, k.gaussian, 1 / (radius * radius));

  const bool right = std::abs(k.mean - 0.5) < 1e-14 && std::abs(k.gaussian - 0.25) < 1e-14;
  // Needs the thread library at link time.
  const bool threads = kappa::thread_count({}) == 1;
  return right && threads ? 0 : 1;
}
