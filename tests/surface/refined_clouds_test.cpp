// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/shapes/implicit.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa {
namespace {

/// A published cloud with the root mean square errors that its refined umbrellas must not exceed.
struct Case {
  const char* file;
  ImplicitFunction f;
  double radius, mean, k_min, k_max;
};

/// Degree-4 jets have 1.2e-4 1.6e-4 1.8e-4 and 1.2e-4 1.4e-4 1.9e-4 on the first two; on the third they collapse (6.0
/// 10.6 5.8), and half of the error of the best published triangles is 1.1e-3 1.7e-3 1.9e-3.
TEST(RefinedClouds, AreAsGoodAsJetsAndStandSimulatedScans) {
  for (const Case& c : {Case{"torus_010000.pts", clouds::torus_function, 1.6, 1.2e-4, 1.6e-4, 1.8e-4},
                        {"goursat_010000.pts", goursat_function, 0.9, 1.2e-4, 1.4e-4, 1.9e-4},
                        {"torus-lidar.pts", clouds::torus_function, 0.6, 7e-4, 1.2e-3, 7e-4}}) {
    const clouds::TextCloud cloud = clouds::read_text(std::string(KAPPA_SHARED_DATA) + "/clouds/" + c.file);
    if (cloud.x.empty()) GTEST_SKIP() << "no " << c.file << " in " << KAPPA_SHARED_DATA;
    CurvatureOptions options;
    options.radii = {c.radius};
    options.order = 3;
    MeasureOptions measure;
    measure.refine = 2;
    Execution run;
    run.threads = 0;
    const Mesh mesh = umbrella_surface(Vec3::Zero(), cloud.x, cloud.u, {}, run).mesh;
    const CurvatureField field = estimate_curvatures(mesh, cloud.u, options, measure, run)[0];
    const auto rms = [&](double Curvatures::*value, double TrueCurvature::*truth) {
      double sum = 0;
      for (std::size_t i = 0; i < cloud.x.size(); ++i) {
        const TrueCurvature at = surface_point(cloud.x[i], c.f(cloud.x[i])).curvature;
        sum += std::pow(field.samples[i].k.*value - at.*truth, 2);
      }
      return std::sqrt(sum / static_cast<double>(cloud.x.size()));
    };
    EXPECT_LT(rms(&Curvatures::mean, &TrueCurvature::mean), c.mean) << c.file;
    EXPECT_LT(rms(&Curvatures::k_min, &TrueCurvature::k_min), c.k_min) << c.file;
    EXPECT_LT(rms(&Curvatures::k_max, &TrueCurvature::k_max), c.k_max) << c.file;
  }
}

}  // namespace
}  // namespace kappa
