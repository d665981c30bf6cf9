// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>

#include "density.hpp"

// Triangles that wait to be measured: how they come into lanes, and where their normals are. Included by kernel files
// alone.

namespace kappa::kernels {
namespace {

/// What all steps need for one ball.
template <class Real>
struct Rim {
  const TriangleView& triangles;
  const BallQuery<Real>& query;
  int number;  ///< of the ball
  Gathering<Real>& ball;
};

/// Triangles relative to the centre of a ball.
template <class V>
struct Placed {
  Vector3<V> x, e1, e2;  ///< first corner, and the ways from there to the others
};

/// Powers of the corners, and by how much those of the others are more than that of the first.
template <class V>
struct Powers {
  V first, second, third, to_second, to_third;
};

template <class V, int N>
[[gnu::always_inline]] inline Vector3<V> rows_of(const RealOf<V> (&rows)[3][N], int first) {
  return {load<V>(rows[0] + first), load<V>(rows[1] + first), load<V>(rows[2] + first)};
}

/// As many triangles of the mesh as there are lanes, wherever they are.
template <class V>
class OfMesh {
 public:
  [[gnu::always_inline]] OfMesh(const TriangleView& t, const std::uint32_t* names) : triangles_(t) {
    for (int lane = 0; lane < kLanes<V>; ++lane) at_[lane] = t.corners + std::size_t{3} * names[lane];
  }

  [[gnu::always_inline]] Corners<V> corners(const double* centre) const {
    const Vector3<V> c = {splat<V>(centre[0]), splat<V>(centre[1]), splat<V>(centre[2])};
    const auto at = [&](int corner) { return of(triangles_.positions, corner) - c; };
    return {at(0), at(1), at(2)};
  }
  [[gnu::always_inline]] Fan<V> normals() const {
    const Vector3<V> first = of(triangles_.normals, 0);
    return {first, of(triangles_.normals, 1) - first, of(triangles_.normals, 2) - first};
  }

 private:
  [[gnu::always_inline]] Vector3<V> of(const double* vectors, int corner) const {
    const double* from[kLanes<V>];
    for (int lane = 0; lane < kLanes<V>; ++lane) from[lane] = vectors + std::size_t{3} * at_[lane][corner];
    return gathered_vectors(from);
  }

  const TriangleView& triangles_;
  const std::uint32_t* at_[kLanes<V>];
};

/// As many waiting triangles as there are lanes, from one place on: of the mesh in doubles, of leaves in floats.
template <class V, class Real = RealOf<V>>
class InLanes;
template <class V>
class InLanes<V, double> {
 public:
  [[gnu::always_inline]] InLanes(const Rim<double>& rim, const Names& from, int first)
      : x_(OfMesh<V>(rim.triangles, from.triangle + first).corners(rim.query.centre)) {}
  [[gnu::always_inline]] const Corners<V>& corners() const { return x_; }
  [[gnu::always_inline]] Placed<V> placed() const { return {x_.x0, x_.x1 - x_.x0, x_.x2 - x_.x0}; }
  [[gnu::always_inline]] Powers<V> powers(V radius_sq) const {
    const V first = dot(x_.x0, x_.x0) - radius_sq;
    const V second = dot(x_.x1, x_.x1) - radius_sq, third = dot(x_.x2, x_.x2) - radius_sq;
    return {first, second, third, second - first, third - first};
  }

 private:
  Corners<V> x_;
};
template <class V>
class InLanes<V, float> {
 public:
  [[gnu::always_inline]] InLanes(const Rim<float>&, const Waiting<float>& from, int first) : w_(from), first_(first) {}
  [[gnu::always_inline]] Placed<V> placed() const {
    return {rows_of<V>(w_.x, first_), rows_of<V>(w_.e1, first_), rows_of<V>(w_.e2, first_)};
  }
  [[gnu::always_inline]] Powers<V> powers(V) const {
    const V first = load<V>(w_.power + first_), to_second = load<V>(w_.to_second + first_);
    const V to_third = load<V>(w_.to_third + first_);
    return {first, first + to_second, first + to_third, to_second, to_third};
  }

 private:
  const Waiting<float>& w_;
  int first_;
};

/// Their normals.
template <class V>
[[gnu::always_inline]] inline Fan<V> normals_from(const Rim<double>& rim, const Names& names, int first) {
  return OfMesh<V>(rim.triangles, names.triangle + first).normals();
}
template <class V, class Triangles>
[[gnu::always_inline]] inline Fan<V> normals_from(const Rim<float>&, const Triangles& w, int first) {
  return {rows_of<V>(w.u, first), rows_of<V>(w.d1, first), rows_of<V>(w.d2, first)};
}

/// Four triangles that take the general form.
class WidenedInLanes {
 public:
  WidenedInLanes(const Irregular<float>& from, int first) : w_(from), first_(first) {}
  Corners<VD> corners() const {
    const Vector3<VD> x = at(w_.x);
    return {x, x + at(w_.e1), x + at(w_.e2)};
  }
  Placed<VD> placed() const { return {at(w_.x), at(w_.e1), at(w_.e2)}; }

 private:
  Vector3<VD> at(const double (&rows)[3][Names::kPlaces]) const { return rows_of<VD>(rows, first_); }

  const Irregular<float>& w_;
  int first_;
};
inline InLanes<VD> four_irregular(const Rim<double>& rim, int first) {
  return {rim, rim.ball.irregular, first};
}
inline WidenedInLanes four_irregular(const Rim<float>& rim, int first) {
  return {rim.ball.irregular, first};
}

/// Lets the triangle at a place of those that wait take the general form.
inline void make_irregular(const Waiting<double>& from, int place, Irregular<double>& to) {
  to.triangle[to.count++] = from.triangle[place];
}
inline void make_irregular(const Waiting<float>& from, int place, Irregular<float>& to) {
  const int at = to.count++;
  to.triangle[at] = from.triangle[place];
  for (int axis = 0; axis < 3; ++axis) {
    to.x[axis][at] = static_cast<double>(from.x[axis][place]);
    to.e1[axis][at] = static_cast<double>(from.e1[axis][place]);
    to.e2[axis][at] = static_cast<double>(from.e2[axis][place]);
    to.u[axis][at] = static_cast<double>(from.u[axis][place]);
    to.d1[axis][at] = static_cast<double>(from.d1[axis][place]);
    to.d2[axis][at] = static_cast<double>(from.d2[axis][place]);
  }
}

/// Takes away the first kRim of those that wait; of the others there are fewer than kWidth.
inline void move_down(Names& w) {
  __builtin_memcpy(w.triangle, w.triangle + kRim, kWidth * sizeof(std::uint32_t));
  w.count -= kRim;
}
inline void move_down(Waiting<float>& w) {
  const auto move = [](float* row) { __builtin_memcpy(row, row + kRim, kWidth * sizeof(float)); };
  for (auto* const rows : {&w.x, &w.e1, &w.e2, &w.u, &w.d1, &w.d2}) {
    for (float* const row : *rows) move(row);
  }
  for (float* const row : {w.power, w.to_second, w.to_third}) move(row);
  move_down(static_cast<Names&>(w));
}

/// Lets triangles in the lanes of `mask` wait.
inline void let_wait(Names& w, const Compression<VF>& packed, VF names, unsigned mask) {
  store(w.triangle + w.count, packed(names));
  w.count += __builtin_popcount(mask);
}

}  // namespace
}  // namespace kappa::kernels
