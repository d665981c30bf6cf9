// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

enum class NoiseKind {
  Ball,    ///< uniform in a ball of radius `amount` x mean length of the edges around the vertex (the SGP 2020
           ///< paper's); meshes only
  Normal,  ///< normal deviate of standard deviation `amount` (a length) along the normal of the point
  Range    ///< normal deviate of standard deviation `amount` (a length) along the beam from `viewpoint`
};

/// What becomes of the normals of a perturbed scan.
enum class NoisyNormals {
  Keep,  ///< they stay the true ones of the unperturbed point
  Drop   ///< the scan has none any more
};

struct NoiseOptions {
  NoiseKind kind = NoiseKind::Ball;
  double amount = 0.3;  ///< not negative; 0 moves nothing
  std::uint64_t seed = 0;
  NoisyNormals normals = NoisyNormals::Keep;
  /// Of the scanner, in the coordinates of the file; Range only. Without it the scan's own viewpoint.
  std::optional<Vec3> viewpoint;
};

/// Moves the points; truth fields stay those of the unperturbed points. The result depends on the scan
/// and the seed alone. Points that are not finite, vertices in no face (Ball), and points without a
/// direction (a zero normal, a point at the viewpoint) stay where they are.
/// @throws Error InvalidArgument if amount is negative or not finite, or if the scan lacks what the
/// kind needs: faces, normals, or a viewpoint.
void add_noise(Scan& scan, const NoiseOptions& options);

}  // namespace kappa
