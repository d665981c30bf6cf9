// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/terrain.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "house.hpp"

namespace kappa {
namespace {

HeightJet wave_jet(const Wave& wave, double x, double y) {
  const double px = x / wave.x_length + wave.x_phase, py = y / wave.y_length + wave.y_phase;
  const double sx = std::sin(px), cx = std::cos(px) / wave.x_length;
  const double sy = std::sin(py), cy = std::cos(py) / wave.y_length;
  HeightJet jet;
  jet.z = wave.amplitude * sx * sy;
  jet.zx = wave.amplitude * cx * sy;
  jet.zy = wave.amplitude * sx * cy;
  jet.zxx = -jet.z / (wave.x_length * wave.x_length);
  jet.zxy = wave.amplitude * cx * cy;
  jet.zyy = -jet.z / (wave.y_length * wave.y_length);
  return jet;
}

/// A direction in plan and the one at its left.
struct Axes {
  explicit Axes(double heading) : along(std::cos(heading), std::sin(heading)), across(-along.y(), along.x()) {}
  Vec2 along, across;
};

HeightJet bump_jet(const Bump& bump, double x, double y) {
  const Axes axes(bump.heading);
  const Vec2 offset = Vec2(x, y) - bump.centre;
  const double p = 1 / (bump.along * bump.along), q = 1 / (bump.across * bump.across);
  const double s = offset.dot(axes.along), t = offset.dot(axes.across);
  HeightJet jet;
  jet.z = bump.height * std::exp(-0.5 * (p * s * s + q * t * t));
  // z = height exp(-e / 2): gradient -z g with g half the gradient of e, second derivatives z (g g^T - e'' / 2).
  const Vec2 g = p * s * axes.along + q * t * axes.across;
  const auto second = [&](int i, int j) {
    return jet.z * (g[i] * g[j] - p * axes.along[i] * axes.along[j] - q * axes.across[i] * axes.across[j]);
  };
  jet.zx = -jet.z * g.x();
  jet.zy = -jet.z * g.y();
  jet.zxx = second(0, 0);
  jet.zxy = second(0, 1);
  jet.zyy = second(1, 1);
  return jet;
}

/// A point in plan relative to a building: along its length, and across.
Vec2 building_coordinates(const Building& building, double x, double y) {
  const Axes axes(building.heading);
  const Vec2 offset = Vec2(x, y) - building.centre;
  return {offset.dot(axes.along), offset.dot(axes.across)};
}

Vec2 half_size(const Building& building) {
  return {0.5 * building.length, 0.5 * building.width};
}

bool on_building(const Building& building, const Vec2& p) {
  return (p.cwiseAbs().array() <= half_size(building).array()).all();
}

/// Height of the roof above the eaves, and the outward direction it falls along, in the building's coordinates.
double roof_rise(const Building& building, const Vec2& p, Vec2& fall) {
  const Vec2 room = half_size(building) - p.cwiseAbs();
  const bool end = building.roof == RoofKind::Hipped && room.x() < room.y();
  fall = end ? Vec2(std::copysign(1.0, p.x()), 0) : Vec2(0, std::copysign(1.0, p.y()));
  return building.pitch * (end ? room.x() : room.y());
}

double eaves_height(const Scene& scene, const Building& building) {
  return height_at(scene.terrain, building.centre.x(), building.centre.y()).z + building.eaves;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double length_sq = d.squaredNorm();
  const double t = length_sq > 0 ? std::clamp((p - a).dot(d) / length_sq, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

/// Distance in plan to the walls, the ridge and the hips.
double crease_distance(const Building& building, const Vec2& p) {
  const Vec2 half = half_size(building), q = p.cwiseAbs(), beyond = q - half;
  const double outside = beyond.cwiseMax(0).norm();
  if (outside > 0) return outside;
  const double wall = -beyond.maxCoeff();
  if (building.roof == RoofKind::Gabled) return std::min(wall, q.y());
  const Vec2 ridge_end(half.x() - half.y(), 0);
  return std::min({wall, distance_to_segment(q, Vec2::Zero(), ridge_end), distance_to_segment(q, half, ridge_end)});
}

void validate_building(const Building& building) {
  detail::require_finite("building centre", building.centre.sum());
  detail::require_positive("building length", building.length);
  detail::require_positive("building width", building.width);
  detail::require_between("building width", building.width, 0, building.length);
  detail::require_finite("building heading", building.heading);
  detail::require_finite("building eaves", building.eaves);
  detail::require_not_negative("building pitch", building.pitch);
}

}  // namespace

HeightJet height_at(const Terrain& terrain, double x, double y) {
  HeightJet jet;
  jet.z = terrain.base + terrain.slope.x() * x + terrain.slope.y() * y;
  jet.zx = terrain.slope.x();
  jet.zy = terrain.slope.y();
  for (const auto& wave : terrain.waves) jet += wave_jet(wave, x, y);
  for (const auto& bump : terrain.bumps) jet += bump_jet(bump, x, y);
  return jet;
}

SceneSample sample_scene(const Scene& scene, double x, double y) {
  SceneSample sample;
  for (std::size_t i = 0; i < scene.buildings.size(); ++i) {
    const Building& building = scene.buildings[i];
    const Vec2 p = building_coordinates(building, x, y);
    sample.crease_distance = std::min(sample.crease_distance, crease_distance(building, p));
    if (sample.building >= 0 || !on_building(building, p)) continue;
    sample.building = static_cast<int>(i);
    const Axes axes(building.heading);
    Vec2 fall;
    sample.height.z = eaves_height(scene, building) + roof_rise(building, p, fall);
    const Vec2 gradient = -building.pitch * (fall.x() * axes.along + fall.y() * axes.across);
    sample.height.zx = gradient.x();
    sample.height.zy = gradient.y();
  }
  if (sample.building < 0) sample.height = height_at(scene.terrain, x, y);
  return sample;
}

std::vector<detail::HousePlane> detail::house_planes(const Scene& scene, const Building& building) {
  using Kind = HousePlane::Kind;
  const Axes axes(building.heading);
  const double eaves = eaves_height(scene, building);
  std::vector<HousePlane> planes;
  const auto add_side = [&](const Vec2& outward, double half, Kind kind) {
    const Vec2 slope = kind == Kind::Wall ? outward : building.pitch * outward;
    const double height = kind == Kind::Wall ? half : eaves + building.pitch * half;
    planes.push_back(
        {{slope.x(), slope.y(), kind == Kind::Wall ? 0.0 : 1.0}, slope.dot(building.centre) + height, kind});
  };
  for (const double side : {1.0, -1.0}) {
    add_side(side * axes.along, 0.5 * building.length, Kind::Wall);
    add_side(side * axes.across, 0.5 * building.width, Kind::Wall);
    add_side(side * axes.across, 0.5 * building.width, Kind::Roof);
    if (building.roof == RoofKind::Hipped) add_side(side * axes.along, 0.5 * building.length, Kind::Roof);
  }
  return planes;
}

void validate(const Scene& scene) {
  detail::require_finite("terrain base", scene.terrain.base);
  detail::require_finite("terrain slope", scene.terrain.slope.sum());
  for (const auto& wave : scene.terrain.waves) {
    detail::require_finite("wave amplitude", wave.amplitude);
    detail::require_positive("wave x_length", wave.x_length);
    detail::require_positive("wave y_length", wave.y_length);
    detail::require_finite("wave phase", wave.x_phase + wave.y_phase);
  }
  for (const auto& bump : scene.terrain.bumps) {
    detail::require_finite("bump centre", bump.centre.sum());
    detail::require_finite("bump height", bump.height);
    if (!(bump.along > 0)) detail::refuse("bump along", bump.along, "above 0");
    if (!(bump.across > 0)) detail::refuse("bump across", bump.across, "above 0");
    detail::require_finite("bump heading", bump.heading);
  }
  for (const auto& building : scene.buildings) validate_building(building);
}

Scene default_scene() {
  Scene scene;
  scene.terrain.base = 10;
  scene.terrain.slope = {0.02, -0.015};
  scene.terrain.waves = {{0.8, 24, 28, 0.3, 1.1}};
  scene.terrain.bumps = {
      {{42, 122}, 6, 45, 11, 0.45},    // ridge
      {{126, 128}, 5, 34, 9, -0.75},   // sharper ridge
      {{58, 66}, -5.5, 60, 11, 0.25},  // valley
      {{128, 70}, 7, 14, 14, 0},       // hill
      {{124, 30}, 6, 13, 13, 0},       // second hill: a pass lies between the two
      {{28, 28}, -5, 11, 11, 0},       // hollow
  };
  scene.buildings = {{{86, 97}, 22, 12, 0.3, 5, 0.7, RoofKind::Gabled},
                     {{80, 24}, 20, 14, 1.2, 6, 0.55, RoofKind::Hipped}};
  return scene;
}

}  // namespace kappa
