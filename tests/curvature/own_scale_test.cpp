// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/own_scale.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/analytic.hpp"
#include "kappa/shapes/noise.hpp"

namespace kappa {
namespace {

/// Without any parameter nearer the truth than what other methods reach on this noise at the best single radius: rms of
/// mean 2.5e-2, gaussian 1.9e-2, k_min 1.9e-2, k_max 8e-2 (radius 0.5, four averagings).
class BeatsTheBestSingleRadius : public ::testing::TestWithParam<int> {};

TEST_P(BeatsTheBestSingleRadius, OnATorusWithNoise) {
  TorusOptions options;
  options.slices = options.sides = 200;
  Scan scan = torus(options);
  NoiseOptions noise;
  noise.amount = 0.3;
  noise.seed = static_cast<std::uint64_t>(GetParam());
  add_noise(scan, noise);
  const Mesh mesh = mesh_of(scan);
  const Normals u = average_normals(mesh, vertex_normals(mesh, NormalWeights::Uniform), 4);
  Execution run;
  run.threads = 0;
  const CurvatureField f =
      estimate_at_own_scale(MeasureTree(triangles_of(mesh, u)), u, BallDefinition::ExactDensity, run);
  const std::vector<double>&k_min = scan.field("k_min")->values, &k_max = scan.field("k_max")->values;
  double mean = 0, gaussian = 0, least = 0, most = 0;
  for (std::size_t i = 0; i < f.samples.size(); ++i) {
    const Curvatures& k = f.samples[i].k;
    mean += std::pow(k.mean - (k_min[i] + k_max[i]) / 2, 2);
    gaussian += std::pow(k.gaussian - k_min[i] * k_max[i], 2);
    least += std::pow(k.k_min - k_min[i], 2);
    most += std::pow(k.k_max - k_max[i], 2);
  }
  const double n = static_cast<double>(f.samples.size());
  EXPECT_LT(std::sqrt(mean / n), 2.5e-2);
  EXPECT_LT(std::sqrt(gaussian / n), 1.9e-2);
  EXPECT_LT(std::sqrt(least / n), 1.9e-2);
  EXPECT_LT(std::sqrt(most / n), 8e-2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, BeatsTheBestSingleRadius, ::testing::Values(31, 32, 33));

}  // namespace
}  // namespace kappa
