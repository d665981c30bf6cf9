// SPDX-License-Identifier: BSD-3-Clause
#include "edge_curve.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace kappa {
namespace {

/// Least share of an edge in the tangent planes of its ends, and most that the normal may turn along it at the rate of
/// an end: past them there is no surface between the ends that they would describe.
constexpr double kLeastProjection = 0.5, kMostTurn = 2;
/// Correction by the tangent of the curve, in parts of that by the curvature, at which half of it is believed.
constexpr double kBelieved = 0.2;

/// One end of a curve over [0, 1], as seen along the edge.
struct End {
  Vec3 tangent, turn, bend;  ///< first derivatives of position and normal, second one of position
  bool sound = false;
};

End end_of(const CurvePoint& p, const Vec3& e) {
  End end;
  const double length_sq = e.squaredNorm();
  const Vec3 along = e - e.dot(p.u) * p.u;
  const double along_sq = along.squaredNorm();
  if (!(along_sq > kLeastProjection * kLeastProjection * length_sq)) return end;
  const double k = along.dot(p.shape * along) / along_sq;
  // The length of the arc of curvature k over the edge, to fourth order.
  end.tangent = std::sqrt(length_sq / along_sq) * (1 + k * k * length_sq / 24) * along;
  end.turn = p.shape * end.tangent;
  end.bend = -end.tangent.dot(end.turn) * p.u;
  end.sound = end.turn.squaredNorm() <= kMostTurn * kMostTurn;
  return end;
}

void normalise(Vec3& u) {
  const double length = u.norm();
  if (length > 0) u /= length;
}

/// What counts at a place t of a Hermite interpolation over [0, 1]: values, first and second derivatives of both ends.
struct Weights {
  double value0, value1, first0, first1, second0, second1;
};

/// Those of the quintic and the cubic at t, and of their derivatives.
struct Place {
  double t;
  Weights x, tangent, u, turn;
};

constexpr Place place(double t) {
  const double s = 1 - t, ts = t * s, sq = ts * ts;
  return {t,
          {s * s * s * (1 + 3 * t + 6 * t * t), t * t * t * (1 + 3 * s + 6 * s * s), ts * s * s * (1 + 3 * t),
           -ts * t * t * (1 + 3 * s), 0.5 * sq * s, 0.5 * sq * t},
          {-30 * sq, 30 * sq, s * s * (1 + 2 * t - 15 * t * t), t * t * (1 + 2 * s - 15 * s * s),
           0.5 * ts * s * (2 - 5 * t), -0.5 * ts * t * (2 - 5 * s)},
          {s * s * (1 + 2 * t), t * t * (1 + 2 * s), ts * s, -ts * t, 0, 0},
          {-6 * ts, 6 * ts, s * (1 - 3 * t), t * (1 - 3 * s), 0, 0}};
}

constexpr Place kMiddle = place(0.5);

/// In pairs, so that the ends may change places.
Vec3 values(const Weights& w, const Vec3& at0, const Vec3& at1) {
  return w.value0 * at0 + w.value1 * at1;
}
Vec3 firsts(const Weights& w, const Vec3& at0, const Vec3& at1) {
  return w.first0 * at0 + w.first1 * at1;
}
Vec3 seconds(const Weights& w, const Vec3& at0, const Vec3& at1) {
  return w.second0 * at0 + w.second1 * at1;
}

Mat3 mean_shape(const CurvePoint& a, const CurvePoint& b, double t, const Vec3& u) {
  const Mat3 plane = Mat3::Identity() - u * u.transpose();
  return plane * ((1 - t) * a.shape + t * b.shape) * plane;
}

CurvePoint straight_point(const CurvePoint& a, const CurvePoint& b, double t) {
  CurvePoint m;
  m.x = (1 - t) * a.x + t * b.x;
  m.u = (1 - t) * a.u + t * b.u;
  normalise(m.u);
  m.shape = mean_shape(a, b, t, m.u);
  return m;
}

/// PN triangles: a cubic with the tangents of the ends, and the normals' mean mirrored by the edge.
CurvePoint cubic_point(const CurvePoint& a, const CurvePoint& b, double t, const Vec3& e) {
  CurvePoint m;
  const double both = t * (1 - t), length_sq = e.squaredNorm();
  m.x = ((1 - t) * a.x + t * b.x) - both * ((1 - t) * e.dot(a.u) * a.u - t * e.dot(b.u) * b.u);
  m.u = (1 - t) * a.u + t * b.u;
  if (length_sq > 0) m.u -= (4 * both * e.dot(a.u + b.u) / length_sq) * e;
  normalise(m.u);
  return m;
}

/// Takes from the unit vector `u` its part along `tangent`, less of it the larger it is beside `expected`.
void make_orthogonal(Vec3& u, const Vec3& tangent, double expected) {
  const double length_sq = tangent.squaredNorm();
  const double along = tangent.dot(u), along_sq = along * along / length_sq;
  const double believed_sq = kBelieved * kBelieved * expected * expected;
  if (!(along_sq > 0) || !(believed_sq > 0)) return;
  u -= (along / length_sq / (1 + along_sq / believed_sq)) * tangent;
  normalise(u);
}

/// Makes the curvature of `shape` along `tangent` that of the curve, whose normal has the derivative `turn`.
void correct_along(Mat3& shape, const Vec3& u, const Vec3& tangent, const Vec3& turn) {
  const Vec3 along = tangent - tangent.dot(u) * u;
  const double length_sq = along.squaredNorm();
  if (!(length_sq > 0)) return;
  shape += (along.dot(turn - shape * along) / (length_sq * length_sq)) * along * along.transpose();
}

/// The curve over the edge from `a` to `b` at a place.
CurvePoint curved_point(const CurvePoint& a, const CurvePoint& b, const Place& at) {
  const Vec3 e = b.x - a.x;
  if (!a.shape.allFinite() || !b.shape.allFinite()) return cubic_point(a, b, at.t, e);
  const End from = end_of(a, e), to = end_of(b, e);
  if (!from.sound || !to.sound) return straight_point(a, b, at.t);
  CurvePoint m;
  m.x = values(at.x, a.x, b.x) + firsts(at.x, from.tangent, to.tangent) + seconds(at.x, from.bend, to.bend);
  const Vec3 tangent =
      at.tangent.value1 * e + firsts(at.tangent, from.tangent, to.tangent) + seconds(at.tangent, from.bend, to.bend);
  const Vec3 bulge = firsts(at.u, from.turn, to.turn);
  m.u = values(at.u, a.u, b.u) + bulge;
  normalise(m.u);
  make_orthogonal(m.u, tangent, bulge.norm());
  m.shape = mean_shape(a, b, at.t, m.u);
  correct_along(m.shape, m.u, tangent, at.turn.value1 * (b.u - a.u) + firsts(at.turn, from.turn, to.turn));
  return m;
}

using Join = CurvePoint (*)(const CurvePoint&, const CurvePoint&, const Place&);

/// Middles may lie as near to each other as they are off: how the normal turns from one to the other tells no
/// curvature, and the way between them says nothing about the normal.
CurvePoint between_middles(const CurvePoint& a, const CurvePoint& b, const Place& at) {
  CurvePoint m = curved_point(a, b, at);
  if (!m.shape.allFinite()) m.u = straight_point(a, b, at.t).u;
  m.shape = mean_shape(a, b, at.t, m.u);
  return m;
}

CurvePoint centre_of(std::vector<CurvePoint> corners, Join join);

/// Of an odd number, the mean of the points that lie a share of the way from the middle of the others to a corner; of
/// many, to three of them, since the number of middles of middles would explode.
CurvePoint odd_centre(const std::vector<CurvePoint>& corners, Join join) {
  constexpr std::size_t kMany = 10;
  const std::size_t count = corners.size(), step = count < kMany ? 1 : (count + 2) / 3;
  const double terms = count < kMany ? static_cast<double>(count) : 3;
  const Place at = place(1 / static_cast<double>(count));
  CurvePoint mean = {Vec3::Zero(), Vec3::Zero(), Mat3::Zero()};
  for (std::size_t i = 0; i < count; i += step) {
    std::vector<CurvePoint> others;
    for (std::size_t j = 1; j < count; ++j) others.push_back(corners[(i + j) % count]);
    const CurvePoint m = join(centre_of(std::move(others), join), corners[i], at);
    mean.x += m.x / terms;
    mean.u += m.u;
    mean.shape += m.shape / terms;
  }
  normalise(mean.u);
  const Mat3 plane = Mat3::Identity() - mean.u * mean.u.transpose();
  mean.shape = plane * mean.shape * plane;
  return mean;
}

CurvePoint centre_of(std::vector<CurvePoint> corners, Join join) {
  for (; corners.size() % 2 == 0; join = between_middles) {
    const std::size_t half = corners.size() / 2;
    for (std::size_t i = 0; i < half; ++i) corners[i] = join(corners[i], corners[half + i], kMiddle);
    corners.resize(half);
  }
  return corners.size() == 1 ? corners.front() : odd_centre(corners, join);
}

}  // namespace

CurvePoint curved_midpoint(const CurvePoint& a, const CurvePoint& b) {
  return curved_point(a, b, kMiddle);
}

CurvePoint curved_centre(std::vector<CurvePoint> corners) {
  return centre_of(std::move(corners), curved_point);
}

}  // namespace kappa
