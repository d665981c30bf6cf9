// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "clouds.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa {
namespace {

constexpr double kMajor = 6, kMinor = 2;
constexpr std::size_t kPoints = 8000;
/// 0.5, 1 and 2 % of the diagonal: half a spacing, one, and two.
constexpr double kNoises[] = {0.115, 0.23, 0.46};

/// A torus whose points are moved by normal deviates along each axis, without normals.
struct NoisyTorus {
  Scan scan;
  std::vector<SurfacePoint> truth = clouds::torus(kPoints, 3);

  explicit NoisyTorus(double noise) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal(0, noise);
    for (const SurfacePoint& p : truth)
      scan.points.emplace_back(p.x + Vec3(normal(random), normal(random), normal(random)));
  }

  /// Normals of quadrics with the signs of the true ones.
  Surface surface(SurfaceOptions options) const {
    options.normals = NormalsKind::Quadric;
    options.orientation = Orientation::Up;
    Surface s = make_surface(scan, options);
    for (std::size_t i = 0; i < s.u.size(); ++i) {
      if (s.u[i].dot(truth[i].normal) < 0) s.u[i] = -s.u[i];
    }
    return s;
  }

  /// Root mean square error of mean and principal curvatures together, at order 2, of all points but the worst of a
  /// hundred: the balls of a few have hardly any corrected area under the heaviest noise.
  double error(const Surface& s, double radius) const {
    CurvatureOptions options;
    options.radii = {radius};
    options.order = 2;
    const CurvatureField field = estimate_curvatures(s.mesh, s.u, options)[0];
    std::vector<double> squares;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Curvatures& k = field.samples[i].k;
      const TrueCurvature& t = truth[i].curvature;
      if (k.status != PointStatus::Valid) continue;
      squares.push_back(std::pow(k.mean - t.mean, 2) +
                        (std::pow(k.k_min - t.k_min, 2) + std::pow(k.k_max - t.k_max, 2)) / 2);
    }
    std::sort(squares.begin(), squares.end());
    squares.resize(squares.size() - squares.size() / 100);
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size()));
  }
};

/// The mean curvature is (1/r + cos a / (R + r cos a)) / 2 at the angle a of the tube: root mean square of its
/// gradient.
double gradient_of_torus() {
  double sum = 0, area = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double a = 2 * kPi * i / kSteps, to_axis = kMajor + kMinor * std::cos(a);
    const double slope = -std::sin(a) * kMajor / (to_axis * to_axis) / (2 * kMinor);
    sum += slope * slope * to_axis;
    area += to_axis;
  }
  return std::sqrt(sum / area);
}

TEST(NoisyClouds, ScaleIsFoundWhereNoiseIsAsRoughAsTheSpacing) {
  const double spacing = 2 * kPi * std::sqrt(kMajor * kMinor / kPoints), gradient = gradient_of_torus();
  for (const double noise : kNoises) {
    const CloudScale scale = measure_scale(NoisyTorus(noise).scan.points);
    EXPECT_NEAR(scale.spacing, spacing, 0.1 * spacing) << noise;
    EXPECT_NEAR(scale.noise, noise, 0.2 * noise) << noise;
    EXPECT_GT(scale.gradient, 0.7 * gradient) << noise;
    EXPECT_LT(scale.gradient, 3 * gradient) << noise;
  }
}

/// Fits to 24 points have more than twice the error; those within five spacings are hardly better, if at all.
TEST(NoisyClouds, FitsAreAsWideAsTheNoiseAsks) {
  for (const double noise : {kNoises[0], kNoises[2]}) {
    const NoisyTorus torus(noise);
    SurfaceOptions narrow, wide;
    narrow.normal_neighbours = 24;
    const Surface chosen = torus.surface({});
    wide.normal_radius = 5 * chosen.scale.spacing;
    constexpr double kRadius = 2.4;
    const double of_chosen = torus.error(chosen, kRadius), of_wide = torus.error(torus.surface(wide), kRadius);
    EXPECT_GT(chosen.normal_radius, 5 * chosen.scale.spacing) << noise;
    EXPECT_LT(chosen.normal_radius, 10 * chosen.scale.spacing) << noise;
    EXPECT_LT(of_chosen, 1.1 * of_wide) << noise;
    EXPECT_LT(2 * of_chosen, torus.error(torus.surface(narrow), kRadius)) << noise;
  }
}

TEST(NoisyClouds, FitsStayNarrowWithoutNoiseAndAtEdges) {
  EXPECT_EQ(NoisyTorus(0).surface({}).normal_radius, 0);
  // Roofs of a slope of 0.6 every 20 spacings, with a tenth of a spacing of noise.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0, 100);
  std::normal_distribution<double> normal(0, 0.1);
  Scan roofs;
  for (int i = 0; i < 10000; ++i) {
    const double x = place(random), y = place(random);
    roofs.points.emplace_back(x, y, 6 - 0.6 * std::abs(std::fmod(x, 20) - 10) + normal(random));
  }
  const Surface s = make_surface(roofs, {});
  EXPECT_EQ(s.normal_radius, 0);
  EXPECT_NEAR(automatic_radius(s), 5 * s.spacing, 0.05 * 5 * s.spacing);
}

TEST(NoisyClouds, WideFitsLeaveTheEdgesOfAFewRoofs) {
  // A roof of a slope of 0.7 on ground that waves, with a tenth of a spacing of noise.
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-60, 60);
  std::normal_distribution<double> normal(0, 0.1);
  Scan scan;
  Normals truth;
  std::vector<char> by_roof;
  for (int i = 0; i < 120 * 120; ++i) {
    const double x = place(random), y = place(random);
    const bool roof = std::abs(x) < 7 && std::abs(y) < 10;
    const double z = roof ? 8 - 0.7 * std::abs(x) : 3 * std::sin(x / 40) * std::cos(y / 40);
    const Vec2 slope = roof ? Vec2(x < 0 ? 0.7 : -0.7, 0)
                            : Vec2(std::cos(x / 40) * std::cos(y / 40), -std::sin(x / 40) * std::sin(y / 40)) * 3 / 40;
    scan.points.emplace_back(x, y, z + normal(random));
    truth.push_back(Vec3(-slope.x(), -slope.y(), 1).normalized());
    by_roof.push_back(std::abs(x) < 10 && std::abs(y) < 13 ? 1 : 0);
  }
  const auto error = [&](const SurfaceOptions& options, bool roof, double* radius) {
    const Surface s = make_surface(scan, options);
    *radius = s.normal_radius / s.scale.spacing;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if ((by_roof[i] != 0) != roof) continue;
      sum += (s.u[i] - truth[i]).squaredNorm();
      ++count;
    }
    return std::sqrt(sum / count);
  };
  SurfaceOptions narrow;
  narrow.normal_neighbours = 24;
  double radius = 0, none = 0;
  const double of_ground = error({}, false, &radius);
  EXPECT_GT(radius, 3) << "spacings";
  EXPECT_LT(1.4 * of_ground, error(narrow, false, &none));
  EXPECT_LT(error({}, true, &radius), 1.03 * error(narrow, true, &none));
}

TEST(NoisyClouds, TooFewPointsForAScaleHaveNormals) {
  Scan scan;
  for (int i = 0; i < 20; ++i) scan.points.emplace_back(i % 5, i / 5, 0.5 * (i % 5));
  const Surface s = make_surface(scan, {});
  EXPECT_TRUE(std::isnan(s.scale.noise));
  const Vec3 normal = Vec3(-0.5, 0, 1).normalized();
  for (const Vec3& u : s.u) EXPECT_NEAR(std::abs(u.dot(normal)), 1, 1e-12);
}

}  // namespace
}  // namespace kappa
