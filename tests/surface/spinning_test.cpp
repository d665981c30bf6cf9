// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/spinning.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "clouds.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

/// A simulated sweep in a round tower of radius 12 on flat ground 2 below the sensor, in random order.
struct Sweep {
  Vec3 sensor{3, -4, 2};
  std::vector<double> elevations;  ///< degrees, from the highest
  std::size_t columns = 720;
  std::vector<Vec3> points;
  std::vector<double> ring;    ///< of each point, 0 the highest
  std::vector<double> column;  ///< of each point
};

Vec3 hit(const Sweep& sweep, double elevation, double azimuth) {
  const Vec3 d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const double wall = 12 / std::cos(elevation);
  const double ground = d.z() < 0 ? -2 / d.z() : wall;
  return sweep.sensor + std::min(wall, ground) * d;
}

/// Azimuths jitter by a fifth of a column and the rings start at different azimuths; `turn` is the part of a turn.
Sweep simulate(std::vector<double> elevations, double turn, std::uint64_t seed) {
  Sweep sweep;
  sweep.elevations = std::move(elevations);
  Random random(seed);
  std::vector<std::array<double, 4>> beams;
  const double step = 2 * kPi / static_cast<double>(sweep.columns);
  const auto seen = static_cast<std::size_t>(turn * static_cast<double>(sweep.columns));
  for (std::size_t r = 0; r < sweep.elevations.size(); ++r) {
    const double phase = random.uniform(0, 0.5);
    for (std::size_t c = 0; c < seen; ++c) {
      const double azimuth = (static_cast<double>(c) + phase + random.uniform(-0.2, 0.2)) * step;
      const double elevation = (sweep.elevations[r] + random.uniform(-0.005, 0.005)) * kPi / 180;
      beams.push_back({elevation, azimuth, static_cast<double>(r), static_cast<double>(c)});
    }
  }
  for (std::size_t i = beams.size(); i > 1; --i) std::swap(beams[i - 1], beams[random.below(i)]);
  for (const auto& [elevation, azimuth, ring, column] : beams) {
    sweep.points.push_back(hit(sweep, elevation, azimuth));
    sweep.ring.push_back(ring);
    sweep.column.push_back(column);
  }
  return sweep;
}

std::vector<double> even_rings() {
  std::vector<double> degrees;
  for (int r = 0; r < 16; ++r) degrees.push_back(15 - 2.0 * r);
  return degrees;
}

/// Each cell holds a point of its ring; the columns of a row follow one another as those of the simulation do.
void expect_arranged(const Sweep& sweep, const SpinningSweep& found) {
  ASSERT_EQ(found.rings, sweep.elevations.size());
  ASSERT_EQ(found.cells.size(), found.rings * found.columns);
  for (std::size_t r = 0; r < found.rings; ++r) {
    EXPECT_NEAR(found.elevation[r] * 180 / kPi, sweep.elevations[r], 0.01);
    double shift_min = 1e9, shift_max = -1e9;
    for (std::size_t c = 0; c < found.columns; ++c) {
      const Index i = found.cells[r * found.columns + c];
      if (i == kNoIndex) continue;
      EXPECT_EQ(sweep.ring[i], static_cast<double>(r));
      const double columns = static_cast<double>(found.columns);
      const double shift = std::fmod(static_cast<double>(c) - sweep.column[i] + 1.5 * columns, columns);
      shift_min = std::min(shift_min, shift);
      shift_max = std::max(shift_max, shift);
    }
    EXPECT_LE(shift_max - shift_min, 2) << "ring " << r;
  }
}

std::size_t filled(const SpinningSweep& sweep) {
  return sweep.cells.size() - static_cast<std::size_t>(std::count(sweep.cells.begin(), sweep.cells.end(), kNoIndex));
}

TEST(OrganiseSweep, FindsRingsAndColumns) {
  const Sweep sweep = simulate(even_rings(), 1, 1);
  const SpinningSweep found = organise_sweep(sweep.points, sweep.sensor);
  EXPECT_EQ(found.columns, sweep.columns);
  EXPECT_NEAR(found.azimuth_step, 2 * kPi / 720, 1e-12);
  expect_arranged(sweep, found);
  EXPECT_GE(filled(found) + found.extra_returns, sweep.points.size());
  EXPECT_LE(found.extra_returns, sweep.points.size() / 500);
}

TEST(OrganiseSweep, RingsMayBeUneven) {
  const Sweep sweep =
      simulate({15, 10.3, 7, 4.67, 2.33, 1.33, 0.67, 0.33, 0, -0.33, -1, -3.67, -7.25, -15.6, -25}, 1, 2);
  expect_arranged(sweep, organise_sweep(sweep.points, sweep.sensor));
}

TEST(OrganiseSweep, TakesTheRingNumbersOfTheFile) {
  const Sweep sweep = simulate(even_rings(), 1, 3);
  const SpinningSweep given = organise_sweep(sweep.points, sweep.sensor, sweep.ring);
  EXPECT_EQ(given.cells, organise_sweep(sweep.points, sweep.sensor).cells);
}

TEST(OrganiseSweep, DropsWhatIsNoReturn) {
  Sweep sweep = simulate(even_rings(), 1, 4);
  const SpinningSweep clean = organise_sweep(sweep.points, sweep.sensor);
  for (int i = 0; i < 700; ++i) sweep.points.push_back(sweep.sensor);
  for (int i = 0; i < 30; ++i) sweep.points.push_back(Vec3::Constant(kNaN));
  const SpinningSweep found = organise_sweep(sweep.points, sweep.sensor);
  EXPECT_EQ(found.at_sensor, 700u);
  EXPECT_EQ(found.invalid_points, 30u);
  EXPECT_EQ(found.cells, clean.cells);
  const SpinningSurface s = spinning_surface(Vec3::Zero(), sweep.points, sweep.sensor, {});
  EXPECT_EQ(s.grid.surface.invalid_points, 30u);
  EXPECT_EQ(s.grid.surface.representative[sweep.points.size() - 100], kNoIndex);
}

TEST(OrganiseSweep, KeepsTheNearestOfSeveralReturns) {
  const Sweep sweep = simulate(even_rings(), 1, 5);
  const SpinningSweep clean = organise_sweep(sweep.points, sweep.sensor);
  std::vector<Vec3> twice = sweep.points;
  for (std::size_t i = 0; i < 200; ++i) twice.emplace_back(sweep.sensor + 1.5 * (sweep.points[i] - sweep.sensor));
  const SpinningSweep found = organise_sweep(twice, sweep.sensor);
  EXPECT_EQ(found.cells, clean.cells);
  EXPECT_EQ(found.extra_returns, clean.extra_returns + 200);
}

TEST(SpinningSurface, IsClosedAroundAndLooksAtTheSensor) {
  const Sweep sweep = simulate(even_rings(), 1, 6);
  const SpinningSurface s = spinning_surface(Vec3(7, 8, 9), sweep.points, sweep.sensor, {});
  const Mesh& mesh = s.grid.surface.mesh;
  EXPECT_EQ(mesh.origin, Vec3(7, 8, 9));
  double ground = 0, wall = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 a = clouds::area_vector(mesh, f);
    EXPECT_GT(a.dot(sweep.sensor - mesh.vertices[mesh.faces[f][0]]), 0);
    (std::abs(a.z()) > 0.9 * a.norm() ? ground : wall) += 0.5 * a.norm();
  }
  // The ground from the lowest ring to the foot of the wall, above it the wall up to the highest ring; the cells that
  // meet the foot cut the corner.
  const double inner = 2 / std::tan(15 * kPi / 180), outer = 12;
  EXPECT_NEAR(ground, kPi * (outer * outer - inner * inner), 0.01 * ground);
  const double low = -9 * kPi / 180, high = 15 * kPi / 180;
  EXPECT_NEAR(wall, 2 * kPi * 12 * 12 * (std::tan(high) - std::tan(low)), 0.01 * wall);
  EXPECT_LT(s.grid.cuts.depth_jumps + s.grid.cuts.grazing, mesh.faces.size() / 100);
}

TEST(SpinningSurface, APartOfATurnStaysOpen) {
  const Sweep sweep = simulate(even_rings(), 0.4, 7);
  const SpinningSurface s = spinning_surface(Vec3::Zero(), sweep.points, sweep.sensor, {});
  EXPECT_EQ(s.sweep.columns, sweep.columns);
  const Mesh& mesh = s.grid.surface.mesh;
  EXPECT_GT(mesh.faces.size(), 2u * 15 * 280);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(std::abs(sweep.column[face[i]] - sweep.column[face[(i + 1) % 3]]), 4);
  }
}

TEST(SpinningSurface, IsTheSameForAnyNumberOfThreads) {
  const Sweep sweep = simulate(even_rings(), 1, 8);
  Execution run;
  run.threads = 3;
  EXPECT_TRUE(clouds::same_faces(
      spinning_surface(Vec3::Zero(), sweep.points, sweep.sensor, {}).grid.surface.mesh,
      spinning_surface(Vec3::Zero(), sweep.points, sweep.sensor, {}, kSpinningCuts, run).grid.surface.mesh));
}

TEST(OrganiseSweep, RefusesByName) {
  const auto message = [](const std::vector<Vec3>& points, const Vec3& sensor, const std::vector<double>& ring) {
    return clouds::refusal([&] { organise_sweep(points, sensor, ring); }).message;
  };
  const std::vector<Vec3> sphere = clouds::positions(clouds::sphere(5, 3000, 9));
  EXPECT_NE(message(sphere, Vec3::Zero(), {}), "") << "elevations spread evenly form no rings";
  EXPECT_NE(message({}, Vec3::Zero(), {}).find("no rings"), std::string::npos);
  EXPECT_NE(message({Vec3::UnitX()}, Vec3::Zero(), {}).find("no rings"), std::string::npos);
  EXPECT_NE(message(std::vector<Vec3>(50, Vec3::UnitX()), Vec3::Zero(), {}).find("no rings"), std::string::npos);
  EXPECT_NE(message(sphere, Vec3::Constant(kNaN), {}).find("sensor is not finite"), std::string::npos);
  EXPECT_NE(message(sphere, Vec3::Zero(), {1, 2}).find("2 ring numbers for 3000 points"), std::string::npos);
}

}  // namespace
}  // namespace kappa
