// SPDX-License-Identifier: BSD-3-Clause
#include "share_by_boundary.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

// The second form of triangle n disc: the boundary of the intersection, as chords on the edges and
// arcs between them, in a frame that lies on the longest edge. Nothing larger than the triangle is
// ever summed, which keeps slivers and triangles small beside the ball exact. Extreme ones are computed in extended
// precision, for the sake of coordinates along the edges, which cancel for large balls.

namespace kappa::detail {
namespace {

/// A sum kept in two doubles, for terms that cancel.
class TwoSum {
 public:
  void add(double value) {
    const double sum = high_ + value, of_value = sum - high_;
    low_ += (high_ - (sum - of_value)) + (value - of_value);
    high_ = sum;
  }
  void add_square(double value, double sign) {
    const double square = value * value;
    add(sign * square);
    add(sign * std::fma(value, value, -square));
  }
  template <class Real>
  Real value() const {
    return static_cast<Real>(high_) + static_cast<Real>(low_);
  }

 private:
  double high_ = 0, low_ = 0;
};

/// |x|^2 - radius^2, to its own last digits: negative inside the ball.
template <class Real>
Real power(const Vec3& x, double radius) {
  TwoSum sum;
  sum.add_square(radius, -1.0);
  for (int axis = 0; axis < 3; ++axis) sum.add_square(x[axis], 1.0);
  return sum.value<Real>();
}

template <class Real>
using V3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using V2 = Eigen::Matrix<Real, 2, 1>;

template <class Real>
Real cross(const V2<Real>& a, const V2<Real>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// alpha - sin(alpha) cos(alpha): area of a circular segment of half-angle alpha, over r^2.
template <class Real>
Real segment_area(Real alpha) {
  if (alpha > Real(0.5)) return alpha - std::sin(alpha) * std::cos(alpha);
  const Real z = -4 * alpha * alpha;
  Real term = -alpha, sum = 0;  // sum over k >= 1 of -(-1)^k (2 alpha)^(2k+1) / (2 (2k+1)!)
  for (int k = 1; k < 14; ++k) {
    term *= z / Real(2 * k * (2 * k + 1));
    const Real before = sum;
    sum += term;
    if (sum == before) break;
  }
  return sum;
}

/// 2/3 sin^3(alpha) - cos(alpha) segment_area(alpha): first moment of the segment about its chord, over r^3.
template <class Real>
Real segment_moment(Real alpha) {
  if (alpha > Real(0.5)) {
    const Real s = std::sin(alpha);
    return Real(2) / 3 * s * s * s - std::cos(alpha) * segment_area(alpha);
  }
  Real term = alpha, power_of_9 = 1, sum = 0;  // term: (-1)^k alpha^(2k+1) / (2k+1)!
  for (int k = 1; k < 14; ++k) {
    term *= -alpha * alpha / Real(2 * k * (2 * k + 1));
    power_of_9 *= 9;
    if (k == 1) continue;
    const Real before = sum;
    sum += term * (Real(0.75) + power_of_9 / 4 - Real(2 * k + 1));
    if (sum == before) break;
  }
  return sum;
}

/// One edge in the frame, with the interval of it that lies in the disc.
template <class Real>
struct Edge {
  V2<Real> from, along;  // along: unit
  Real length = 0;
  Real begin = 0, end = 0;
  Real inside = 0;  // signed distance of the disc's centre, positive on the triangle's side
  bool cut() const { return begin < end; }
  bool starts_cut() const { return begin > 0; }
  bool ends_cut() const { return end < length; }
  Real cut_length() const { return end - begin; }
  V2<Real> at(Real t) const { return from + t * along; }
};

/// The triangle in the frame: first corner at 0, longest edge along x, third corner at y > 0.
template <class Real>
struct Frame {
  std::array<V3<Real>, 3> x;
  std::array<Real, 3> power;
  std::array<V2<Real>, 3> p;
  std::size_t first = 0;  // corner of the input at the origin of the frame
  V2<Real> centre;        // of the disc
  Real r = 0;             // of the disc; 0 if there is none
  std::array<Edge<Real>, 3> edges;
};

template <class Real>
Frame<Real> make_frame(const std::array<Vec3, 3>& corners, double radius) {
  Frame<Real> f;
  for (std::size_t i = 1; i < 3; ++i) {
    const auto length_sq = [&](std::size_t k) { return (corners[(k + 1) % 3] - corners[k]).squaredNorm(); };
    if (length_sq(i) > length_sq(f.first)) f.first = i;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = corners[(f.first + i) % 3];
    f.x[i] = corner.template cast<Real>();
    f.power[i] = power<Real>(corner, radius);
  }
  return f;
}

template <class Real>
void place_disc(Frame<Real>& f) {
  const V3<Real> edge = f.x[1] - f.x[0], side = f.x[2] - f.x[0];
  const Real length = edge.norm();
  const V3<Real> e = edge / length;
  const V3<Real> across = side - side.dot(e) * e;
  const Real height = across.norm();
  f.p = {V2<Real>(0, 0), V2<Real>(length, 0), V2<Real>(side.dot(e), height)};
  f.centre = V2<Real>(-f.x[0].dot(e), -f.x[0].dot(across) / height);
  // The power of the first corner, at the origin of the frame, is the same in the disc as in the ball. An uncertain
  // plane (a sliver) thus changes centre and radius consistently.
  const Real r_sq = f.centre.squaredNorm() - f.power[0];
  f.r = r_sq > 0 ? std::sqrt(r_sq) : Real(0);
}

template <class Real>
void cut_edges(Frame<Real>& f) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    Edge<Real>& edge = f.edges[i];
    const V3<Real> along = f.x[j] - f.x[i];
    edge.from = f.p[i];
    edge.length = along.norm();
    edge.along = (f.p[j] - f.p[i]) / edge.length;
    edge.inside = cross<Real>(edge.along, f.centre - edge.from);
    const V3<Real> e = along / edge.length;
    // From the end nearer to the foot of the centre, where the least cancels.
    const Real foot_from_i = -f.x[i].dot(e), foot_from_j = -f.x[j].dot(e);
    const bool nearer_i = std::abs(foot_from_i) < std::abs(foot_from_j);
    const Real foot = nearer_i ? foot_from_i : foot_from_j;
    const Real w_sq = foot * foot - (nearer_i ? f.power[i] : f.power[j]);
    if (w_sq <= 0) continue;
    const Real w = std::sqrt(w_sq), shift = nearer_i ? Real(0) : edge.length;
    edge.begin = std::max(Real(0), shift + (foot - w));
    edge.end = std::min(edge.length, shift + (foot + w));
  }
}

/// Area and first moment in the frame.
template <class Real>
struct Sum {
  Real area = 0;
  V2<Real> moment = V2<Real>::Zero();
};

template <class Real>
void add_side(const V2<Real>& a, const V2<Real>& b, Sum<Real>& sum) {
  const Real c = cross<Real>(a, b);
  sum.area += c / 2;
  sum.moment += c / 6 * (a + b);
}

/// Distance from the centre to the chord, negative if the arc from the end of edge `i` to the begin of edge `j` is
/// more than half of the circle.
template <class Real>
Real apothem(const Frame<Real>& f, std::size_t i, std::size_t j, const V2<Real>& chord) {
  const Real size = std::sqrt(std::max(Real(0), f.r * f.r - chord.squaredNorm() / 4));
  // Around a corner outside the disc the arc is what the corner sees of the circle.
  if (j == (i + 1) % 3) return size;
  // A chord too short to have a side: across a thin triangle, or where an edge or a corner just touches the circle.
  // Only in the latter case, with the centre inside of all edges, is almost all of the disc beyond it.
  constexpr Real kShortChord = Real(1e-5), kShortCut = Real(0.1);
  if (chord.norm() < kShortChord * f.r) {
    const bool touching = f.edges[i].cut_length() + f.edges[j].cut_length() < kShortCut * f.r;
    const bool inside = f.edges[0].inside > 0 && f.edges[1].inside > 0 && f.edges[2].inside > 0;
    return touching && inside ? -size : size;
  }
  if (i == j) return -f.edges[i].inside;
  return cross<Real>(chord, f.centre - f.edges[i].at(f.edges[i].end)) >= 0 ? size : -size;
}

/// What lies between the chord and the arc from the end of edge `i` to the begin of edge `j`.
template <class Real>
void add_segment(const Frame<Real>& f, std::size_t i, std::size_t j, Sum<Real>& sum) {
  const V2<Real> from = f.edges[i].at(f.edges[i].end), to = f.edges[j].at(f.edges[j].begin);
  const V2<Real> chord = to - from;
  const Real length = chord.norm();
  if (!(length > 0)) return;
  const Real alpha = std::atan2(length / 2, apothem(f, i, j, chord));
  const V2<Real> outward(chord.y() / length, -chord.x() / length);
  const Real area = f.r * f.r * segment_area(alpha);
  sum.area += area;
  sum.moment += area * (from + to) / 2 + f.r * f.r * f.r * segment_moment(alpha) * outward;
}

template <class Real>
Sum<Real> boundary_sum(const Frame<Real>& f) {
  Sum<Real> sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge<Real>& edge = f.edges[i];
    if (!edge.cut()) continue;
    add_side<Real>(edge.at(edge.begin), edge.at(edge.end), sum);
    std::size_t j = (i + 1) % 3;
    while (!f.edges[j].cut()) j = (j + 1) % 3;
    add_side<Real>(edge.at(edge.end), f.edges[j].at(f.edges[j].begin), sum);
    // Only where two edges meet in a corner inside the disc is there no arc between them.
    const bool corner_inside = j == (i + 1) % 3 && !edge.ends_cut() && !f.edges[j].starts_cut();
    if (!corner_inside) add_segment(f, i, j, sum);
  }
  return sum;
}

template <class Real>
Sum<Real> whole_disc(const Frame<Real>& f) {
  for (const Edge<Real>& edge : f.edges) {
    if (edge.inside < 0) return {};
  }
  const Real area = Real(kPi) * f.r * f.r;
  return {area, area * f.centre};
}

template <class Real>
TriangleShare to_share(const Frame<Real>& f, const Sum<Real>& sum) {
  if (!(sum.area > 0)) return {};
  const Real length = f.p[1].x(), height = f.p[2].y();
  const V2<Real> centroid = sum.moment / sum.area;
  const Real c = std::clamp<Real>(centroid.y() / height, 0, 1);
  const Real b = std::clamp<Real>((centroid.x() - c * f.p[2].x()) / length, 0, 1 - c);
  std::array<Real, 3> weights;
  weights[f.first] = 1 - b - c;
  weights[(f.first + 1) % 3] = b;
  weights[(f.first + 2) % 3] = c;
  const Real share = std::min<Real>(1, 2 * sum.area / (length * height));
  return {static_cast<double>(share), static_cast<double>(weights[1]), static_cast<double>(weights[2]), true};
}

template <class Real>
TriangleShare boundary_share(const std::array<Vec3, 3>& x, double radius) {
  Frame<Real> f = make_frame<Real>(x, radius);
  place_disc(f);
  if (f.r <= 0) return {};
  cut_edges(f);
  const bool any_cut = f.edges[0].cut() || f.edges[1].cut() || f.edges[2].cut();
  return to_share(f, any_cut ? boundary_sum(f) : whole_disc(f));
}

}  // namespace

TriangleShare share_by_boundary(const std::array<Vec3, 3>& x, double radius) {
  return boundary_share<double>(x, radius);
}

TriangleShare share_by_long_boundary(const std::array<Vec3, 3>& x, double radius) {
  return boundary_share<long double>(x, radius);
}

}  // namespace kappa::detail
