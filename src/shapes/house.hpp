// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/shapes/terrain.hpp"

namespace kappa::detail {

/// A side of a house: its inside is where normal . x <= offset.
struct HousePlane {
  Vec3 normal;
  double offset;
  enum class Kind { Wall, Roof } kind;
};

/// A house as the convex set inside all of its planes, open downward.
std::vector<HousePlane> house_planes(const Scene& scene, const Building& building);

}  // namespace kappa::detail
