// SPDX-License-Identifier: BSD-3-Clause
// Which corners the triangles of a point have, against plain computations.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "clouds.hpp"
#include "kappa/core/measures.hpp"
#include "kappa/surface/random_triangles.hpp"

namespace kappa {
namespace {

/// The K points nearest to point i, itself first, by comparing all.
std::vector<std::size_t> nearest(const std::vector<Vec3>& x, std::size_t i, std::size_t k) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return (x[a] - x[i]).squaredNorm() < (x[b] - x[i]).squaredNorm(); });
  order.resize(k);
  return order;
}

/// The rim of a cap: points around it have no neighbour on one side.
std::vector<SurfacePoint> cap_of_torus() {
  std::vector<SurfacePoint> cap = clouds::torus(600, 11);
  cap.erase(std::remove_if(cap.begin(), cap.end(), [](const SurfacePoint& p) { return p.x.z() < 1; }), cap.end());
  return cap;
}

/// The six targets around point i: at the mean distance of its neighbours, 60 degrees apart.
std::array<Vec3, 6> targets(const std::vector<Vec3>& x, const Normals& u, const std::vector<std::size_t>& near) {
  const Vec3& centre = x[near.front()];
  double distance = 0;
  Vec3 u_sum = Vec3::Zero();
  for (const std::size_t j : near) {
    distance += (x[j] - centre).norm() / static_cast<double>(near.size());
    u_sum += u[j];
  }
  Vec3 t1, t2;
  tangent_basis((0.5 * u[near.front()] + 0.5 * u_sum.normalized()).normalized(), t1, t2);
  std::array<Vec3, 6> all;
  for (int k = 0; k < 6; ++k)
    all[static_cast<std::size_t>(k)] = centre + distance * (std::cos(k * kPi / 3) * t1 + std::sin(k * kPi / 3) * t2);
  return all;
}

/// Corners of the triangles 0 2 4 and 1 3 5 as the paper has them.
struct Corners {
  std::array<Vec3, 6> x, u;
};

/// Nearest to each target; the point itself counts.
Corners nearest_corners(const std::vector<Vec3>& x, const Normals& u, const std::vector<std::size_t>& near) {
  const std::array<Vec3, 6> target = targets(x, u, near);
  Corners corners;
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t best = *std::min_element(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
      return (x[a] - target[k]).norm() < (x[b] - target[k]).norm();
    });
    corners.x[k] = x[best];
    corners.u[k] = u[best];
  }
  return corners;
}

/// Averages over the sectors; the point itself, equally far from all targets, counts to the first.
Corners averaged_corners(const std::vector<Vec3>& x, const Normals& u, const std::vector<std::size_t>& near) {
  const std::array<Vec3, 6> target = targets(x, u, near);
  std::array<std::vector<std::size_t>, 6> sector;
  sector[0].push_back(near.front());
  for (std::size_t n = 1; n < near.size(); ++n) {
    const auto best = std::min_element(target.begin(), target.end(), [&](const Vec3& a, const Vec3& b) {
      return (x[near[n]] - a).norm() < (x[near[n]] - b).norm();
    });
    sector[static_cast<std::size_t>(best - target.begin())].push_back(near[n]);
  }
  Corners corners;
  for (std::size_t k = 0; k < 6; ++k) {
    corners.x[k] = corners.u[k] = Vec3::Zero();
    for (const std::size_t j : sector[k]) {
      corners.x[k] += x[j] / static_cast<double>(sector[k].size());
      corners.u[k] += u[j];
    }
    if (sector[k].empty()) corners.x[k] = x[near.front()];
    corners.u[k] = sector[k].empty() ? u[near.front()] : Vec3(corners.u[k].normalized());
  }
  return corners;
}

/// Sum of the two triangles, each turned to a positive corrected area; those without an area add nothing.
Measures measures_of(const Corners& c) {
  Measures sum;
  for (const std::size_t first : {0U, 1U}) {
    const std::size_t i = first, j = first + 2, k = first + 4;
    Measures m = triangle_measures({c.x[i], c.x[j], c.x[k]}, {c.u[i], c.u[j], c.u[k]});
    if (m.mu0 < 0) m = triangle_measures({c.x[i], c.x[k], c.x[j]}, {c.u[i], c.u[k], c.u[j]});
    constexpr double kNoArea = 1e-12;
    if (m.mu0 > kNoArea) sum += m;
  }
  return sum;
}

void expect_sample(const CurvatureSample& s, const Measures& m, const Vec3& u) {
  if (m.area == 0) {
    EXPECT_EQ(s.k.status, PointStatus::Empty);
    return;
  }
  const Curvatures k = curvatures(m, u);
  ASSERT_EQ(s.k.status, k.status);
  EXPECT_NEAR(s.area, m.area, 1e-12 * m.area);
  EXPECT_NEAR(s.mu0, m.mu0, 1e-12 * m.area);
  EXPECT_NEAR(s.mu1, m.mu1, 1e-12 * m.area);
  EXPECT_NEAR(s.mu2, m.mu2, 1e-12 * m.area);
  const double size = 1e-9 * (1 + std::abs(k.k_min) + std::abs(k.k_max));
  EXPECT_NEAR(s.k.k_min, k.k_min, size);
  EXPECT_NEAR(s.k.k_max, k.k_max, size);
}

TEST(RandomTriangles, HexagramsAreThoseOfAPlainComputation) {
  for (const std::size_t neighbours : {6U, 20U}) {
    const auto cloud = cap_of_torus();
    const std::vector<Vec3> x = clouds::positions(cloud);
    const Normals u = clouds::normals(cloud);
    const int k = static_cast<int>(neighbours);
    const CurvatureField plain = random_triangle_curvatures(x, u, {TriangleScheme::Hexagram, k, 1});
    const CurvatureField averaged = random_triangle_curvatures(x, u, {TriangleScheme::AveragedHexagram, k, 1});
    for (std::size_t i = 0; i < x.size(); ++i) {
      SCOPED_TRACE("point " + std::to_string(i) + ", K = " + std::to_string(k));
      const std::vector<std::size_t> near = nearest(x, i, neighbours);
      expect_sample(plain.samples[i], measures_of(nearest_corners(x, u, near)), u[i]);
      expect_sample(averaged.samples[i], measures_of(averaged_corners(x, u, near)), u[i]);
    }
  }
}

/// Of four neighbours one triangle leaves out each equally often, to four standard deviations.
TEST(RandomTriangles, IndependentLeavesOutEveryNeighbourAlike) {
  const auto cloud = clouds::torus(2000, 13);
  const std::vector<Vec3> x = clouds::positions(cloud);
  const CurvatureField f = random_triangle_curvatures(x, clouds::normals(cloud), {TriangleScheme::Independent, 4, 100});
  std::array<int, 4> left_out{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const std::vector<std::size_t> near = nearest(x, i, 4);
    std::array<double, 4> difference{};
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3 &a = x[near[(n + 1) % 4]], &b = x[near[(n + 2) % 4]], &c = x[near[(n + 3) % 4]];
      difference[n] = std::abs(0.5 * (b - a).cross(c - a).norm() - f.samples[i].area);
    }
    ++left_out[static_cast<std::size_t>(std::min_element(difference.begin(), difference.end()) - difference.begin())];
  }
  for (const int count : left_out) EXPECT_NEAR(count, 500, 4 * std::sqrt(2000 * 0.25 * 0.75));
}

/// The two triangles of six neighbours share no corner: their areas add up as in one of the ten ways to halve six.
TEST(RandomTriangles, IndependentTrianglesShareNoCorner) {
  const auto cloud = clouds::torus(300, 15);
  const std::vector<Vec3> x = clouds::positions(cloud);
  const CurvatureField f = random_triangle_curvatures(x, clouds::normals(cloud), {TriangleScheme::Independent, 6, 100});
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<std::size_t> near = nearest(x, i, 6);
    const auto area = [&](std::size_t first) {
      const Vec3 e1 = x[near[first + 1]] - x[near[first]], e2 = x[near[first + 2]] - x[near[first]];
      return 0.5 * e1.cross(e2).norm();
    };
    double difference = 1;
    std::sort(near.begin(), near.end());
    do {
      difference = std::min(difference, std::abs(area(0) + area(3) - f.samples[i].area));
    } while (std::next_permutation(near.begin(), near.end()));
    EXPECT_LT(difference, 1e-12);
  }
}

}  // namespace
}  // namespace kappa
