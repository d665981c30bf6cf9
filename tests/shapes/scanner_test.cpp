// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/scanner.hpp"
#include "kappa/scan/scan.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace kappa {
namespace {

using test::values;

AirborneOptions small_survey() {
  AirborneOptions options;
  options.width = options.depth = 60;
  options.range_noise = 0;
  options.normals = ScanNormals::True;
  return options;
}

AirborneOptions flat_survey() {
  AirborneOptions options = small_survey();
  options.scene = Scene();
  return options;
}

TEST(Airborne, DefaultIsTheDemo) {
  const AirborneOptions options;
  const Scan scan = airborne_scan(options);
  EXPECT_NEAR(static_cast<double>(scan.points.size()), 2.3 * 160 * 160, 0.02 * 2.3 * 160 * 160);
  EXPECT_EQ(scan.origin, Vec3(512000, 5403000, 300));
  EXPECT_TRUE(scan.normals.empty());
  EXPECT_TRUE(scan.faces.empty());
  ASSERT_EQ(scan.fields.size(), 13U);
  std::size_t on_roofs = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    ASSERT_TRUE(is_finite(scan.points[i]));
    const bool near_crease = values(scan, "crease_distance")[i] < options.crease_margin;
    ASSERT_EQ(std::isnan(values(scan, "mean_curvature")[i]), near_crease) << "point " << i;
    ASSERT_EQ(std::isnan(values(scan, "k_min")[i]), near_crease) << "point " << i;
    const double code = values(scan, "classification")[i];
    ASSERT_TRUE(code == 2 || code == 6);
    on_roofs += code == 6 ? 1 : 0;
    if (code == 6 && !near_crease) {
      ASSERT_EQ(values(scan, "k_max")[i], 0);
    }
  }
  // The houses stand where the strips overlap, in part.
  const double roofs = 22 * 12 + 20 * 14;
  EXPECT_GT(static_cast<double>(on_roofs), 2.0 * roofs);
  EXPECT_LT(static_cast<double>(on_roofs), 4.6 * roofs);
}

TEST(Airborne, PointsLieOnTheSceneWithItsCurvature) {
  AirborneOptions options = small_survey();
  options.scene.buildings = {{{22, 35}, 14, 8, 0.3, 3, 0.6, RoofKind::Gabled},
                             {{45, 20}, 14, 9, -0.8, 4, 0.8, RoofKind::Hipped}};
  const Scan scan = airborne_scan(options);
  const auto z = [&](double x, double y) { return sample_scene(options.scene, x, y).height.z; };
  constexpr double h = 2e-3;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double x = scan.points[i].x(), y = scan.points[i].y();
    ASSERT_NEAR(scan.points[i].z(), z(x, y), 1e-7);
    if (values(scan, "crease_distance")[i] < options.crease_margin) continue;
    const double zx = (z(x + h, y) - z(x - h, y)) / (2 * h), zy = (z(x, y + h) - z(x, y - h)) / (2 * h);
    const double zxx = (z(x + h, y) - 2 * z(x, y) + z(x - h, y)) / (h * h);
    const double zyy = (z(x, y + h) - 2 * z(x, y) + z(x, y - h)) / (h * h);
    const double zxy = (z(x + h, y + h) - z(x + h, y - h) - z(x - h, y + h) + z(x - h, y - h)) / (4 * h * h);
    const double w = 1 + zx * zx + zy * zy;
    const double mean = -((1 + zy * zy) * zxx - 2 * zx * zy * zxy + (1 + zx * zx) * zyy) / (2 * std::pow(w, 1.5));
    ASSERT_NEAR(values(scan, "mean_curvature")[i], mean, 1e-7) << "point " << i;
    ASSERT_NEAR(values(scan, "gaussian_curvature")[i], (zxx * zyy - zxy * zxy) / (w * w), 1e-8) << "point " << i;
    ASSERT_NEAR((scan.normals[i] - Vec3(-zx, -zy, 1) / std::sqrt(w)).norm(), 0, 1e-7) << "point " << i;
  }
}

TEST(Airborne, DensityIsAsAskedEverywhere) {
  for (const ScanPattern pattern : {ScanPattern::Oscillating, ScanPattern::Parallel}) {
    for (const double density : {1.0, 4.0, 10.0}) {
      AirborneOptions options = flat_survey();
      options.width = 100;
      options.density = density;
      options.pattern = pattern;
      options.overlap = 0;
      options.altitude = 200;
      const Scan scan = airborne_scan(options);
      EXPECT_NEAR(static_cast<double>(scan.points.size()), density * 6000, 0.01 * density * 6000 + 200);
      std::vector<int> cells(15, 0);  // of 20 m
      for (const auto& x : scan.points) {
        ++cells[static_cast<std::size_t>(x.x() / 20.0001) + 5 * static_cast<std::size_t>(x.y() / 20.0001)];
      }
      for (const int count : cells) EXPECT_NEAR(count, 400 * density, 0.12 * 400 * density + 10);
    }
  }
}

TEST(Airborne, OverlapKeepsTheDensityAndTellsTheStripsApart) {
  AirborneOptions options = flat_survey();
  options.altitude = 200;
  options.overlap = 0.7;
  const Scan scan = airborne_scan(options);
  EXPECT_NEAR(static_cast<double>(scan.points.size()), 2.3 * 3600, 0.03 * 2.3 * 3600);
  const auto& strips = values(scan, "strip");
  EXPECT_TRUE(std::is_sorted(strips.begin(), strips.end()));
  EXPECT_EQ(strips.front(), 0);
  EXPECT_GE(strips.back(), 2);
}

TEST(Airborne, PointsComeInOrderOfAcquisition) {
  for (const ScanPattern pattern : {ScanPattern::Oscillating, ScanPattern::Parallel}) {
    AirborneOptions options = flat_survey();
    options.pattern = pattern;
    const Scan scan = airborne_scan(options);
    std::size_t forth = 0, back = 0, far = 0;
    for (std::size_t i = 1; i < scan.points.size(); ++i) {
      const Vec3 step = scan.points[i] - scan.points[i - 1];
      far += step.norm() > 2 ? 1 : 0;
      forth += step.x() > 0 ? 1 : 0;
      back += step.x() < 0 ? 1 : 0;
    }
    const double share = static_cast<double>(back) / static_cast<double>(forth + back);
    if (pattern == ScanPattern::Oscillating) {
      EXPECT_NEAR(share, 0.5, 0.05);
    } else {
      EXPECT_LT(share, 0.05);
      EXPECT_GT(far, 50U);  // each line starts anew
    }
  }
}

TEST(Airborne, NoiseIsAlongTheBeam) {
  AirborneOptions options = flat_survey();
  options.half_angle = 0.5;
  options.altitude = 100;
  options.width = 100;
  options.range_noise = 0.05;
  const Scan noisy = airborne_scan(options);
  options.range_noise = 0;
  const Scan clean = airborne_scan(options);
  ASSERT_EQ(noisy.points.size(), clean.points.size());
  double sum = 0, sum_sq = 0, sum_x = 0;
  for (std::size_t i = 0; i < clean.points.size(); ++i) {
    const Vec3 move = noisy.points[i] - clean.points[i];
    ASSERT_NEAR(move.y(), 0, 1e-12);
    ASSERT_LE(std::abs(move.x()), std::tan(0.5) * std::abs(move.z()) * 1.02);
    sum += move.z() > 0 ? move.norm() : -move.norm();
    sum_sq += move.squaredNorm();
    sum_x += std::abs(move.x());
  }
  const auto count = static_cast<double>(clean.points.size());
  EXPECT_NEAR(sum / count, 0, 0.002);
  EXPECT_NEAR(std::sqrt(sum_sq / count), 0.05, 0.001);
  EXPECT_GT(sum_x / count, 0.005);
  EXPECT_EQ(values(noisy, "k_min"), values(clean, "k_min"));
  EXPECT_EQ(noisy.normals, clean.normals);
}

TEST(Airborne, HousesCastShadowsAndKeepTheirWallsBare) {
  AirborneOptions options = flat_survey();
  options.width = 160;
  options.altitude = 100;
  options.half_angle = 0.75;
  options.density = 4;
  options.jitter = 0;
  options.overlap = 0;
  options.scene.buildings = {{{120, 30}, 20, 12, 0.5 * kPi, 20, 0, RoofKind::Gabled}};
  const Scan scan = airborne_scan(options);
  EXPECT_EQ(values(scan, "strip").back(), 0);  // one strip, over x = 80
  // From (80, 100), the far edge of the roof at (126, 20) hides the ground up to 80 + 46 * 100 / 80.
  const double end = 80 + 46 * 100 / 80.0;
  std::size_t hidden = 0, lit = 0, roof = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3& x = scan.points[i];
    ASSERT_TRUE(std::abs(x.z()) < 1e-7 || std::abs(x.z() - 20) < 1e-7) << x.transpose();
    roof += x.z() > 10 ? 1 : 0;
    if (std::abs(x.y() - 30) > 9.9) continue;
    hidden += x.x() > 126 && x.x() < end - 1e-6 ? 1 : 0;
    lit += x.x() > end && x.x() < end + 10 ? 1 : 0;
  }
  EXPECT_EQ(hidden, 0U);
  EXPECT_GT(lit, 300U);
  EXPECT_GT(roof, 600U);
}

TEST(Airborne, StoresDuplicatesNextToTheirTwins) {
  AirborneOptions options = flat_survey();
  options.duplicates = 0.2;
  options.range_noise = 0.03;
  const Scan scan = airborne_scan(options);
  std::size_t twins = 0;
  for (std::size_t i = 1; i < scan.points.size(); ++i) twins += scan.points[i] == scan.points[i - 1] ? 1 : 0;
  const auto originals = static_cast<double>(scan.points.size() - twins);
  EXPECT_NEAR(static_cast<double>(twins) / originals, 0.2, 0.02);
  EXPECT_NEAR(originals, 2.3 * 3600, 0.03 * 2.3 * 3600);
}

TEST(Airborne, DependsOnTheOptionsAlone) {
  AirborneOptions options = small_survey();
  options.range_noise = 0.03;
  const Scan a = airborne_scan(options), b = airborne_scan(options);
  EXPECT_EQ(a.points, b.points);
  options.seed = 2;
  EXPECT_NE(airborne_scan(options).points, a.points);
}

TEST(Airborne, HasNoCreaseFieldWithoutHouses) {
  const Scan scan = airborne_scan(flat_survey());
  EXPECT_EQ(scan.field("crease_distance"), nullptr);
  for (const double k : values(scan, "mean_curvature")) ASSERT_EQ(k, 0);
}

TEST(Waves, IsTheTerrainOfTheBenchmark) {
  WavesOptions options;
  options.points = 200000;
  options.normals = ScanNormals::True;
  const Scan scan = waves_scan(options);
  test::expect_complete(scan);
  double mean_sq = 0, gaussian_sq = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3& x = scan.points[i];
    ASSERT_NEAR(x.z(), 20 * std::sin(x.x() / 60) * std::cos(x.y() / 80), 1e-12);
    ASSERT_TRUE(x.x() >= 0 && x.x() < 1000 && x.y() >= 0 && x.y() < 1000);
    mean_sq += std::pow(values(scan, "mean_curvature")[i], 2);
    gaussian_sq += std::pow(values(scan, "gaussian_curvature")[i], 2);
  }
  EXPECT_NEAR(std::sqrt(mean_sq / 200000), 2e-3, 2e-4);  // the figure of an independent run
  EXPECT_GT(gaussian_sq, 0);
  const auto normals = test::normal_field([](const Vec3& x) {
    return Vec3(-20 / 60.0 * std::cos(x.x() / 60) * std::cos(x.y() / 80),
                20 / 80.0 * std::sin(x.x() / 60) * std::sin(x.y() / 80), 1);
  });
  options.points = 500;
  test::expect_truth(waves_scan(options), normals, 0.05, 5e-3, 1e-9);
}

TEST(Waves, NoiseIsVerticalAndNormalsCanBeLeftOut) {
  WavesOptions options;
  options.range_noise = 0.03;
  options.normals = ScanNormals::None;
  options.origin = {1000, 2000, 3000};
  const Scan scan = waves_scan(options);
  EXPECT_TRUE(scan.normals.empty());
  EXPECT_EQ(scan.origin, options.origin);
  double sum_sq = 0;
  for (const auto& x : scan.points) {
    sum_sq += std::pow(x.z() - 20 * std::sin(x.x() / 60) * std::cos(x.y() / 80), 2);
  }
  EXPECT_NEAR(std::sqrt(sum_sq / static_cast<double>(scan.points.size())), 0.03, 0.0004);
}

}  // namespace
}  // namespace kappa
