// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "ball_fields.hpp"
#include "border.hpp"
#include "border_correction.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/orders.hpp"
#include "kappa/curvature/own_scale.hpp"
#include "kappa/curvature/shape_operators.hpp"

namespace kappa {
namespace {

[[noreturn]] void refuse_border(const std::string& reason) {
  throw OptionError("border", "centre " + reason);
}

void check_border(const CurvatureOptions& options, bool at_zero) {
  if (options.border == BorderEstimate::InBall) return;
  if (options.scale == ScaleChoice::PerPoint)
    refuse_border("is not for `radii` auto-per-point; give a radius, or leave `border` out");
  if (at_zero) refuse_border("needs balls, and `radii` 0 has none; give a positive radius, or leave `border` out");
}

void check_coverage(double least, bool at_zero) {
  if (!(least >= 0 && least <= 1))
    throw OptionError("min_coverage",
                      "= " + std::to_string(least) + ": give the share of the ball to be filled, 0 to 1");
  if (least > 0 && at_zero) throw OptionError("min_coverage", "needs balls: it has no meaning at radius 0");
}

void check_order_of(const CurvatureOptions& options, bool at_zero) {
  if (!options.order) return;
  if (options.scale == ScaleChoice::PerPoint)
    throw OptionError("order", "is chosen for every point with `radii` auto-per-point; leave it out");
  if (*options.order < 1 || *options.order > kMaxOrder)
    throw OptionError("order", "= " + std::to_string(*options.order) + ": give 1 to " + std::to_string(kMaxOrder));
  if (*options.order > 1 && at_zero) throw OptionError("order", "needs balls: above 1 it has no meaning at radius 0");
}

void check_radii(const std::vector<double>& radii) {
  if (radii.empty()) throw OptionError("radii", "are none: give at least one radius");
  for (const double radius : radii) {
    if (radius >= 0 && std::isfinite(radius)) continue;
    throw OptionError("radii",
                      "hold " + std::to_string(radius) + ": give finite radii, 0 or more, in units of the data");
  }
}

/// In balls of the radii of `plan`, with estimates at borders as asked.
std::vector<CurvatureField> fields_at_vertices(const BallSum& balls, const std::vector<Vec3>& vertices,
                                               const Normals& u, const BallPlan& plan, BorderEstimate estimate,
                                               const Execution& run) {
  if (estimate == BorderEstimate::InBall) return curvatures_in_balls(balls, vertices, u, plan, run);
  BorderCorrection border(balls.triangles(), vertices, u, plan.radii, plan.order, stage(run, 0.0, 0.02));
  if (!border.is_needed()) return curvatures_in_balls(balls, vertices, u, plan, stage(run, 0.02, 1.0));
  const auto record = [&](std::size_t r, std::size_t q, const BallMeasures* const* measures) {
    border.record(r, q, measures);
  };
  std::vector<CurvatureField> fields = ball_fields(balls, vertices, u, plan, record, stage(run, 0.02, 0.95));
  border.apply(fields, stage(run, 0.95, 1.0));
  return fields;
}

/// Radii that are not 0.
std::vector<CurvatureField> fields_in_balls(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                            const Execution& run) {
  BallPlan plan{options.radii, options.order.value_or(1), options.ball};
  plan.radii.erase(std::remove(plan.radii.begin(), plan.radii.end(), 0.0), plan.radii.end());
  if (plan.radii.empty()) return {};
  const Triangles& triangles = balls.triangles();
  if (triangles.vertices == triangles.x.size())
    return fields_at_vertices(balls, triangles.x, u, plan, options.border, run);
  return fields_at_vertices(balls, vertices_of(triangles), u, plan, options.border, run);
}

/// One field for each of the radii, in their order.
std::vector<CurvatureField> fields_of_radii(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                            const Execution& run) {
  std::vector<CurvatureField> of_balls = fields_in_balls(balls, u, options, run), fields;
  auto next = of_balls.begin();
  for (const double radius : options.radii) {
    fields.push_back(radius > 0 ? std::move(*next++)
                                : curvatures_at_vertices(balls, u, options.vertex_limit, stage(run, 1.0, 1.0)));
  }
  return fields;
}

}  // namespace

const std::vector<Named<ScaleChoice>>& names_of(ScaleChoice) {
  static const std::vector<Named<ScaleChoice>> names = {
      {ScaleChoice::Automatic, "auto", "one radius from the spacing and the noise of the data"},
      {ScaleChoice::PerPoint, "auto-per-point", "radius and order from the data for every point"}};
  return names;
}

const std::vector<Named<BorderEstimate>>& names_of(BorderEstimate) {
  static const std::vector<Named<BorderEstimate>> names = {
      {BorderEstimate::InBall, "ball", "the curvatures of what is in the ball"},
      {BorderEstimate::AtCentre, "centre", "those at the centre of the ball, for smooth surfaces"}};
  return names;
}

void validate(const CurvatureOptions& options) {
  const bool given = options.scale == ScaleChoice::Given;
  if (given) check_radii(options.radii);
  const bool at_zero = given && std::find(options.radii.begin(), options.radii.end(), 0.0) != options.radii.end();
  check_coverage(options.min_coverage, at_zero);
  check_border(options, at_zero);
  check_order_of(options, at_zero);
}

void validate(const CurvatureOptions& options, const MeasureOptions& measure) {
  validate(measure);
  if (options.border == BorderEstimate::AtCentre && measure.refine > 0)
    refuse_border("is not for faces refined by `refine` " + std::to_string(measure.refine) + "; leave one of them out");
  validate(options);
}

std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  validate(options);
  if (options.scale == ScaleChoice::Automatic)
    throw OptionError("scale", "is automatic, which needs a surface: give radii");
  check_one_each(u.size(), "normal", balls.triangles().vertices, "vertex");
  if (options.border != BorderEstimate::InBall && is_refined(balls.triangles()))
    refuse_border("is not for refined triangles; measure those of the mesh, or leave `border` out");
  std::vector<CurvatureField> fields;
  if (options.scale == ScaleChoice::PerPoint) {
    fields.push_back(estimate_at_own_scale(balls, u, options.ball, run));
  } else {
    fields = fields_of_radii(balls, u, options, run);
  }
  for (CurvatureField& field : fields) {
    if (options.min_coverage > 0) mark_borders(field, options.min_coverage, stage(run, 1.0, 1.0));
  }
  return fields;
}

std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const MeasureOptions& measure, const Execution& run) {
  validate(options, measure);
  if (measure.engine != Engine::Tree)
    throw Error(ErrorCode::Unavailable,
                "engine = flann is not for this call: give engine = tree, or measure with what "
                "make_ball_sum makes (kappa/pipeline/ball_sum.hpp)");
  const MeasureTree balls(triangles_of(mesh, u, measure, stage(run, 0.0, 0.05)), measure.precision,
                          stage(run, 0.05, 0.1));
  return estimate_curvatures(balls, u, options, stage(run, 0.1, 1.0));
}

std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  return estimate_curvatures(mesh, u, options, MeasureOptions(), run);
}

}  // namespace kappa
