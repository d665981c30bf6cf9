// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa::test {

/// Coordinates as files hold them: decimal numbers of 0 to 4 places around a UTM position.
inline std::vector<Vec3> utm_points(const Vec3& centre, double extent, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> some(-extent, extent);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) {
    Vec3 p = centre + Vec3(some(random), some(random), some(random) / 10);
    const double places = std::pow(10.0, static_cast<double>(i % 5));
    if (i % 7) p = (p * places).array().round() / places;
    points.push_back(p);
  }
  return points;
}

}  // namespace kappa::test
