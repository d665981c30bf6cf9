// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/shapes/truth.hpp"

namespace kappa {

/// amplitude * sin(x / x_length + x_phase) * sin(y / y_length + y_phase). Lengths > 0.
struct Wave {
  double amplitude = 1;
  double x_length = 10, y_length = 10;
  double x_phase = 0, y_phase = 0;  ///< rad
};

/// height * exp(-(s / along)^2 / 2 - (t / across)^2 / 2), with (s, t) the plan coordinates relative to
/// `centre` along and across the direction `heading` (rad from the x axis). A hill, a hollow (height < 0), or,
/// where along is much larger than across, a ridge or a valley: -height / across^2 is its curvature
/// at the crest, up to sign. `along` may be infinite. Lengths > 0.
struct Bump {
  Vec2 centre = Vec2::Zero();
  double height = 1;
  double along = 10, across = 10;
  double heading = 0;
};

/// A smooth height field, known with its derivatives.
struct Terrain {
  double base = 0;            ///< height
  Vec2 slope = Vec2::Zero();  ///< dz/dx, dz/dy of its plane part
  std::vector<Wave> waves;
  std::vector<Bump> bumps;
};

HeightJet height_at(const Terrain& terrain, double x, double y);

enum class RoofKind {
  Gabled,  ///< two planes that meet in a ridge along the length
  Hipped   ///< four planes of equal pitch
};

/// A house with vertical walls on a rectangle.
struct Building {
  Vec2 centre = Vec2::Zero();
  double length = 20, width = 12;  ///< m, 0 < width <= length
  double heading = 0;              ///< of the length, rad from the x axis
  double eaves = 5;                ///< height of the eaves above the terrain at the centre, m
  double pitch = 0.6;              ///< rise over run, >= 0
  RoofKind roof = RoofKind::Gabled;
};

/// Terrain with houses on it.
struct Scene {
  Terrain terrain;
  std::vector<Building> buildings;  ///< must not overlap
};

/// The scene of the demo, for 160 m x 160 m: gentle undulation, two ridges, a valley, passes between
/// hills, a hill and a hollow, with radii of curvature of 15 to 60 m at their crests, and two houses.
Scene default_scene();

/// What a vertical line meets first.
struct SceneSample {
  HeightJet height;
  int building = -1;  ///< index of the building whose roof it is, -1 on the ground
  /// In plan, to the nearest edge (walls, ridge, hips) of a building; infinity without buildings.
  double crease_distance = std::numeric_limits<double>::infinity();
};
SceneSample sample_scene(const Scene& scene, double x, double y);

/// @throws Error InvalidArgument that names the first parameter out of its range.
void validate(const Scene& scene);

}  // namespace kappa
