// SPDX-License-Identifier: BSD-3-Clause
#include "support/cancelling.hpp"

#include "kappa/curvature/in_balls.hpp"
#include "kappa/segment/labels.hpp"
#include "kappa/segment/regions.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

TEST(SegmentCancel, InWhicheverReport) {
  const shapes::Shape torus = shapes::torus(3, 1, 24, 16);
  const BruteForceBallSum balls(triangles_of(torus.mesh, torus.normals));
  const auto ball = BallDefinition::ExactDensity;
  const std::vector<Vec3>& x = torus.mesh.vertices;
  const Normals& u = torus.normals;
  const CurvatureField field = curvatures_in_balls(balls, x, u, BallPlan{{0.8}, 1, ball}).front();
  CurvatureField own = field;
  own.order = 0;
  for (CurvatureSample& s : own.samples) s.std_error = 0.1;
  const std::vector<Label> labels = classify(field, 0.2);
  LabelOptions flat;
  flat.flatness = 0.1;
  test::expect_cancellable({
      {"classify", [&](const Execution& run) { classify(field, 0.1, run); }},
      {"curvature_threshold", [&](const Execution& run) { curvature_threshold(field, field, 1.0, run); }},
      {"estimate_threshold", [&](const Execution& run) { estimate_threshold(balls, x, u, field, ball, 0.3, run); }},
      {"estimate_threshold of own scales",
       [&](const Execution& run) { estimate_threshold(balls, x, u, own, ball, 0.3, run); }},
      {"curvature_percentile", [&](const Execution& run) { curvature_percentile(field, 98, run); }},
      {"label_threshold", [&](const Execution& run) { label_threshold({}, balls, x, u, field, ball, 0.3, run); }},
      {"label_threshold of a flatness",
       [&](const Execution& run) { label_threshold(flat, balls, x, u, field, ball, 0.3, run); }},
      {"find_regions", [&](const Execution& run) { find_regions(torus.mesh, field, labels, {5.0}, {}, run); }},
  });
}

}  // namespace
}  // namespace kappa
