// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kappa/core/error.hpp"
#include "kappa/shapes/analytic.hpp"
#include "kappa/shapes/scanner.hpp"

namespace kappa {
namespace {

struct Refusal {
  std::string start;  ///< of the message: parameter and value
  std::function<void()> call;
};

void expect_refused(const std::vector<Refusal>& refusals) {
  for (const auto& refusal : refusals) {
    try {
      refusal.call();
      ADD_FAILURE() << "accepted: " << refusal.start;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidArgument) << refusal.start;
      EXPECT_EQ(std::string(error.what()).rfind(refusal.start + "; it must be ", 0), 0U) << error.what();
    }
  }
}

/// The default options with one changed.
template <class Options, class Value, class Call>
std::function<void()> with(Call call, Value Options::*option, Value value) {
  return [=] {
    Options options;
    options.*option = value;
    call(options);
  };
}

TEST(Refusal, NamesTheParameterOfAShape) {
  expect_refused({
      {"radius is 0", with(sphere, &SphereOptions::radius, 0.0)},
      {"radius is nan", with(sphere, &SphereOptions::radius, kNaN)},
      {"slices is 2", with(sphere, &SphereOptions::slices, 2)},
      {"rings is 1", with(sphere, &SphereOptions::rings, 1)},
      {"number of vertices is 2.97000003e+09", with(sphere, &SphereOptions::slices, 90000000)},
      {"radius is -1", with(icosphere, &IcosphereOptions::radius, -1.0)},
      {"subdivisions is 12", with(icosphere, &IcosphereOptions::subdivisions, 12)},
      {"subdivisions is -1", with(icosphere, &IcosphereOptions::subdivisions, -1)},
      {"major_radius is 1", with(torus, &TorusOptions::major_radius, 1.0)},
      {"minor_radius is 0", with(torus, &TorusOptions::minor_radius, 0.0)},
      {"slices is 0", with(torus, &TorusOptions::slices, 0)},
      {"sides is 2", with(torus, &TorusOptions::sides, 2)},
      {"twist is 101", with(torus, &TorusOptions::twist, 101)},
      {"height is 0", with(cylinder, &CylinderOptions::height, 0.0)},
      {"rings is 0", with(cylinder, &CylinderOptions::rings, 0)},
      {"a is inf", with(quadric, &QuadricOptions::a, std::numeric_limits<double>::infinity())},
      {"size is -2", with(quadric, &QuadricOptions::size, -2.0)},
      {"cells is 0", with(quadric, &QuadricOptions::cells, 0)},
      {"a is 0", with(saddle, &SaddleOptions::a, 0.0)},
      {"size is 0", with(plane, &PlaneOptions::size, 0.0)},
      {"slices is 2", with(lantern, &LanternOptions::slices, 2)},
      {"rings is 0", with(lantern, &LanternOptions::rings, 0)},
      {"step is 0.001", with(goursat, &GoursatOptions::step, 0.001)},
      {"step is 3", with(goursat, &GoursatOptions::step, 3.0)},
      {"points is 0",
       [] {
         sample_sphere(1, {0, 0});
       }},
      {"radius is 0", [] { sample_sphere(0, {}); }},
      {"major_radius is 1", [] { sample_torus(1, 2, {}); }},
      {"height is -1", [] { sample_cylinder(1, -1, {}); }},
      {"size is 0", [] { sample_quadric(1, 1, 0, {}); }},
      {"points is 200000000",
       [] {
         sample_goursat({200000000, 0});
       }},
  });
}

std::function<void()> with_scene(const std::function<void(Scene&)>& change) {
  return [change] {
    AirborneOptions options;
    change(options.scene);
    airborne_scan(options);
  };
}

TEST(Refusal, NamesTheParameterOfAScan) {
  using Air = AirborneOptions;
  expect_refused({
      {"width is 0", with(airborne_scan, &Air::width, 0.0)},
      {"depth is -1", with(airborne_scan, &Air::depth, -1.0)},
      {"density is 0", with(airborne_scan, &Air::density, 0.0)},
      {"number of points is 2.56e+10", with(airborne_scan, &Air::density, 1e6)},
      {"altitude is 20", with(airborne_scan, &Air::altitude, 20.0)},
      {"half_angle is 0", with(airborne_scan, &Air::half_angle, 0.0)},
      {"half_angle is 1.5", with(airborne_scan, &Air::half_angle, 1.5)},
      {"overlap is 1", with(airborne_scan, &Air::overlap, 1.0)},
      {"jitter is 2", with(airborne_scan, &Air::jitter, 2.0)},
      {"range_noise is -0.03", with(airborne_scan, &Air::range_noise, -0.03)},
      {"duplicates is 1.1", with(airborne_scan, &Air::duplicates, 1.1)},
      {"crease_margin is -1", with(airborne_scan, &Air::crease_margin, -1.0)},
      {"origin is nan", with(airborne_scan, &Air::origin, Vec3(0, kNaN, 0))},
      {"wave x_length is 0", with_scene([](Scene& scene) { scene.terrain.waves[0].x_length = 0; })},
      {"bump across is 0", with_scene([](Scene& scene) { scene.terrain.bumps[0].across = 0; })},
      {"building width is 30", with_scene([](Scene& scene) { scene.buildings[0].width = 30; })},
      {"building pitch is -1", with_scene([](Scene& scene) { scene.buildings[0].pitch = -1; })},
      {"points is 0", with(waves_scan, &WavesOptions::points, std::size_t{0})},
      {"x_length is 0", with(waves_scan, &WavesOptions::x_length, 0.0)},
      {"range_noise is nan", with(waves_scan, &WavesOptions::range_noise, kNaN)},
  });
}

}  // namespace
}  // namespace kappa
