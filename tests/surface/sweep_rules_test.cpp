// SPDX-License-Identifier: BSD-3-Clause
// The rules by which a sweep is arranged, each on the smallest sweep that shows it. The sensor is the origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clouds.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/surface/spinning.hpp"

namespace kappa {
namespace {

constexpr double kDegree = kPi / 180;

/// Returns with their ring numbers.
struct Returns {
  std::vector<Vec3> x;
  std::vector<double> ring;

  /// One more, angles in radians.
  void add(double number, double elevation, double azimuth, double distance = 10) {
    x.emplace_back(distance * Vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                   std::sin(elevation)));
    ring.push_back(number);
  }
};

/// `rings` rings one degree apart, number 0 the highest, each with `columns` returns around.
Returns regular(int rings, int columns) {
  Returns all;
  for (int r = 0; r < rings; ++r) {
    for (int c = 0; c < columns; ++c) all.add(r, (rings - r) * kDegree, (2.0 * c / columns - 0.99) * kPi);
  }
  return all;
}

SpinningSweep organise(const Returns& returns) {
  return organise_sweep(returns.x, Vec3::Zero(), returns.ring);
}

std::string refusal_of(const Returns& returns) {
  return clouds::refusal([&] { organise(returns); }).message;
}

TEST(SweepRules, WithinAMillionthOfTheExtentIsAtTheSensor) {
  Returns returns = regular(4, 40);
  const double extent = bounds(returns.x).diagonal();
  returns.add(0, 0, 0.1, 0.5e-6 * extent);
  returns.add(0, 0, 0.1, 2e-6 * extent);
  EXPECT_EQ(organise(returns).at_sensor, 1u);
}

TEST(SweepRules, ManyRingsAndAFewSteepOnesAreToldApart) {
  EXPECT_EQ(organise_sweep(regular(40, 30).x, Vec3::Zero()).rings, 40u);
  // Elevations of a ring spread so far that the gap to the next ring is only five times those within it.
  Returns wobbling;
  for (int r = 0; r < 10; ++r) {
    for (int c = 0; c < 30; ++c) wobbling.add(r, (r + c / 34.0) * kDegree, c * 12 * kDegree);
  }
  EXPECT_EQ(organise_sweep(wobbling.x, Vec3::Zero()).rings, 10u);
}

/// Rings 1e-5 apart whose lasers wobble by 2e-7: what is below 1e-6 is one laser.
TEST(SweepRules, TheSmallestWobbleIsNoRing) {
  Returns returns;
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 30; ++c) returns.add(r, 1e-5 * r + (c % 2 == 0 ? 0 : 2e-7), c * 12 * kDegree);
  }
  EXPECT_EQ(organise_sweep(returns.x, Vec3::Zero()).rings, 6u);
}

TEST(SweepRules, ReturnsWithoutARingNumberAreLeftOut) {
  Returns returns = regular(4, 40);
  returns.ring[7] = kNaN;
  const SpinningSweep sweep = organise(returns);
  EXPECT_EQ(sweep.rings, 4u);
  EXPECT_EQ(std::count(sweep.cells.begin(), sweep.cells.end(), 7), 0);
  EXPECT_EQ(std::count(sweep.cells.begin(), sweep.cells.end(), kNoIndex), 1);
}

TEST(SweepRules, ElevationIsTheMedianOfTheRing) {
  Returns returns = regular(4, 41);
  returns.x[0].z() -= 0.5;
  returns.x[20].z() -= 0.3;
  EXPECT_NEAR(organise(returns).elevation[0], 4 * kDegree, 1e-9);
}

TEST(SweepRules, RepeatedDirectionsAreNoSteps) {
  const Returns once = regular(4, 40);
  Returns thrice = once;
  for (const double factor : {1.5, 2.0}) {
    for (std::size_t i = 0; i < once.x.size(); ++i) {
      thrice.x.emplace_back(factor * once.x[i]);
      thrice.ring.push_back(once.ring[i]);
    }
  }
  EXPECT_EQ(organise(thrice).columns, 40u);
  EXPECT_EQ(organise(thrice).extra_returns, 2 * once.x.size());
}

TEST(SweepRules, MissingAndDoubleReturnsDoNotChangeTheColumns) {
  Returns gaps, doubles;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 100; ++c) {
      const double step = 3.6 * kDegree;
      if (c % 5 != 0) gaps.add(r, r * kDegree, c * step);
      doubles.add(r, r * kDegree, c * step);
      if (c % 25 == 3) doubles.add(r, r * kDegree, (c + 0.1) * step, 12);
    }
  }
  EXPECT_EQ(organise(gaps).columns, 100u);
  EXPECT_EQ(organise(doubles).columns, 100u);
  EXPECT_EQ(organise(doubles).extra_returns, 16u);
}

/// Columns begin after the widest gap, whether the data cross the azimuth of 180 degrees or not.
TEST(SweepRules, TheSeamLiesWhereThereIsNothing) {
  for (const double first : {-80.0, 100.0}) {
    Returns part;
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c <= 160; ++c) part.add(r, -r * kDegree, (first + c + 0.01 * (c % 7)) * kDegree);
    }
    const SpinningSweep sweep = organise(part);
    ASSERT_EQ(sweep.columns, 360u);
    for (Index c = 0; c <= 150; ++c) EXPECT_EQ(sweep.cells[c], c) << first;
    EXPECT_EQ(sweep.cells[300], kNoIndex);
  }
}

/// In units of columns: returns 0.15 apart look in one direction; others take the next free column, no more than 1.5
/// away.
TEST(SweepRules, CrowdedReturnsTakeTheNextColumn) {
  Returns returns;
  const double step = 3.6 * kDegree;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 100; ++c) {
      if (r > 0 || c < 40 || c > 49) returns.add(r, -r * kDegree, (c + 0.5) * step);
    }
  }
  const auto at = static_cast<Index>(returns.x.size());
  // The seam is at the azimuth of the first return, which is the left end of its column.
  for (const double column : {42.0, 42.3, 42.6, 42.9}) returns.add(0, 0, (column + 0.51) * step);
  const SpinningSweep sweep = organise(returns);
  ASSERT_EQ(sweep.columns, 100u);
  EXPECT_EQ(sweep.extra_returns, 1u);
  for (Index i = 0; i < 3; ++i) EXPECT_EQ(std::count(sweep.cells.begin(), sweep.cells.end(), at + i), 1);
  EXPECT_EQ(std::count(sweep.cells.begin(), sweep.cells.end(), at + 3), 0);

  Returns twice = regular(4, 40);
  const SpinningSweep clean = organise(twice);
  twice.add(1, 3 * kDegree, (2.0 * 11.15 / 40 - 0.99) * kPi, 15);
  EXPECT_EQ(organise(twice).cells, clean.cells);
  EXPECT_EQ(organise(twice).extra_returns, 1u);
}

TEST(SweepRules, LeastAndMostRings) {
  EXPECT_EQ(organise(regular(2, 20)).rings, 2u);
  EXPECT_NE(refusal_of(regular(1, 20)).find("no rings"), std::string::npos);
  EXPECT_NE(refusal_of(regular(6, 3)).find("6 rings in 18 returns"), std::string::npos);
  Returns many;
  for (int r = 0; r < 600; ++r) {
    for (int c = 0; c < 5; ++c) many.add(r, 0.1 * r * kDegree, c * 72 * kDegree);
  }
  EXPECT_NE(refusal_of(many).find("600 rings in 3000 returns"), std::string::npos);
}

/// A full turn has two triangles a cell, also between the last column and the first.
TEST(SweepRules, AFullTurnIsClosedAndEveryPointStandsForItself) {
  Returns returns = regular(5, 40);
  const std::size_t seen = returns.x.size();
  for (int i = 0; i < 3; ++i) returns.x.push_back(Vec3::Zero());
  returns.ring.resize(returns.x.size(), 0);
  const SpinningSurface s = spinning_surface(Vec3::Zero(), returns.x, Vec3::Zero(), returns.ring);
  EXPECT_EQ(s.grid.surface.mesh.faces.size(), 2u * 4 * 40);
  EXPECT_EQ(s.grid.surface.starless_points, 0u);
  for (Index i = 0; i < seen; ++i) EXPECT_EQ(s.grid.surface.representative[i], i);
  for (std::size_t i = seen; i < returns.x.size(); ++i) EXPECT_EQ(s.grid.surface.representative[i], kNoIndex);
}

}  // namespace
}  // namespace kappa
