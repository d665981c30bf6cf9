// SPDX-License-Identifier: BSD-3-Clause
// The ground filter: its grid operations against their definitions, scenes with known ground, the ISPRS samples.
#include "kappa/scan/ground.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kappa/core/error.hpp"
#include "scan/height_grid.hpp"
#include "support/expect_names.hpp"

namespace kappa {
namespace {

HeightGrid random_grid(std::size_t columns, std::size_t rows) {
  HeightGrid grid(columns, rows);
  std::mt19937 random(static_cast<unsigned>(31 * columns + rows));
  std::uniform_real_distribution<double> any(0, 1);
  for (double& z : grid.z) z = any(random);
  return grid;
}

/// Least (sign 1) or greatest (sign -1) height in the disc about a cell, by its definition.
double extreme(const HeightGrid& grid, std::size_t x, std::size_t y, double radius, double sign) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double dx = static_cast<double>(column) - static_cast<double>(x),
                   dy = static_cast<double>(row) - static_cast<double>(y);
      const double reach = radius + 0.5;
      if (dx * dx + dy * dy <= reach * reach) least = std::min(least, sign * grid.at(column, row));
    }
  }
  return sign * least;
}

HeightGrid opened_slowly(const HeightGrid& grid, double radius) {
  HeightGrid low = grid, high = grid;
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) low.at(x, y) = extreme(grid, x, y, radius, 1);
  }
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) high.at(x, y) = extreme(low, x, y, radius, -1);
  }
  return high;
}

TEST(GroundMethod, HasTheWordsOfTheCommandLine) {
  test::expect_names<GroundMethod>({"smrf", "pmf"});
}

TEST(HeightGrid, OpeningFollowsItsDefinition) {
  for (const auto& [columns, rows] : {std::pair<std::size_t, std::size_t>{1, 1}, {7, 1}, {1, 9}, {13, 17}, {40, 23}}) {
    const HeightGrid grid = random_grid(columns, rows);
    for (const std::size_t radius : {1, 2, 3, 5, 8, 30}) {
      SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows) + ", radius " + std::to_string(radius));
      const HeightGrid slow = opened_slowly(grid, static_cast<double>(radius));
      for (const int threads : {1, 3}) {
        Execution run;
        run.threads = threads;
        EXPECT_EQ(opened(grid, radius, run).z, slow.z);
      }
    }
  }
}

TEST(HeightGrid, FilledHolesContinueAPlane) {
  HeightGrid grid(60, 45);
  const auto plane = [](std::size_t x, std::size_t y) {
    return 3 + 0.25 * static_cast<double>(x) - 0.5 * static_cast<double>(y);
  };
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) {
      if (x < 15 || x > 40 || y < 12 || y > 30) grid.at(x, y) = plane(x, y);
    }
  }
  fill(grid, {});
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) ASSERT_NEAR(grid.at(x, y), plane(x, y), 0.1) << x << ' ' << y;
  }
}

TEST(HeightGrid, InterpolatesBetweenTheMiddlesOfCells) {
  HeightGrid grid(2, 2);
  grid.z = {0, 1, 10, 11};
  EXPECT_EQ(grid.interpolate(0.25, 0.5), 5.25);
  EXPECT_EQ(grid.interpolate(-3, 7), 10);
  EXPECT_EQ(grid.interpolate(1, 1), 11);
}

struct Scene {
  std::vector<Vec3> points;
  std::vector<char> ground;

  void add(const Vec3& p, bool is_ground) {
    points.push_back(p);
    ground.push_back(is_ground);
  }
};

double terrain(double x, double y) {
  return 0.1 * x + 4 * std::sin(0.05 * y);
}

/// Rolling ground with a house 20 m wide, trees, and echoes far below, one or two points a square metre.
Scene scene(double unit = 1) {
  Scene s;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 120), height(3, 12), noise(-0.05, 0.05);
  for (int i = 0; i < 20000; ++i) {
    const double x = place(random), y = place(random), z = terrain(x, y);
    const bool in_house = x > 40 && x < 60 && y > 50 && y < 85, in_tree = std::hypot(x - 90, y - 30) < 6;
    if (in_house) {
      s.add(unit * Vec3(x, y, terrain(50, 67) + 8 + noise(random)), false);
    } else if (in_tree && i % 3) {
      s.add(unit * Vec3(x, y, z + height(random)), false);
    } else if (i % 2000 == 1) {
      s.add(unit * Vec3(x, y, z - 25), false);
    } else {
      s.add(unit * Vec3(x, y, z + noise(random)), true);
    }
  }
  return s;
}

/// Points on the wrong side.
std::size_t errors(const Scene& s, const std::vector<char>& found) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) count += found[i] != s.ground[i];
  return count;
}

TEST(Ground, HousesTreesAndFalseEchoesAreNone) {
  const Scene s = scene();
  const std::vector<char> found = find_ground(s.points, {});
  EXPECT_LT(errors(s, found), s.points.size() / 1000);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool on_roof = !s.ground[i] && std::hypot(s.points[i].x() - 50, s.points[i].y() - 67) < 8;
    EXPECT_FALSE(on_roof && found[i]) << "point " << i;
  }
}

TEST(Ground, AWindowNarrowerThanTheHouseKeepsItsRoof) {
  const Scene s = scene();
  GroundOptions options;
  options.window = 5;
  const std::vector<char> found = find_ground(s.points, options);
  std::size_t roof = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vec3& p = s.points[i];
    roof += found[i] && !s.ground[i] && p.x() > 45 && p.x() < 55 && p.y() > 55 && p.y() < 80;
  }
  EXPECT_GT(roof, 200u);
}

TEST(Ground, DependsNeitherOnUnitsNorOnTheOriginNorOnThreads) {
  const Scene metres = scene(), doubled = scene(2);
  GroundOptions options, twice;
  for (double GroundOptions::*length : {&GroundOptions::cell, &GroundOptions::window, &GroundOptions::threshold})
    twice.*length = 2 * options.*length;
  const std::vector<char> found = find_ground(metres.points, options);
  EXPECT_EQ(find_ground(doubled.points, twice), found);
  std::vector<Vec3> moved = metres.points;
  for (Vec3& p : moved) p += Vec3(4096, -1024, 512);
  EXPECT_EQ(find_ground(moved, options), found);
  Execution run;
  run.threads = 3;
  EXPECT_EQ(find_ground(metres.points, options, run), found);
}

TEST(Ground, PointsWithoutAPositionAreNone) {
  Scene s = scene();
  const std::vector<char> before = find_ground(s.points, {});
  s.points.insert(s.points.begin() + 100, Vec3::Constant(kNaN));
  std::vector<char> after = find_ground(s.points, {});
  EXPECT_FALSE(after[100]);
  after.erase(after.begin() + 100);
  EXPECT_EQ(after, before);
  EXPECT_EQ(find_ground({Vec3(1, 2, 3)}, {}), std::vector<char>{1});
}

TEST(Ground, RefusesWhatIsNoFilter) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1e6, 1e6, 0}};
  const auto refused = [&](const GroundOptions& options, ErrorCode code, const std::vector<Vec3>& of) {
    try {
      find_ground(of, options);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
    }
  };
  for (double GroundOptions::*length : {&GroundOptions::cell, &GroundOptions::window, &GroundOptions::slope,
                                        &GroundOptions::threshold, &GroundOptions::scaling}) {
    for (const double value : {-1.0, kNaN}) {
      GroundOptions options;
      options.*length = value;
      refused(options, ErrorCode::InvalidArgument, {{0, 0, 0}});
    }
  }
  refused({}, ErrorCode::InvalidArgument, points);
  refused({}, ErrorCode::InvalidData, {Vec3::Constant(kNaN)});
}

}  // namespace
}  // namespace kappa
