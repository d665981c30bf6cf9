// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "border.hpp"
#include "border_correction.hpp"
#include "core/large_array.hpp"
#include "curvature_sample.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/orders.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/curvature/own_scale.hpp"
#include "kappa/curvature/refine.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

/// The different balls that radii of one order need, and which of them each radius is made of.
struct BallPlan {
  std::vector<double> radii;                              ///< each once
  std::vector<std::array<std::size_t, kMaxOrder>> balls;  ///< of each radius asked for

  BallPlan(const std::vector<double>& asked, int order) {
    for (const double radius : asked) {
      std::array<std::size_t, kMaxOrder> of_radius{};
      auto to = of_radius.begin();
      for (const double r : order_radii(radius, order)) *to++ = place_of(r);
      balls.push_back(of_radius);
    }
  }

 private:
  std::size_t place_of(double radius) {
    const auto found = std::find(radii.begin(), radii.end(), radius);
    if (found != radii.end()) return static_cast<std::size_t>(found - radii.begin());
    radii.push_back(radius);
    return radii.size() - 1;
  }
};

void check_count(std::size_t normals, std::size_t points, const char* what) {
  if (normals == points) return;
  throw Error(ErrorCode::InvalidArgument, std::to_string(normals) + " normals for " + std::to_string(points) + " " +
                                              what + "s: give one a " + what);
}

/// Adds triangle `t` as a vertex sees it in the limit of vanishing balls: its density at the vertex, by its angle.
void add_limit(const MeasuredTriangles& triangles, std::size_t t, std::size_t corner, BallMeasures& to) {
  const auto& c = triangles.corners[t];
  const Vec3& x = triangles.x[c[corner]];
  const Vec3 a = triangles.x[c[(corner + 1) % 3]] - x, b = triangles.x[c[(corner + 2) % 3]] - x;
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  MeasureSum m = measures_of(triangles, t);
  ++to.face_count;
  if (!(m.area > 0)) return;
  m *= triangles.weight(t) * angle / m.area;
  to.sum += m;
}

/// Every vertex below `vertices` gets the whole faces around it, a polygon with all of its parts.
void add_stars(const MeasuredTriangles& triangles, std::vector<BallMeasures>& sums) {
  const auto add_to = [&](Index v, const MeasureSum& sum, Index parts) {
    sums[v].sum += sum;
    sums[v].face_count += parts;
  };
  const std::vector<Index> parts = parts_of_faces(triangles);
  const bool split = std::any_of(parts.begin(), parts.end(), [](Index n) { return n > 1; });
  std::vector<MeasureSum> faces(split ? parts.size() : 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Index face = triangles.faces[t];
    const MeasureSum m = measures_of(triangles, t);
    if (parts[face] > 1) {
      faces[face] += m;
    } else {
      for (const Index v : triangles.corners[t]) add_to(v, m, 1);
    }
  }
  // Each vertex of a face in several parts is the first corner of one of them; other first corners are inside it.
  for (std::size_t t = 0; split && t < triangles.size(); ++t) {
    const Index face = triangles.faces[t], v = triangles.corners[t][0];
    if (parts[face] > 1 && v < triangles.vertices) add_to(v, faces[face], parts[face]);
  }
}

void add_limits(const MeasuredTriangles& triangles, std::vector<BallMeasures>& sums) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Index v = triangles.corners[t][corner];
      if (v < sums.size()) add_limit(triangles, t, corner, sums[v]);
    }
  }
}

/// Curvatures of balls; `border`, if any, is told of each.
std::vector<CurvatureField> measure_balls(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                                          const CurvatureOptions& options, const Execution& run,
                                          BorderCorrection* border) {
  std::vector<CurvatureField> fields;
  for (const double radius : options.radii)
    fields.push_back({radius, fetched_vector(centres.size(), CurvatureSample(), run), options.order});
  const BallPlan plan(options.radii, options.order);
  balls.sum(centres, plan.radii, options.ball, run, [&](std::size_t q, const BallMeasures* measures) {
    if (!usable(centres[q], u[q])) return;
    for (std::size_t r = 0; r < fields.size(); ++r) {
      std::array<const BallMeasures*, kMaxOrder> of_radius{};
      for (std::size_t b = 0; b < of_radius.size(); ++b) of_radius[b] = measures + plan.balls[r][b];
      fields[r].samples[q] = make_sample(of_radius.data(), options.order, options.radii[r], u[q]);
      if (border) border->record(r, q, of_radius.data());
    }
  });
  return fields;
}

std::vector<CurvatureField> measure_at_vertices(const BallSum& balls, const std::vector<Vec3>& vertices,
                                                const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  if (options.border == BorderEstimate::InBall) return measure_balls(balls, vertices, u, options, run, nullptr);
  BorderCorrection border(balls.triangles(), vertices, u, options.radii, options.order, stage(run, 0.0, 0.02));
  if (!border.is_needed()) return measure_balls(balls, vertices, u, options, stage(run, 0.02, 1.0), nullptr);
  std::vector<CurvatureField> fields = measure_balls(balls, vertices, u, options, stage(run, 0.02, 0.95), &border);
  border.apply(fields, stage(run, 0.95, 1.0));
  return fields;
}

[[noreturn]] void refuse_border(const std::string& of_what) {
  throw Error(ErrorCode::InvalidArgument, "border = at centre " + of_what + ", or take border = in ball");
}

void check_border(const CurvatureOptions& options) {
  if (options.border == BorderEstimate::InBall) return;
  if (options.refine > 0) refuse_border("with refine = " + std::to_string(options.refine) + ": do not refine");
  if (options.scale == ScaleChoice::PerPoint) refuse_border("with scale = per point: give radii");
  if (std::find(options.radii.begin(), options.radii.end(), 0.0) != options.radii.end())
    refuse_border("with radius = 0, where there are no balls: give a positive radius");
}

}  // namespace

void validate(const CurvatureOptions& options) {
  check_border(options);
  if (options.refine > 0 && options.quads == QuadMeasures::Bilinear)
    throw Error(ErrorCode::InvalidArgument, "refine = " + std::to_string(options.refine) +
                                                " with bilinear quads: only triangles are refined; let quads be split");
  if (options.scale == ScaleChoice::PerPoint) return;
  if (options.radii.empty()) throw Error(ErrorCode::InvalidArgument, "no radius is given: give at least one");
  check_order(options.order);
  for (const double radius : options.radii) {
    if (!(radius >= 0 && std::isfinite(radius)))
      throw Error(ErrorCode::InvalidArgument,
                  "radius = " + std::to_string(radius) + ": give a finite radius, 0 or more, in units of the data");
    if (radius == 0 && options.order > 1)
      throw Error(ErrorCode::InvalidArgument,
                  "order = " + std::to_string(options.order) +
                      " at radius 0: bias is cancelled between balls; give a positive radius");
  }
}

std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  check_count(u.size(), centres.size(), "centre");
  check_order(options.order);
  if (options.scale != ScaleChoice::Given)
    throw Error(ErrorCode::InvalidArgument,
                "scale = per point: it is chosen for the vertices of a mesh, not for centres");
  if (options.border != BorderEstimate::InBall)
    refuse_border("at other centres than vertices: measure at the vertices");
  return measure_balls(balls, centres, u, options, run, nullptr);
}

std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const std::vector<double>& radii, BallDefinition ball,
                                                const Execution& run) {
  CurvatureOptions options;
  options.radii = radii;
  options.ball = ball;
  return estimate_curvatures(balls, centres, u, options, run);
}

std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  validate(options);
  if (options.scale == ScaleChoice::PerPoint) return {estimate_at_own_scale(balls, u, options.ball, run)};
  const MeasuredTriangles& triangles = balls.triangles();
  check_count(u.size(), triangles.vertices, "vertex");
  if (options.border != BorderEstimate::InBall && is_refined(triangles))
    refuse_border("of refined triangles: measure those of the mesh");
  CurvatureOptions positive = options;
  auto& radii = positive.radii;
  radii.erase(std::remove(radii.begin(), radii.end(), 0.0), radii.end());
  std::vector<CurvatureField> of_balls;
  if (!radii.empty()) {
    const auto end = triangles.x.begin() + static_cast<std::ptrdiff_t>(triangles.vertices);
    of_balls = end == triangles.x.end()
                   ? measure_at_vertices(balls, triangles.x, u, positive, run)
                   : measure_at_vertices(balls, std::vector<Vec3>(triangles.x.begin(), end), u, positive, run);
  }
  std::vector<CurvatureField> fields;
  auto next = of_balls.begin();
  for (const double radius : options.radii)
    fields.push_back(radius > 0 ? std::move(*next++) : estimate_at_vertices(triangles, u, options.vertex_limit, run));
  return fields;
}

CurvatureField estimate_at_vertices(const MeasuredTriangles& triangles, const Normals& u, VertexLimit limit,
                                    const Execution& run) {
  check_count(u.size(), triangles.vertices, "vertex");
  CurvatureField field;
  field.samples.resize(u.size());
  std::vector<BallMeasures> sums(u.size());
  if (limit == VertexLimit::Star) {
    add_stars(triangles, sums);
  } else {
    add_limits(triangles, sums);
  }
  parallel_for(u.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t v = begin; v < end; ++v) {
      const BallMeasures* const star = &sums[v];
      if (usable(triangles.x[v], u[v])) field.samples[v] = make_sample(&star, 1, 0.0, u[v]);
    }
  });
  return field;
}

std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  validate(options);
  const Execution first = stage(run, 0.0, 0.05), second = stage(run, 0.05, 0.1);
  const MeasureTree balls(options.refine > 0 ? measure_refined(mesh, u, options.refine, first)
                                             : triangles_for_tree(mesh, u, options.quads, first),
                          Precision::Double, second);
  return estimate_curvatures(balls, u, options, stage(run, 0.1, 1.0));
}

double typical_radius(const CurvatureField& field) {
  if (!field.own_scales()) return field.radius;
  std::vector<double> radii;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status == PointStatus::Valid) radii.push_back(s.radius);
  }
  return percentile(radii, 50);
}

void mark_borders(CurvatureField& field, double least) {
  if (!(least >= 0 && least <= 1))
    throw Error(ErrorCode::InvalidArgument,
                "least coverage = " + std::to_string(least) + ": give the share of the ball to be filled, 0 to 1");
  if (field.radius == 0)
    throw Error(ErrorCode::InvalidArgument,
                "least coverage: at radius 0 there is no ball to be covered; give a radius");
  for (CurvatureSample& s : field.samples) {
    if (s.k.status != PointStatus::Valid || s.coverage >= least) continue;
    s.k = Curvatures();
    s.k.status = PointStatus::Border;
    s.std_error = kNaN;
  }
}

FieldSummary::Percentiles percentiles(std::vector<double>& values) {
  const std::vector<double> p = percentiles(values, {1, 50, 99});
  return {p[0], p[1], p[2]};
}

FieldSummary summarise(const CurvatureField& field, const Execution& run) {
  FieldSummary summary;
  std::vector<double> mean, gaussian, k_min, k_max;
  for (auto* values : {&mean, &gaussian, &k_min, &k_max}) values->reserve(field.samples.size());
  for (const CurvatureSample& s : field.samples) {
    switch (s.k.status) {
      case PointStatus::Valid:
        ++summary.valid;
        break;
      case PointStatus::Empty:
        ++summary.empty;
        break;
      case PointStatus::Degenerate:
        ++summary.degenerate;
        break;
      case PointStatus::Invalid:
        ++summary.invalid;
        break;
      case PointStatus::Border:
        ++summary.border;
        break;
    }
    if (s.k.status != PointStatus::Valid) continue;
    mean.push_back(s.k.mean);
    gaussian.push_back(s.k.gaussian);
    k_min.push_back(s.k.k_min);
    k_max.push_back(s.k.k_max);
  }
  const std::pair<FieldSummary::Percentiles*, std::vector<double>*> quantities[] = {
      {&summary.mean, &mean}, {&summary.gaussian, &gaussian}, {&summary.k_min, &k_min}, {&summary.k_max, &k_max}};
  parallel_for(std::size(quantities), 1, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) *quantities[i].first = percentiles(*quantities[i].second);
  });
  return summary;
}

}  // namespace kappa
