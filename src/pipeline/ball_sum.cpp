// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/ball_sum.hpp"

#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/shape_operators.hpp"
#include "kappa/search/flann_ball_sum.hpp"

namespace kappa {

std::unique_ptr<BallSum> make_ball_sum(Triangles triangles, const MeasureOptions& options, const Execution& run) {
  if (options.engine == Engine::Flann) return std::make_unique<FlannBallSum>(std::move(triangles), run);
  return std::make_unique<MeasureTree>(std::move(triangles), options.precision, run);
}

std::unique_ptr<BallSum> make_ball_sum(const Mesh& mesh, const Normals& u, const MeasureOptions& options,
                                       const Execution& run) {
  Triangles triangles = triangles_of(mesh, u, options, stage(run, 0.0, 0.3));
  return make_ball_sum(std::move(triangles), options, stage(run, 0.3, 1.0));
}

}  // namespace kappa
