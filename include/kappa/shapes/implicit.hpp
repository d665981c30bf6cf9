// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/analytic.hpp"

namespace kappa {

/// A smooth function whose zero set is the surface, positive outside.
using ImplicitFunction = std::function<ImplicitJet(const Vec3&)>;

struct LevelSetOptions {
  Bounds box;       ///< must hold the surface with room to spare, for a closed mesh
  double step = 1;  ///< of the grid; at most 2000 steps along a side of the box
  Extraction extraction = Extraction::MarchingCubes;
};

/// Mesh of the surface f = 0 in the box, with vertices on it to 1e-13 of the size of the box, true
/// normals along the gradient, truth fields and faces seen counter-clockwise from f > 0. Where the
/// surface leaves the box the mesh has a border, elsewhere it is closed and consistently oriented; it is a
/// manifold where no cell holds two sheets. Marching cubes decide an ambiguous face of the grid the
/// same way from both sides, so they leave no crack.
/// @throws Error InvalidArgument if the box or the step is out of range; InvalidData if f has no zero
/// on the grid.
/// Cost: one evaluation a grid point, memory of two layers and the mesh.
Scan level_set(const ImplicitFunction& f, const LevelSetOptions& options);

/// Nearest zero of f along its gradient, by Newton's method to `tolerance` of length; NaN if it does
/// not converge in 50 steps.
Vec3 project_to_surface(const ImplicitFunction& f, const Vec3& start, double tolerance);

/// Goursat's function 3 (x^4 + y^4 + z^4) - 200 (x^2 + y^2 + z^2) - 800.
ImplicitJet goursat_function(const Vec3& x);

}  // namespace kappa
