// SPDX-License-Identifier: BSD-3-Clause
#include "edge_curve.hpp"

#include <cmath>

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

Mat3 mean_shape(const CurvePoint& a, const CurvePoint& b, const Vec3& u) {
  const Mat3 plane = Mat3::Identity() - u * u.transpose();
  return 0.5 * (plane * (a.shape + b.shape) * plane);
}

CurvePoint straight_midpoint(const CurvePoint& a, const CurvePoint& b) {
  CurvePoint m;
  m.x = 0.5 * (a.x + b.x);
  m.u = a.u + b.u;
  normalise(m.u);
  m.shape = mean_shape(a, b, m.u);
  return m;
}

/// PN triangles: a cubic with the tangents of the ends, and the normals' mean mirrored by the edge.
CurvePoint cubic_midpoint(const CurvePoint& a, const CurvePoint& b, const Vec3& e) {
  CurvePoint m;
  m.x = 0.5 * (a.x + b.x) - 0.125 * (e.dot(a.u) * a.u - e.dot(b.u) * b.u);
  m.u = a.u + b.u;
  const double length_sq = e.squaredNorm();
  if (length_sq > 0) m.u -= (2 * e.dot(m.u) / length_sq) * e;
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

}  // namespace

CurvePoint curved_midpoint(const CurvePoint& a, const CurvePoint& b) {
  const Vec3 e = b.x - a.x;
  if (!a.shape.allFinite() || !b.shape.allFinite()) return cubic_midpoint(a, b, e);
  const End from = end_of(a, e), to = end_of(b, e);
  if (!from.sound || !to.sound) return straight_midpoint(a, b);
  CurvePoint m;
  m.x = 0.5 * (a.x + b.x) + 5.0 / 32 * (from.tangent - to.tangent) + (from.bend + to.bend) / 64;
  const Vec3 tangent = 15.0 / 8 * e - 7.0 / 16 * (from.tangent + to.tangent) + (to.bend - from.bend) / 32;
  const Vec3 bulge = (from.turn - to.turn) / 8;
  m.u = 0.5 * (a.u + b.u) + bulge;
  normalise(m.u);
  make_orthogonal(m.u, tangent, bulge.norm());
  m.shape = mean_shape(a, b, m.u);
  correct_along(m.shape, m.u, tangent, 1.5 * (b.u - a.u) - 0.25 * (from.turn + to.turn));
  return m;
}

}  // namespace kappa
