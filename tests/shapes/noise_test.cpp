// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/noise.hpp"
#include "kappa/scan/scan.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/shapes/analytic.hpp"

namespace kappa {
namespace {

struct Moments {
  double mean = 0, deviation = 0;
};

Moments moments(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  Moments result;
  for (const double value : values) result.mean += value / count;
  for (const double value : values) result.deviation += (value - result.mean) * (value - result.mean) / count;
  result.deviation = std::sqrt(result.deviation);
  return result;
}

NoiseOptions noise_of(NoiseKind kind, double amount) {
  NoiseOptions options;
  options.kind = kind;
  options.amount = amount;
  options.seed = 11;
  return options;
}

TEST(Noise, BallIsRelativeToTheEdgesOfEachVertex) {
  // A torus whose edges are shorter inside: the ball must follow the vertex, not the mesh.
  const Scan clean = torus({3, 2, 60, 60, 0, GridFaces::Quads});
  Scan noisy = clean;
  add_noise(noisy, noise_of(NoiseKind::Ball, 0.3));
  double largest = 0, mean_cube = 0;
  for (std::size_t i = 0; i < clean.points.size(); ++i) {
    // Lengths of the chords along the tube (all equal) and around the axis.
    const double chord = std::sin(kPi / 60);
    const double edge = 0.5 * (2 * 2 * chord + 2 * clean.points[i].head<2>().norm() * chord);
    const double relative = (noisy.points[i] - clean.points[i]).norm() / (0.3 * edge);
    ASSERT_LE(relative, 1 + 1e-12) << "vertex " << i;
    largest = std::max(largest, relative);
    mean_cube += std::pow(relative, 3) / static_cast<double>(clean.points.size());
  }
  EXPECT_GT(largest, 0.99);
  EXPECT_NEAR(mean_cube, 0.5, 0.02);  // the cube of the radius is uniform in a ball
  EXPECT_EQ(noisy.normals, clean.normals);
  EXPECT_EQ(test::values(noisy, "k_min"), test::values(clean, "k_min"));
}

TEST(Noise, NormalMovesAlongTheNormal) {
  const Scan clean = sample_sphere(2, {50000, 1});
  Scan noisy = clean;
  add_noise(noisy, noise_of(NoiseKind::Normal, 0.05));
  std::vector<double> moves;
  for (std::size_t i = 0; i < clean.points.size(); ++i) {
    const Vec3 move = noisy.points[i] - clean.points[i];
    moves.push_back(move.dot(clean.normals[i]));
    ASSERT_NEAR((move - moves.back() * clean.normals[i]).norm(), 0, 1e-14);
  }
  EXPECT_NEAR(moments(moves).mean, 0, 0.001);
  EXPECT_NEAR(moments(moves).deviation, 0.05, 0.001);
}

TEST(Noise, RangeMovesAlongTheBeamFromAFileCoordinateViewpoint) {
  Scan clean = sample_sphere(2, {50000, 1});
  clean.origin = Vec3(500000, 5400000, 100);
  clean.viewpoint = clean.origin + Vec3(10, 20, 30);
  Scan noisy = clean;
  add_noise(noisy, noise_of(NoiseKind::Range, 0.05));
  std::vector<double> moves;
  for (std::size_t i = 0; i < clean.points.size(); ++i) {
    const Vec3 beam = (clean.points[i] - Vec3(10, 20, 30)).normalized(), move = noisy.points[i] - clean.points[i];
    moves.push_back(move.dot(beam));
    ASSERT_NEAR(move.cross(beam).norm(), 0, 1e-9);
  }
  EXPECT_NEAR(moments(moves).mean, 0, 0.001);
  EXPECT_NEAR(moments(moves).deviation, 0.05, 0.001);
}

TEST(Noise, DependsOnTheSeedAlone) {
  const Scan clean = torus({});
  const auto noisy_points = [&](std::uint64_t seed) {
    Scan scan = clean;
    NoiseOptions options = noise_of(NoiseKind::Ball, 0.3);
    options.seed = seed;
    add_noise(scan, options);
    return scan.points;
  };
  EXPECT_EQ(noisy_points(1), noisy_points(1));
  EXPECT_NE(noisy_points(1), noisy_points(2));
}

TEST(Noise, CanDropNormalsAndMoveNothing) {
  const Scan clean = torus({});
  Scan scan = clean;
  NoiseOptions options = noise_of(NoiseKind::Normal, 0);
  options.normals = NoisyNormals::Drop;
  add_noise(scan, options);
  EXPECT_EQ(scan.points, clean.points);
  EXPECT_TRUE(scan.normals.empty());
}

TEST(Noise, LeavesPointsWithoutADirection) {
  Scan scan = plane({2, 2, GridFaces::Triangles});
  scan.points.emplace_back(5, 5, 5);  // in no face
  scan.normals.push_back(Vec3::Zero());
  scan.points[1] = Vec3::Constant(kNaN);
  const auto before = scan.points;
  add_noise(scan, noise_of(NoiseKind::Ball, 0.3));
  EXPECT_EQ(scan.points.back(), before.back());
  EXPECT_TRUE(std::isnan(scan.points[1].x()));
  for (std::size_t i = 2; i < 9; ++i) {
    EXPECT_TRUE(is_finite(scan.points[i]));
    EXPECT_NE(scan.points[i], before[i]);
  }
  add_noise(scan, noise_of(NoiseKind::Normal, 0.3));
  EXPECT_EQ(scan.points.back(), before.back());
}

TEST(Noise, SaysWhatTheScanLacks) {
  const auto message = [](Scan scan, const NoiseOptions& options) -> std::string {
    try {
      add_noise(scan, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidArgument);
      return error.what();
    }
    return "";
  };
  const Scan cloud = sample_sphere(1, {10, 0});
  EXPECT_NE(message(cloud, noise_of(NoiseKind::Ball, 0.3)).find("no faces"), std::string::npos);
  EXPECT_NE(message(cloud, noise_of(NoiseKind::Range, 0.3)).find("viewpoint"), std::string::npos);
  EXPECT_NE(message(cloud, noise_of(NoiseKind::Normal, -1)).find("amount is -1"), std::string::npos);
  EXPECT_NE(message(cloud, noise_of(NoiseKind::Normal, kNaN)).find("amount is"), std::string::npos);
  Scan bare = cloud;
  bare.normals.clear();
  EXPECT_NE(message(bare, noise_of(NoiseKind::Normal, 0.3)).find("normals"), std::string::npos);
}

}  // namespace
}  // namespace kappa
