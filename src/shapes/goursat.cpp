// SPDX-License-Identifier: BSD-3-Clause
#include "check.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/implicit.hpp"

namespace kappa {
namespace {

/// Half the side of a box that holds the surface: |x| <= 9.66 on it.
constexpr double kHalfSide = 9.75;

}  // namespace

ImplicitJet goursat_function(const Vec3& x) {
  const Vec3 squares = x.cwiseAbs2();
  ImplicitJet jet;
  jet.value = 3 * squares.squaredNorm() - 200 * squares.sum() - 800;
  jet.gradient = (12 * squares.array() - 400).matrix().cwiseProduct(x);
  jet.hessian = (36 * squares.array() - 400).matrix().asDiagonal();
  return jet;
}

Scan goursat(const GoursatOptions& options) {
  detail::require_between("step", options.step, 0.02, 2);
  LevelSetOptions level;
  // Off the symmetry of the surface by odd parts of a step: no grid point falls on the surface, and
  // the sampling is a general one.
  const Vec3 shift(0.3172, 0.4311, 0.2193);
  level.box.min = Vec3::Constant(-kHalfSide) - options.step * (Vec3::Ones() + shift);
  level.box.max = Vec3::Constant(kHalfSide + options.step);
  level.step = options.step;
  level.extraction = options.extraction;
  return level_set(goursat_function, level);
}

}  // namespace kappa
