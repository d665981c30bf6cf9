// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/analytic.hpp"

/// Scans with known curvature that the tables of surfaces of clouds are about.
namespace kappa::experiments {

struct KnownScan {
  std::string name;
  Scan scan;                         ///< with exact normals
  std::vector<TrueCurvature> truth;  ///< at the points; NaN where there is none
};

/// A published cloud with its exact normals: "torus_010000", "goursat_010000" or "torus-lidar", read from the folder of
/// clouds; truth from the equation of its surface.
/// @throws Error FileNotFound
KnownScan published_scan(const std::string& name);

/// Every point moved by normal deviates along x, y and z, each of standard deviation `per_cent` of the diagonal of the
/// box around the points. Normals and truth stay those of the points before. Deterministic.
KnownScan with_noise(const KnownScan& known, double per_cent);

/// The points of a cloud on one side of two planes, so that it gets a border: x + 0.3 y > 0.7 and z < 1.1.
KnownScan cut(const KnownScan& known);

/// The points of torus-lidar back in the grid of 80 columns and 40 rows that they were taken in, by a camera at
/// (0, 0, 30): columns of equal x / (30 - z), rows of equal y / (30 - z).
KnownScan organised_torus(const KnownScan& torus_lidar);

/// Goursat's surface as a spinning scanner in its middle sees it: `rings` from 30 degrees below the horizon to 30
/// degrees above, `columns` a turn, row by row from the top. Normals inward, where the scanner is.
KnownScan goursat_sweep(std::size_t rings, std::size_t columns);

}  // namespace kappa::experiments
