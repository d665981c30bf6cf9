// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/balls/ball_sum.hpp"

/// Ball sums as the tests of every engine compare them.
namespace kappa::test {

/// `count` random vertices, or all where there are no more, each beside a place off the surface.
std::vector<Vec3> places(const Mesh& mesh, std::size_t count, double spread);

/// The measures of all balls, those of one centre together, in the order of the radii.
std::vector<BallMeasures> sums(const BallSum& balls, const std::vector<Vec3>& centres, const std::vector<double>& radii,
                               BallDefinition ball, const Execution& run = {});

/// A sum with the sum of the absolute values of what every triangle adds to it.
struct ScaledSum {
  BallMeasures ball;
  MeasureSum scale;
};

/// The same by going through all triangles for every ball.
std::vector<ScaledSum> brute_force(const Triangles& triangles, const std::vector<Vec3>& centres,
                                   const std::vector<double>& radii, BallDefinition ball);

/// Largest difference of `got` in units of the sums of absolute values in that ball, those of the tensor's entries
/// together, because a single one may vanish.
double relative_error(const MeasureSum& got, const ScaledSum& expected);

}  // namespace kappa::test
