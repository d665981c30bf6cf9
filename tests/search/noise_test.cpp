// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/noise.hpp"
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kappa/surface/surface.hpp"

namespace kappa {
namespace {

constexpr double kAmplitude = 2, kLength = 25, kSide = 120;

/// Random points on z = kAmplitude sin(x / kLength) cos(y / kLength), one a unit of area, with noise along z.
Scan waves(double noise) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0, kSide);
  std::normal_distribution<double> normal;
  Scan scan;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = place(random), y = place(random);
    scan.points.emplace_back(x, y, kAmplitude * std::sin(x / kLength) * std::cos(y / kLength) + noise * normal(random));
  }
  return scan;
}

TEST(MeasureScale, FindsSpacingAndNoise) {
  for (const double noise : {0.02, 0.05, 0.2}) {
    const CloudScale scale = measure_scale(waves(noise).points);
    EXPECT_NEAR(scale.noise, noise, 0.1 * noise);
    EXPECT_NEAR(scale.spacing, 1, 0.1);
  }
  EXPECT_LT(measure_scale(waves(0).points).noise, 1e-4);
}

TEST(MeasureScale, FindsHowTheMeanCurvatureVaries) {
  // H = -(1/2) Laplacian of z to first order in the slopes; a Laplacian of sin sin is -2 / kLength^2 times it.
  const double mean = kAmplitude / (kLength * kLength) / 2, variation = 2 / (kLength * kLength) * mean;
  for (const double noise : {0.02, 0.05, 0.1}) {
    const double found = measure_scale(waves(noise).points).variation;
    EXPECT_GT(found, 0.8 * variation) << noise;
    EXPECT_LT(found, 1.5 * variation) << noise;
  }
  // Without noise the smallest balls tell, whose few points lie unevenly: an upper estimate, of what noise would
  // balance.
  const double clean = measure_scale(waves(0).points).variation;
  EXPECT_GT(clean, 0.8 * variation);
  EXPECT_LT(clean, 5 * variation);
  std::vector<Vec3> plane = waves(0).points;
  for (Vec3& x : plane) x.z() = 0;
  EXPECT_EQ(measure_scale(plane).variation, 0);
}

TEST(MeasureScale, FindsTheGradientOfTheMeanCurvature) {
  // Of (kAmplitude / kLength^2) sin cos, to first order in the slopes.
  const double gradient = kAmplitude / std::pow(kLength, 3) * std::sqrt(0.5);
  for (const double noise : {0.0, 0.02, 0.05, 0.1, 0.2}) {
    const double found = measure_scale(waves(noise).points).gradient;
    EXPECT_GT(found, 0.8 * gradient) << noise;
    EXPECT_LT(found, 1.3 * gradient) << noise;
  }
  std::vector<Vec3> plane = waves(0).points;
  for (Vec3& x : plane) x.z() = 0;
  EXPECT_LT(measure_scale(plane).gradient, 1e-9);
}

TEST(MeasureScale, CurvatureThatDoesNotVaryIsNoVariation) {
  // Quadrics in balls of different radii differ by 4 / radius^3 there, were it not for their quartic parts.
  std::vector<Vec3> sphere, cylinder;
  constexpr double kRadius = 5, kGoldenAngle = 2.399963229728653;
  for (int i = 0; i < 8000; ++i) {
    const double z = (i + 0.5) / 4000 - 1, angle = kGoldenAngle * i, r = std::sqrt(1 - z * z);
    sphere.emplace_back(kRadius * Vec3(r * std::cos(angle), r * std::sin(angle), z));
    cylinder.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 3 * kRadius * z);
  }
  EXPECT_LT(measure_scale(sphere).variation, 0.5 / std::pow(kRadius, 3));
  EXPECT_LT(measure_scale(cylinder).variation, 0.5 / std::pow(kRadius, 3));
  EXPECT_LT(measure_scale(sphere).gradient, 0.02 / (kRadius * kRadius));
  EXPECT_LT(measure_scale(cylinder).gradient, 0.02 / (kRadius * kRadius));
}

TEST(MeasureScale, FollowsTheUnitsAndNotTheThreads) {
  const Scan scan = waves(0.05);
  const CloudScale one = measure_scale(scan.points);
  std::vector<Vec3> large = scan.points;
  for (Vec3& x : large) x *= 1024;
  const CloudScale scaled = measure_scale(large);
  EXPECT_NEAR(scaled.noise, 1024 * one.noise, 1e-6 * scaled.noise);
  EXPECT_NEAR(scaled.variation, one.variation / std::pow(1024, 3), 1e-6 * scaled.variation);
  EXPECT_NEAR(scaled.gradient, one.gradient / std::pow(1024, 2), 1e-6 * scaled.gradient);
  Execution run;
  run.threads = 3;
  const CloudScale three = measure_scale(scan.points, run);
  EXPECT_EQ(one.noise, three.noise);
  EXPECT_EQ(one.variation, three.variation);
  EXPECT_EQ(one.gradient, three.gradient);
  EXPECT_TRUE(std::isnan(measure_scale({{0, 0, 0}, {1, 0, 0}}).noise));
}

TEST(BalancedRadius, IsWhereNoiseEqualsBias) {
  const CloudScale scale = {1, 0.03, 8.7e-7, 4e-5};
  const double normal_radius = balanced_normal_radius(scale, 1, 100);
  EXPECT_NEAR(normal_noise(scale, normal_radius), normal_bias(scale, normal_radius), 1e-9);
  EXPECT_EQ(balanced_normal_radius(scale, 50, 100), 50);
  EXPECT_EQ(balanced_normal_radius({1, 0.03, 0, 0}, 1, 100), 100);
  EXPECT_EQ(balanced_normal_radius({1, 0, 1, 1}, 1, 100), 1);
  const double radius = balanced_radius(scale, normal_radius, 1, 100);
  const double of_noise = curvature_noise(scale, radius, normal_radius);
  EXPECT_NEAR(of_noise, curvature_bias(scale, radius, normal_radius), 1e-9 * of_noise);
  EXPECT_EQ(balanced_radius(scale, 8, 50, 100), 50);
  EXPECT_EQ(balanced_radius({1, 0.03, 0, 0}, 8, 1, 100), 100);
  EXPECT_EQ(balanced_radius({1, 0, 1, 1}, 8, 1, 100), 1);
}

/// Mean square error of the mean curvature away from the border.
double error(const Surface& s, double radius) {
  CurvatureOptions options;
  options.radii = {radius};
  const CurvatureField field = estimate_curvatures(s.mesh, s.u, options)[0];
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    const Vec3& x = s.mesh.vertices[i];
    if ((Vec2(x.x(), x.y()) - Vec2::Constant(kSide / 2)).cwiseAbs().maxCoeff() > kSide / 2 - 25) continue;
    const double a = x.x() / kLength, b = x.y() / kLength, slope = kAmplitude / kLength;
    const double p = slope * std::cos(a) * std::cos(b), q = -slope * std::sin(a) * std::sin(b);
    const double zz = -slope / kLength * std::sin(a) * std::cos(b), xy = -slope / kLength * std::cos(a) * std::sin(b);
    const double truth =
        -((1 + q * q) * zz - 2 * p * q * xy + (1 + p * p) * zz) / (2 * std::pow(1 + p * p + q * q, 1.5));
    sum += std::pow(field.samples[i].k.mean - truth, 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(AutomaticRadius, GrowsWithTheNoiseAndIsNearTheBest) {
  const Surface clean = make_surface(waves(0), {});
  EXPECT_EQ(clean.normal_radius, 0);
  EXPECT_NEAR(automatic_radius(clean), 5 * clean.spacing, 0.05 * clean.spacing);
  EXPECT_NE(automatic_radius_reason(clean).find("asks for no more"), std::string::npos);

  const Surface noisy = make_surface(waves(0.05), {});
  const double chosen = automatic_radius(noisy);
  EXPECT_GT(noisy.normal_radius, 5);
  EXPECT_NE(automatic_radius_reason(noisy).find("more than 5 median edges"), std::string::npos);
  const double of_chosen = error(noisy, chosen);
  EXPECT_LT(of_chosen, 1.15 * error(noisy, 0.7 * chosen));
  EXPECT_LT(of_chosen, 1.15 * error(noisy, 1.4 * chosen));
  // The prediction is the error.
  EXPECT_NEAR(of_chosen,
              std::hypot(curvature_noise(noisy.scale, chosen, noisy.normal_radius),
                         curvature_bias(noisy.scale, chosen, noisy.normal_radius)),
              0.3 * of_chosen);
  // Five spacings with planes of 24 points, as without a look at the noise, are much worse.
  SurfaceOptions plain;
  plain.normal_neighbours = 24;
  EXPECT_GT(error(make_surface(waves(0.05), plain), 5 * noisy.spacing), 4 * of_chosen);
}

TEST(AutomaticRadius, PlanesAreNoLargerThanTheBallAskedFor) {
  SurfaceOptions options;
  options.measured_radius = 4;
  EXPECT_EQ(make_surface(waves(0.05), options).normal_radius, 4);
  options.normal_radius = 6;
  EXPECT_EQ(make_surface(waves(0.05), options).normal_radius, 6);
}

}  // namespace
}  // namespace kappa
