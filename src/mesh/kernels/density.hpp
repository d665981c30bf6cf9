// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sums.hpp"

// Integrals of the density over triangles and parts of them. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// What triangles have at their first corners, and the ways from there to what they have at the others.
template <class V>
struct Fan {
  Vector3<V> first, d1, d2;
};

template <class V>
inline void add_lanes(double* to, V lanes) {
  store(to, load<VD>(to) + four_sums(lanes));
}

/// What a ball has of triangles, or has too much of them.
template <class V>
struct Piece {
  V share;   ///< of the area
  V m1, m2;  ///< integral of (b_i - 1/3) over the area of the triangle, b_i the barycentric coordinates
};

/// Adds what pieces of triangles have: edges e1, e2 from the first corner, their cross product `area`, and normals `u`.
/// The density is linear: its integral is that of the normal integrated over the piece.
template <class Real, class V>
[[gnu::always_inline]] inline void add_densities(const Fan<V>& u, const Vector3<V>& e1, const Vector3<V>& e2,
                                                 const Vector3<V>& area, V area_sq, const Piece<V>& piece,
                                                 Gathering<Real>& ball) {
  const V half = splat<V>(0.5), third = splat<V>(1.0 / 3), half_share = half * piece.share;
  const Vector3<V>&d1 = u.d1, &d2 = u.d2;
  const V third_share = third * piece.share;
  const Vector3<V> sum = piece.share * u.first + (third_share + piece.m1) * d1 + (third_share + piece.m2) * d2;
  const Vector3<V> normal = half * sum, p = cross(e1, normal), q = cross(e2, normal);
  add_lanes(ball.lanes[0], half_share * sqrt(area_sq));
  add_lanes(ball.lanes[1], dot(normal, area));
  add_lanes(ball.lanes[2], half_share * dot(u.first, cross(d1, d2)));
  add_lanes(ball.lanes[3], p.x * d2.x - q.x * d1.x);
  add_lanes(ball.lanes[4], p.y * d2.y - q.y * d1.y);
  add_lanes(ball.lanes[5], p.z * d2.z - q.z * d1.z);
  add_lanes(ball.lanes[6], half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x)));
  add_lanes(ball.lanes[7], half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x)));
  add_lanes(ball.lanes[8], half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y)));
}

}  // namespace
}  // namespace kappa::kernels
