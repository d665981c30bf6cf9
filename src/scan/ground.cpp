// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/ground.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "height_grid.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096, kRowsAtOnce = 16;

void check(const char* name, double value, bool may_be_zero) {
  if (std::isfinite(value) && (value > 0 || (may_be_zero && value == 0))) return;
  throw Error(ErrorCode::InvalidArgument, std::string("the ground filter's ") + name + " is " + std::to_string(value) +
                                              (may_be_zero ? ": give 0 or more" : ": give a positive number"));
}

void check(const GroundOptions& options) {
  check("cell", options.cell, false);
  check("window", options.window, false);
  check("slope", options.slope, true);
  check("threshold", options.threshold, true);
  check("scaling", options.scaling, true);
}

/// The plan of the points, in cells.
class Plan {
 public:
  Plan(const std::vector<Vec3>& points, double cell) : cell_(cell) {
    constexpr double kMostCells = 4e8;
    const Bounds box = bounds(points);
    if (box.empty()) throw Error(ErrorCode::InvalidData, "no point has a position, so none can be ground");
    corner_ = box.min;
    const double columns = std::floor((box.max.x() - box.min.x()) / cell) + 1,
                 rows = std::floor((box.max.y() - box.min.y()) / cell) + 1;
    if (!(columns * rows <= kMostCells)) {
      throw Error(ErrorCode::InvalidArgument, "the ground filter's cell is " + std::to_string(cell) + ", which makes " +
                                                  std::to_string(columns * rows) +
                                                  " cells of the extent: give a larger one");
    }
    columns_ = static_cast<std::size_t>(columns);
    rows_ = static_cast<std::size_t>(rows);
  }

  double x(const Vec3& p) const { return (p.x() - corner_.x()) / cell_; }
  double y(const Vec3& p) const { return (p.y() - corner_.y()) / cell_; }

  /// Heights of the lowest points.
  HeightGrid lowest(const std::vector<Vec3>& points, const Execution& run) const {
    HeightGrid grid(columns_, rows_);
    serial_for(points.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3& p = points[i];
        if (!is_finite(p)) continue;
        double& z = grid.at(static_cast<std::size_t>(x(p)), static_cast<std::size_t>(y(p)));
        if (!(z <= p.z())) z = p.z();
      }
    });
    return grid;
  }

 private:
  double cell_;
  Vec3 corner_;
  std::size_t columns_ = 0, rows_ = 0;
};

/// Radii in cells: all small ones, then a quarter larger each.
std::vector<std::size_t> radii_up_to(std::size_t largest) {
  std::vector<std::size_t> radii;
  for (std::size_t r = 1; r < largest; r += std::max<std::size_t>(1, r / 4)) radii.push_back(r);
  radii.push_back(largest);
  return radii;
}

/// Cells that stand out of the opened surface; `surface` is full.
std::vector<char> find_objects(HeightGrid surface, double rise, std::size_t largest, const Execution& run) {
  std::vector<char> objects(surface.z.size(), 0);
  const std::vector<std::size_t> radii = radii_up_to(largest);
  const double parts = static_cast<double>(radii.size());
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const Execution part = stage(run, static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts);
    HeightGrid next = opened(surface, radii[k], stage(part, 0.0, 0.9));
    const double most = rise * static_cast<double>(radii[k]);
    for_each_cell(surface, stage(part, 0.9, 1.0), [&](std::size_t i) {
      if (surface.z[i] - next.z[i] > most) objects[i] = 1;
    });
    surface = std::move(next);
  }
  return objects;
}

/// Cells far below their neighbours: the objects of the surface upside down.
std::vector<char> find_false_echoes(HeightGrid surface, double cell, const Execution& run) {
  constexpr double kSteepest = 5;
  negate(surface, stage(run, 0.0, 0.1));
  return find_objects(std::move(surface), kSteepest * cell, 1, stage(run, 0.1, 1.0));
}

void clear(HeightGrid& surface, const std::vector<char>& cells, const Execution& run) {
  if (std::find(cells.begin(), cells.end(), 0) == cells.end()) return;
  for_each_cell(surface, run, [&](std::size_t i) {
    if (cells[i]) surface.z[i] = kNaN;
  });
}

/// The ground at the middles of the cells.
HeightGrid ground_surface(HeightGrid lowest, const GroundOptions& options, const Execution& run) {
  HeightGrid full = lowest;
  fill(full, stage(run, 0.0, 0.1));
  clear(lowest, find_false_echoes(full, options.cell, stage(run, 0.1, 0.2)), stage(run, 0.2, 0.2));
  full = lowest;
  fill(full, stage(run, 0.2, 0.3));
  const auto largest = static_cast<std::size_t>(std::ceil(options.window / options.cell));
  const std::vector<char> objects =
      find_objects(std::move(full), options.slope * options.cell, largest, stage(run, 0.3, 0.9));
  clear(lowest, objects, stage(run, 0.9, 0.9));
  fill(lowest, stage(run, 0.9, 1.0));
  return lowest;
}

/// Rise over run, by central differences.
HeightGrid slope_of(const HeightGrid& surface, double cell, const Execution& run) {
  HeightGrid slope(surface.columns, surface.rows);
  const auto of_row = [&](std::size_t y) {
    const std::size_t below = y > 0 ? y - 1 : y, above = std::min(y + 1, surface.rows - 1);
    for (std::size_t x = 0; x < surface.columns; ++x) {
      const std::size_t left = x > 0 ? x - 1 : x, right = std::min(x + 1, surface.columns - 1);
      const double across = static_cast<double>(std::max<std::size_t>(1, right - left)) * cell,
                   along = static_cast<double>(std::max<std::size_t>(1, above - below)) * cell;
      slope.at(x, y) = std::hypot((surface.at(right, y) - surface.at(left, y)) / across,
                                  (surface.at(x, above) - surface.at(x, below)) / along);
    }
  };
  parallel_for(surface.rows, kRowsAtOnce, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t y = begin; y < end; ++y) of_row(y);
  });
  return slope;
}

}  // namespace

const std::vector<Named<GroundMethod>>& names_of(GroundMethod) {
  static const std::vector<Named<GroundMethod>> names = {
      {GroundMethod::Morphological, "smrf", "simple morphological filter"},
      {GroundMethod::Progressive, "pmf", "progressive morphological filter of PCL"},
  };
  return names;
}

std::vector<char> find_ground(const std::vector<Vec3>& points, const GroundOptions& options, const Execution& run) {
  check(options);
  const Plan plan(points, options.cell);
  const HeightGrid surface =
      ground_surface(plan.lowest(points, stage(run, 0.0, 0.05)), options, stage(run, 0.05, 0.85));
  const HeightGrid slope = slope_of(surface, options.cell, stage(run, 0.85, 0.9));
  std::vector<char> ground(points.size(), 0);
  parallel_for(points.size(), kBlock, stage(run, 0.9, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_finite(points[i])) continue;
      const double x = plan.x(points[i]) - 0.5, y = plan.y(points[i]) - 0.5;
      const double most = options.threshold + options.scaling * slope.interpolate(x, y);
      ground[i] = std::abs(points[i].z() - surface.interpolate(x, y)) <= most;
    }
  });
  return ground;
}

}  // namespace kappa
