// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/curvature/estimate.hpp"
#include "kappa/shapes/analytic.hpp"

/// Surfaces with known curvature that the tables of accuracy are about.
namespace kappa::experiments {

struct Subject {
  Mesh mesh;
  Normals u;                         ///< corrected normals that are measured with
  std::vector<TrueCurvature> truth;  ///< at the vertices
};

/// Torus R = 3, r = 1 of n x n vertices with its true normals.
Subject torus(int n);

/// The same with every vertex moved within a ball of `amount` x mean edge; plain mean normals of the faces, averaged
/// `passes` times; truth of the vertices before.
Subject noisy_torus(int n, double amount, int passes, std::uint64_t seed = 1);

/// Goursat's surface by marching cubes of step h with its true normals.
Subject goursat(double h);

/// The same by surface nets.
Subject goursat_nets(double h);

/// The torus of quads.
Subject torus_of_quads(int n);

/// Faces 2 i and 2 i + 1 joined along the edge that they share.
Subject joined(Subject s);

/// Every face without its second corner, and the triangle that is cut off with it.
Subject trimmed(Subject s);

/// Noise as of the torus on Goursat's surface by marching cubes of step h.
Subject noisy_goursat(double h, double amount, int passes, std::uint64_t seed = 1);

/// Umbrella surface (16 neighbours) of a published cloud with exact normals: "torus_010000", "goursat_010000",
/// "torus-lidar", read from the folder of clouds. With `noise` > 0 each point is moved by a normal deviate of that
/// length along its normal and the normals are those that the program fits, with the signs of the exact ones.
Subject cloud(const std::string& name, double noise = 0);

/// Root mean square errors and the largest ones over the valid samples at points whose truth is known.
struct Errors {
  double mean = 0, gaussian = 0, k_min = 0, k_max = 0;
  double max_mean = 0, max_gaussian = 0, max_k_min = 0, max_k_max = 0;
  std::size_t missing = 0;  ///< points whose truth is known but not the curvature
};
Errors errors(const CurvatureField& field, const std::vector<TrueCurvature>& truth);

}  // namespace kappa::experiments
