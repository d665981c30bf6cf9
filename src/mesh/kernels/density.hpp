// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sums.hpp"

// Integrals of the density over triangles and parts of them, from the corners and normals of the mesh. Included by
// kernel files alone.

namespace kappa::kernels {
namespace {

inline std::size_t triangle_of(std::uint64_t id) {
  return static_cast<std::uint32_t>(id);
}

/// The corners from each one on, in turn.
constexpr std::uint8_t kTurned[] = {0, 1, 2, 0, 1};

/// Where the corners of four triangles are among positions and normals, the one that an id calls the first before the
/// others.
struct FourCorners {
  std::size_t at[3][4];

  [[gnu::always_inline]] FourCorners(const TriangleView& t, const std::uint64_t* ids) {
    for (int lane = 0; lane < 4; ++lane) {
      const std::uint32_t* const corners = t.corners + 3 * triangle_of(ids[lane]);
      const std::uint8_t* const turned = kTurned + (ids[lane] >> 32);
      for (int corner = 0; corner < 3; ++corner) at[corner][lane] = std::size_t{3} * corners[turned[corner]];
    }
  }

  [[gnu::always_inline]] Vector3<VD> of(const double* vectors, int corner) const {
    const std::size_t* const i = at[corner];
    const double* const from[4] = {vectors + i[0], vectors + i[1], vectors + i[2], vectors + i[3]};
    return gathered_vectors(from);
  }
};

/// What triangles have at their first corners, and the ways from there to what they have at the others.
template <class V>
struct Fan {
  Vector3<V> first, d1, d2;
};

[[gnu::always_inline]] inline Fan<VD> fan_of(const double* vectors, const FourCorners& c) {
  const Vector3<VD> first = c.of(vectors, 0);
  return {first, c.of(vectors, 1) - first, c.of(vectors, 2) - first};
}

[[gnu::always_inline]] inline Vector3<VF> narrowed(const Vector3<VD>& low, const Vector3<VD>& high) {
  return {narrowed(low.x, high.x), narrowed(low.y, high.y), narrowed(low.z, high.z)};
}
[[gnu::always_inline]] inline Fan<VF> narrowed(const Fan<VD>& low, const Fan<VD>& high) {
  return {narrowed(low.first, high.first), narrowed(low.d1, high.d1), narrowed(low.d2, high.d2)};
}

/// Positions or normals of the triangles in all lanes.
[[gnu::always_inline]] inline Fan<VD> fan_of(const double* vectors, const TriangleView& t, const std::uint64_t* ids,
                                             Lanes<double>) {
  return fan_of(vectors, FourCorners(t, ids));
}
[[gnu::always_inline]] inline Fan<VF> fan_of(const double* vectors, const TriangleView& t, const std::uint64_t* ids,
                                             Lanes<float>) {
  return narrowed(fan_of(vectors, FourCorners(t, ids)), fan_of(vectors, FourCorners(t, ids + 4)));
}

/// Weights of the triangles in all lanes.
template <class Real>
inline Vector<Real> weights_of(const TriangleView& t, const std::uint64_t* ids) {
  Vector<Real> by = spread(Real(1));
  if (!t.weights) return by;
  for (int lane = 0; lane < Lanes<Real>::kCount; ++lane)
    by[lane] = static_cast<Real>(t.weights[triangle_of(ids[lane])]);
  return by;
}

inline void add_lanes(double* to, VD lanes) {
  store(to, load<VD>(to) + lanes);
}
inline void add_lanes(double* to, VF lanes) {
  store(to, load<VD>(to) + low_half(lanes));
  store(to + 4, load<VD>(to + 4) + high_half(lanes));
}

/// What a ball has of triangles, or has too much of them.
template <class V>
struct Piece {
  V share;   ///< of the area
  V m1, m2;  ///< integral of (b_i - 1/3) over the area of the triangle, b_i the barycentric coordinates
};

/// Adds what pieces of triangles with edges e1, e2 from the first corner and normals `u` have. The density is linear:
/// its integral is that of the normal integrated over the piece.
template <class Real, class V>
[[gnu::always_inline]] inline void add_densities(const Fan<V>& u, const Vector3<V>& e1, const Vector3<V>& e2,
                                                 const Piece<V>& piece, Gathering<Real>& ball) {
  const V half = spread(Real(0.5)), third = spread(Real(1.0 / 3)), half_share = half * piece.share;
  const Vector3<V>&d1 = u.d1, &d2 = u.d2;
  const V third_share = third * piece.share;
  const Vector3<V> sum = piece.share * u.first + (third_share + piece.m1) * d1 + (third_share + piece.m2) * d2;
  const Vector3<V> normal = half * sum, area = cross(e1, e2), p = cross(e1, normal), q = cross(e2, normal);
  add_lanes(ball.lanes[0], half_share * sqrt(dot(area, area)));
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
