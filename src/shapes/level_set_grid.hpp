// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/shapes/implicit.hpp"

namespace kappa::detail {

/// Points corner + step (i, j, k) of a grid, 0 <= (i, j, k) < count.
struct LevelSetGrid {
  Vec3 corner;
  double step;
  std::array<std::size_t, 3> count;
  double tolerance;  ///< of the vertices, a length

  Vec3 point(std::size_t i, std::size_t j, std::size_t k) const {
    return corner + step * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  }
  /// Index of (i, j) in a layer.
  std::size_t at(std::size_t i, std::size_t j) const { return j * count[0] + i; }
  std::size_t layer_size() const { return count[0] * count[1]; }
};

/// Values of f on layer k. Zero counts as outside throughout.
inline std::vector<double> layer_values(const ImplicitFunction& f, const LevelSetGrid& grid, std::size_t k) {
  std::vector<double> values;
  values.reserve(grid.layer_size());
  for (std::size_t j = 0; j < grid.count[1]; ++j) {
    for (std::size_t i = 0; i < grid.count[0]; ++i) values.push_back(f(grid.point(i, j, k)).value);
  }
  return values;
}

inline bool inside(double value) {
  return value < 0;
}

/// Vertices and faces of a level set, without normals.
struct LevelSetMesh {
  std::vector<Vec3> points;
  Faces faces;
};

LevelSetMesh marching_cubes(const ImplicitFunction& f, const LevelSetGrid& grid);
LevelSetMesh surface_nets(const ImplicitFunction& f, const LevelSetGrid& grid);

}  // namespace kappa::detail
