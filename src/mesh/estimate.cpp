// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/estimate.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/error.hpp"
#include "kappa/mesh/measure_tree.hpp"
#include "kappa/mesh/statistics.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

bool usable(const Vec3& x, const Vec3& u) {
  return is_finite(x) && is_finite(u) && !u.isZero(0);
}

/// The sample of a point, from the measures of its ball; `disc_area` = pi radius^2, 0 at radius 0.
CurvatureSample make_sample(const BallMeasures& ball, const Vec3& u, double disc_area) {
  CurvatureSample s;
  s.face_count = ball.face_count;
  s.area = ball.sum.area;
  s.mu0 = ball.sum.mu0;
  s.mu1 = ball.sum.mu1();
  s.mu2 = ball.sum.mu2;
  if (disc_area > 0) s.coverage = s.area / disc_area;
  if (ball.face_count == 0) {
    s.k.status = PointStatus::Empty;
  } else {
    s.k = curvatures(ball.sum, u);
  }
  return s;
}

/// Adds triangle `t` as a vertex sees it in the limit of vanishing balls: its density at the vertex, by its angle.
void add_limit(const MeasuredTriangles& triangles, std::size_t t, std::size_t corner, BallMeasures& to) {
  const auto& c = triangles.corners[t];
  const Vec3& x = triangles.x[c[corner]];
  const Vec3 a = triangles.x[c[(corner + 1) % 3]] - x, b = triangles.x[c[(corner + 2) % 3]] - x;
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  MeasureSum m = triangles.measures[t];
  ++to.face_count;
  if (!(m.area > 0)) return;
  m *= triangles.weights[t] * angle / m.area;
  to.sum += m;
}

/// Every vertex below `vertices` gets the whole faces around it, a polygon with all of its parts.
void add_stars(const MeasuredTriangles& triangles, std::vector<BallMeasures>& sums) {
  for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    BallMeasures face;
    for (end = begin; end < triangles.size() && triangles.faces[end] == triangles.faces[begin]; ++end) {
      face.sum += triangles.measures[end];
      ++face.face_count;
    }
    // The first two corners of each part run round the polygon; of a triangle it is all three.
    const auto add_to = [&](Index v) {
      sums[v].sum += face.sum;
      sums[v].face_count += face.face_count;
    };
    for (std::size_t t = begin; t < end; ++t) add_to(triangles.corners[t][0]);
    if (end - begin > 1) continue;
    add_to(triangles.corners[begin][1]);
    add_to(triangles.corners[begin][2]);
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

FieldSummary::Percentiles percentiles(std::vector<double>& values) {
  return {percentile(values, 1), percentile(values, 50), percentile(values, 99)};
}

}  // namespace

void validate(const CurvatureOptions& options) {
  if (options.radii.empty()) throw Error(ErrorCode::InvalidArgument, "no radius is given: give at least one");
  for (const double radius : options.radii) {
    if (!(radius >= 0 && std::isfinite(radius)))
      throw Error(ErrorCode::InvalidArgument,
                  "radius = " + std::to_string(radius) + ": give a finite radius, 0 or more, in units of the data");
  }
}

std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const std::vector<double>& radii, BallDefinition ball,
                                                const Execution& run) {
  if (u.size() != centres.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(u.size()) + " normals for " +
                                                std::to_string(centres.size()) + " centres: give one a centre");
  std::vector<CurvatureField> fields(radii.size());
  for (std::size_t r = 0; r < radii.size(); ++r) {
    fields[r].radius = radii[r];
    fields[r].samples.resize(centres.size());
  }
  balls.sum(centres, radii, ball, run, [&](std::size_t q, const BallMeasures* measures) {
    if (!usable(centres[q], u[q])) return;
    for (std::size_t r = 0; r < radii.size(); ++r)
      fields[r].samples[q] = make_sample(measures[r], u[q], kPi * radii[r] * radii[r]);
  });
  return fields;
}

CurvatureField estimate_at_vertices(const MeasuredTriangles& triangles, const Normals& u, VertexLimit limit,
                                    const Execution& run) {
  if (u.size() != triangles.vertices)
    throw Error(ErrorCode::InvalidArgument, std::to_string(u.size()) + " normals for " +
                                                std::to_string(triangles.vertices) + " vertices: give one a vertex");
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
      if (usable(triangles.x[v], u[v])) field.samples[v] = make_sample(sums[v], u[v], 0.0);
    }
  });
  return field;
}

std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run) {
  validate(options);
  const MeasureTree balls(measure_triangles(mesh, u, options.quads, stage(run, 0.0, 0.1)));
  std::vector<double> radii;
  std::copy_if(options.radii.begin(), options.radii.end(), std::back_inserter(radii), [](double r) { return r > 0; });
  std::vector<CurvatureField> of_balls =
      estimate_curvatures(balls, mesh.vertices, u, radii, options.ball, stage(run, 0.1, 1.0));
  std::vector<CurvatureField> fields;
  auto next = of_balls.begin();
  for (const double radius : options.radii) {
    fields.push_back(radius > 0 ? std::move(*next++)
                                : estimate_at_vertices(balls.triangles(), u, options.vertex_limit));
  }
  return fields;
}

FieldSummary summarise(const CurvatureField& field) {
  FieldSummary summary;
  std::vector<double> mean, gaussian, k_min, k_max;
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
    }
    if (s.k.status != PointStatus::Valid) continue;
    mean.push_back(s.k.mean);
    gaussian.push_back(s.k.gaussian);
    k_min.push_back(s.k.k_min);
    k_max.push_back(s.k.k_max);
  }
  summary.mean = percentiles(mean);
  summary.gaussian = percentiles(gaussian);
  summary.k_min = percentiles(k_min);
  summary.k_max = percentiles(k_max);
  return summary;
}

}  // namespace kappa
