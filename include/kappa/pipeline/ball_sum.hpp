// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/balls/measure_options.hpp"

namespace kappa {

/// The ball sum of triangles, of the engine and precision asked for.
/// @throws Cancelled
std::unique_ptr<BallSum> make_ball_sum(Triangles triangles, const MeasureOptions& options, const Execution& run = {});

/// The same of a mesh with corrected normals `u` at its vertices, refined if the options ask for it.
/// @throws OptionError as `validate(MeasureOptions)` does, Error as `triangles_of` does; Cancelled.
std::unique_ptr<BallSum> make_ball_sum(const Mesh& mesh, const Normals& u, const MeasureOptions& options,
                                       const Execution& run = {});

}  // namespace kappa
