// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/in_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "ball_fields.hpp"
#include "curvature_sample.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/orders.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

/// Adds triangle `t` as a vertex sees it in the limit of vanishing balls: its density at the vertex, by its angle.
void add_limit(const BallSum& balls, std::size_t t, std::size_t corner, BallMeasures& to) {
  const Triangles& triangles = balls.triangles();
  const auto& c = triangles.corners[t];
  const Vec3& x = triangles.x[c[corner]];
  const Vec3 a = triangles.x[c[(corner + 1) % 3]] - x, b = triangles.x[c[(corner + 2) % 3]] - x;
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  MeasureSum m = balls.measures_of(t);
  ++to.face_count;
  if (!(m.area > 0)) return;
  m *= triangles.weight(t) * angle / m.area;
  to.sum += m;
}

/// Every vertex below `vertices` gets the whole faces around it, a polygon with all of its parts.
void add_stars(const BallSum& balls, std::vector<BallMeasures>& sums, const Execution& run) {
  const Triangles& triangles = balls.triangles();
  const auto add_to = [&](Index v, const MeasureSum& sum, Index parts) {
    sums[v].sum += sum;
    sums[v].face_count += parts;
  };
  const std::vector<Index> parts = parts_of_faces(triangles);
  const bool split = std::any_of(parts.begin(), parts.end(), [](Index n) { return n > 1; });
  std::vector<MeasureSum> faces(split ? parts.size() : 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t % kBlock == 0) check_cancelled(run);
    const Index face = triangles.faces[t];
    const MeasureSum m = balls.measures_of(t);
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

void add_limits(const BallSum& balls, std::vector<BallMeasures>& sums, const Execution& run) {
  const Triangles& triangles = balls.triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t % kBlock == 0) check_cancelled(run);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Index v = triangles.corners[t][corner];
      if (v < sums.size()) add_limit(balls, t, corner, sums[v]);
    }
  }
}

/// The radii of the balls of an order around each centre, the widest first.
std::vector<double> radii_of_orders(const std::vector<double>& radii, int order) {
  std::vector<double> all;
  all.reserve(radii.size() * static_cast<std::size_t>(order));
  for (const double radius : radii) {
    for (const double r : order_radii(radius, order)) all.push_back(r);
  }
  return all;
}

}  // namespace

const std::vector<Named<VertexLimit>>& names_of(VertexLimit) {
  static const std::vector<Named<VertexLimit>> names = {{VertexLimit::Star, "star", "the whole faces around a vertex"},
                                                        {VertexLimit::Limit, "limit", "the limit of vanishing balls"}};
  return names;
}

std::vector<CurvatureField> curvatures_in_balls(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const BallPlan& plan, const Execution& run) {
  return ball_fields(balls, centres, u, plan, {}, run);
}

std::vector<CurvatureSample> curvatures_in_own_balls(const BallSum& balls, const std::vector<Vec3>& centres,
                                                     const Normals& u, const std::vector<double>& radii, int order,
                                                     BallDefinition ball, const Execution& run) {
  check_one_each(u.size(), "normal", centres.size(), "centre");
  check_one_each(radii.size(), "radius", centres.size(), "centre");
  check_order(order);
  std::vector<CurvatureSample> samples(centres.size());
  const BallRadii own = BallRadii::of_each(radii_of_orders(radii, order), static_cast<std::size_t>(order));
  balls.sum(centres, own, ball, run, [&](std::size_t q, const BallMeasures* measures) {
    if (!usable(centres[q], u[q])) return;
    std::array<const BallMeasures*, kMaxOrder> of_order{};
    for (std::size_t b = 0; b < of_order.size(); ++b) of_order[b] = measures + (b < own.count() ? b : 0);
    if (radii[q] > 0) {
      samples[q] = make_sample(of_order.data(), order, radii[q], u[q]);
    } else {
      samples[q].k.status = PointStatus::Empty;
    }
  });
  return samples;
}

CurvatureField curvatures_at_vertices(const BallSum& balls, const Normals& u, VertexLimit limit, const Execution& run) {
  const Triangles& triangles = balls.triangles();
  check_one_each(u.size(), "normal", triangles.vertices, "vertex");
  CurvatureField field;
  field.samples.resize(u.size());
  std::vector<BallMeasures> sums(u.size());
  if (limit == VertexLimit::Star) {
    add_stars(balls, sums, run);
  } else {
    add_limits(balls, sums, run);
  }
  parallel_for(u.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t v = begin; v < end; ++v) {
      const BallMeasures* const star = &sums[v];
      if (usable(triangles.x[v], u[v])) field.samples[v] = make_sample(&star, 1, 0.0, u[v]);
    }
  });
  return field;
}

std::vector<Vec3> vertices_of(const Triangles& triangles) {
  return {triangles.x.begin(), triangles.x.begin() + static_cast<std::ptrdiff_t>(triangles.vertices)};
}

}  // namespace kappa
