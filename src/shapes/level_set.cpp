// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "check.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/implicit.hpp"
#include "level_set_grid.hpp"

namespace kappa {
namespace {

constexpr double kMaxSteps = 2000;
constexpr double kRelativeTolerance = 1e-13;

detail::LevelSetGrid grid_of(const LevelSetOptions& options) {
  detail::require_positive("step", options.step);
  if (options.box.empty() || !is_finite(options.box.min) || !is_finite(options.box.max)) {
    throw Error(ErrorCode::InvalidArgument, "box is empty or not finite; it must hold the surface");
  }
  detail::LevelSetGrid grid;
  grid.corner = options.box.min;
  grid.step = options.step;
  grid.tolerance = kRelativeTolerance * options.box.diagonal();
  for (int axis = 0; axis < 3; ++axis) {
    const double steps = std::ceil((options.box.max[axis] - options.box.min[axis]) / options.step);
    detail::require_between("number of steps along the box", steps, 1, kMaxSteps);
    grid.count[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(steps) + 1;
  }
  return grid;
}

}  // namespace

Vec3 project_to_surface(const ImplicitFunction& f, const Vec3& start, double tolerance) {
  constexpr int kSteps = 50;
  Vec3 x = start;
  for (int step = 0; step < kSteps; ++step) {
    const ImplicitJet jet = f(x);
    const Vec3 move = -jet.value / jet.gradient.squaredNorm() * jet.gradient;
    x += move;
    if (move.norm() <= tolerance) return x;
  }
  return Vec3::Constant(kNaN);
}

Scan level_set(const ImplicitFunction& f, const LevelSetOptions& options) {
  const detail::LevelSetGrid grid = grid_of(options);
  detail::LevelSetMesh mesh =
      options.extraction == Extraction::MarchingCubes ? marching_cubes(f, grid) : surface_nets(f, grid);
  if (mesh.faces.empty()) {
    throw Error(ErrorCode::InvalidData, "the function changes its sign nowhere on the grid of step " +
                                            detail::number_text(options.step) + "; take a smaller step or another box");
  }
  std::vector<SurfacePoint> points;
  points.reserve(mesh.points.size());
  for (const auto& x : mesh.points) points.push_back(surface_point(x, f(x)));
  Scan scan = scan_of(points);
  scan.faces = std::move(mesh.faces);
  return scan;
}

}  // namespace kappa
