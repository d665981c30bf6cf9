// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/triangle_ball.hpp"

// The second form of triangle n disc: the boundary of the intersection, as chords on the edges and
// arcs between them, in a frame that lies on the longest edge. Nothing larger than the triangle is
// ever summed, which keeps slivers and triangles small beside the ball exact. The extended
// precision serves the squares of distances from the centre, which cancel for large balls.

namespace kappa::detail {
namespace {

using Real = long double;
using V3 = Eigen::Matrix<Real, 3, 1>;
using V2 = Eigen::Matrix<Real, 2, 1>;

Real cross(const V2& a, const V2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// alpha - sin(alpha) cos(alpha): area of a circular segment of half-angle alpha, over r^2.
Real segment_area(Real alpha) {
  if (alpha > Real(0.5)) return alpha - std::sin(alpha) * std::cos(alpha);
  const Real z = -4 * alpha * alpha;
  Real term = -alpha, sum = 0;  // sum over k >= 1 of -(-1)^k (2 alpha)^(2k+1) / (2 (2k+1)!)
  for (int k = 1; k < 14; ++k) {
    term *= z / (2 * k * (2 * k + 1));
    sum += term;
  }
  return sum;
}

/// 2/3 sin^3(alpha) - cos(alpha) segment_area(alpha): first moment of the segment about its chord, over r^3.
Real segment_moment(Real alpha) {
  if (alpha > Real(0.5)) {
    const Real s = std::sin(alpha);
    return Real(2) / 3 * s * s * s - std::cos(alpha) * segment_area(alpha);
  }
  Real term = alpha, power = 1, sum = 0;  // term: (-1)^k alpha^(2k+1) / (2k+1)!, power: 9^k
  for (int k = 1; k < 14; ++k) {
    term *= -alpha * alpha / (2 * k * (2 * k + 1));
    power *= 9;
    if (k > 1) sum += term * (Real(0.75) + power / 4 - (2 * k + 1));
  }
  return sum;
}

/// One edge in the frame, with the interval of it that lies in the disc.
struct Edge {
  V2 from, along;     // along: unit
  Real length = 0;
  Real begin = 0, end = 0;
  Real inside = 0;    // signed distance of the disc's centre, positive on the triangle's side
  bool cut() const { return begin < end; }
  bool starts_cut() const { return begin > 0; }
  bool ends_cut() const { return end < length; }
  V2 at(Real t) const { return from + t * along; }
};

/// The triangle in the frame: first corner at 0, longest edge along x, third corner at y > 0.
struct Frame {
  std::array<V3, 3> x;
  std::array<V2, 3> p;
  std::size_t first = 0;  // corner of the input at the origin of the frame
  V2 centre;              // of the disc
  Real r = 0;             // of the disc; 0 if there is none
  std::array<Edge, 3> edges;
};

Frame make_frame(const std::array<Vec3, 3>& corners) {
  Frame f;
  for (std::size_t i = 1; i < 3; ++i) {
    const auto length_sq = [&](std::size_t k) { return (corners[(k + 1) % 3] - corners[k]).squaredNorm(); };
    if (length_sq(i) > length_sq(f.first)) f.first = i;
  }
  for (std::size_t i = 0; i < 3; ++i) f.x[i] = corners[(f.first + i) % 3].cast<Real>();
  return f;
}

void place_disc(Frame& f, Real radius) {
  const V3 edge = f.x[1] - f.x[0], side = f.x[2] - f.x[0];
  const Real length = edge.norm();
  const V3 e = edge / length;
  const V3 across = side - side.dot(e) * e;
  const Real height = across.norm();
  f.p = {V2(0, 0), V2(length, 0), V2(side.dot(e), height)};
  const Real cx = -f.x[0].dot(e);
  const V3 from_line = -f.x[0] - cx * e;
  const Real cy = from_line.dot(across) / height;
  f.centre = V2(cx, cy);
  // Written so that an uncertain plane (a sliver) changes centre and radius consistently.
  const Real r_sq = radius * radius - from_line.squaredNorm() + cy * cy;
  f.r = r_sq > 0 ? std::sqrt(r_sq) : Real(0);
}

void cut_edges(Frame& f, Real radius) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    Edge& edge = f.edges[i];
    const V3 along = f.x[j] - f.x[i];
    edge.from = f.p[i];
    edge.length = along.norm();
    edge.along = (f.p[j] - f.p[i]) / edge.length;
    edge.inside = cross(edge.along, f.centre - edge.from);
    const V3 e = along / edge.length;
    const Real foot = -f.x[i].dot(e);
    const Real w_sq = radius * radius - (f.x[i] + foot * e).squaredNorm();
    if (w_sq <= 0) continue;
    const Real w = std::sqrt(w_sq);
    edge.begin = std::max(Real(0), foot - w);
    edge.end = std::min(edge.length, foot + w);
  }
}

/// Area and first moment in the frame.
struct Sum {
  Real area = 0;
  V2 moment = V2::Zero();
};

void add_side(const V2& a, const V2& b, Sum& sum) {
  const Real c = cross(a, b);
  sum.area += c / 2;
  sum.moment += c / 6 * (a + b);
}

/// Half-angle of the arc from the end of edge `i` to the begin of edge `j`.
Real arc_half_angle(const Frame& f, std::size_t i, std::size_t j, const V2& chord) {
  constexpr Real kShortChord = 1e-9L;
  const Real half = chord.norm() / 2;
  if (i == j) return std::atan2(half, -f.edges[i].inside);
  const Real apothem = std::sqrt(std::max(Real(0), f.r * f.r - half * half));
  // Around a corner outside the disc the arc is what the corner sees of the circle, less than half. A very
  // short chord across the third edge cannot leave almost the whole disc inside a corner.
  const bool minor = j == (i + 1) % 3 || half < kShortChord * f.r ||
                     cross(chord, f.centre - f.edges[i].at(f.edges[i].end)) >= 0;
  return std::atan2(half, minor ? apothem : -apothem);
}

/// What lies between the chord and the arc from the end of edge `i` to the begin of edge `j`.
void add_segment(const Frame& f, std::size_t i, std::size_t j, Sum& sum) {
  const V2 from = f.edges[i].at(f.edges[i].end), to = f.edges[j].at(f.edges[j].begin);
  const V2 chord = to - from;
  const Real alpha = arc_half_angle(f, i, j, chord);
  const V2 along = i == j ? V2(-f.edges[i].along) : V2(chord / std::max(chord.norm(), Real(1e-300L)));
  const V2 outward(along.y(), -along.x());
  const Real area = f.r * f.r * segment_area(alpha);
  sum.area += area;
  sum.moment += area * (from + to) / 2 + f.r * f.r * f.r * segment_moment(alpha) * outward;
}

Sum boundary_sum(const Frame& f) {
  Sum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge& edge = f.edges[i];
    if (!edge.cut()) continue;
    add_side(edge.at(edge.begin), edge.at(edge.end), sum);
    std::size_t j = (i + 1) % 3;
    while (!f.edges[j].cut()) j = (j + 1) % 3;
    add_side(edge.at(edge.end), f.edges[j].at(f.edges[j].begin), sum);
    if (edge.ends_cut() && f.edges[j].starts_cut()) add_segment(f, i, j, sum);
  }
  return sum;
}

Sum whole_disc(const Frame& f) {
  for (const Edge& edge : f.edges) {
    if (edge.inside < 0) return {};
  }
  const Real area = Real(kPi) * f.r * f.r;
  return {area, area * f.centre};
}

}  // namespace

TriangleShare share_by_boundary(const std::array<Vec3, 3>& x, double radius) {
  Frame f = make_frame(x);
  place_disc(f, radius);
  if (f.r <= 0) return {};
  cut_edges(f, radius);
  const bool any_cut = f.edges[0].cut() || f.edges[1].cut() || f.edges[2].cut();
  const Sum sum = any_cut ? boundary_sum(f) : whole_disc(f);
  if (!(sum.area > 0)) return {};

  const Real length = f.p[1].x(), height = f.p[2].y();
  const V2 centroid = sum.moment / sum.area;
  const Real c = std::clamp(centroid.y() / height, Real(0), Real(1));
  const Real b = std::clamp((centroid.x() - c * f.p[2].x()) / length, Real(0), 1 - c);
  std::array<Real, 3> weights;
  weights[f.first] = 1 - b - c;
  weights[(f.first + 1) % 3] = b;
  weights[(f.first + 2) % 3] = c;
  const Real share = std::min(Real(1), 2 * sum.area / (length * height));
  return {static_cast<double>(share), static_cast<double>(weights[1]), static_cast<double>(weights[2]), true};
}

}  // namespace kappa::detail
