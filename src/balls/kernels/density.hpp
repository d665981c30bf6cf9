// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>

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

/// What several vectors of pieces have together, a lane each. Named one by one: of an array the compiler would keep
/// none in registers.
template <class V>
struct Integrals {
  V area, mu0, mu2, xx, yy, zz, xy, xz, yz;
};
template <class V>
[[gnu::always_inline]] inline Integrals<V> no_integrals() {
  const V zero = splat<V>(0);
  return {zero, zero, zero, zero, zero, zero, zero, zero, zero};
}

/// Adds what pieces of triangles have: edges e1, e2 from the first corner, their cross product `area`, and normals `u`.
/// The density is linear: its integral is that of the normal integrated over the piece.
template <class V>
[[gnu::always_inline]] inline void add_densities(const Fan<V>& u, const Vector3<V>& e1, const Vector3<V>& e2,
                                                 const Vector3<V>& area, V area_sq, const Piece<V>& piece,
                                                 Integrals<V>& to) {
  const V half = splat<V>(0.5), third = splat<V>(1.0 / 3), half_share = half * piece.share;
  const Vector3<V>&d1 = u.d1, &d2 = u.d2;
  const V third_share = third * piece.share;
  const Vector3<V> sum = piece.share * u.first + (third_share + piece.m1) * d1 + (third_share + piece.m2) * d2;
  const Vector3<V> normal = half * sum, p = cross(e1, normal), q = cross(e2, normal);
  to.area = to.area + half_share * sqrt(area_sq);
  to.mu0 = to.mu0 + dot(normal, area);
  to.mu2 = to.mu2 + half_share * dot(u.first, cross(d1, d2));
  to.xx = to.xx + (p.x * d2.x - q.x * d1.x);
  to.yy = to.yy + (p.y * d2.y - q.y * d1.y);
  to.zz = to.zz + (p.z * d2.z - q.z * d1.z);
  to.xy = to.xy + half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x));
  to.xz = to.xz + half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x));
  to.yz = to.yz + half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y));
}

/// Gives them to a ball.
template <class Real, class V>
[[gnu::always_inline]] inline void add_lanes(Gathering<Real>& ball, const Integrals<V>& from) {
  int row = 0;
  for (const V& lanes : {from.area, from.mu0, from.mu2, from.xx, from.yy, from.zz, from.xy, from.xz, from.yz})
    add_lanes(ball.lanes[row++], lanes);
}

}  // namespace
}  // namespace kappa::kernels
