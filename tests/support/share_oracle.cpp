// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include "oracles.hpp"

namespace kappa::oracle {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Quad;  // NOLINT(modernize-use-using): __extension__ needs the typedef
#else
using Quad = long double;  // 113 bits where the machine has them, which is where __float128 is missing
#endif

/// One Newton step doubles the 64 bits of the start; long double has the exponent range of Quad.
Quad root(Quad a) {
  if (!(a > 0)) return 0;
  const Quad s = std::sqrt(static_cast<long double>(a));
  return (s + a / s) / 2;
}

struct Point {
  Quad x, y, z;
};
Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Point operator*(Quad s, const Point& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Quad dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Point point(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// A point of the triangle in barycentric coordinates.
struct Bary {
  Quad b1, b2;
};

/// A triangle with what the walk along its boundary needs.
struct Frame {
  std::array<Point, 3> x;
  Point e1, e2, normal;
  Point grad1, grad2;  ///< of b1 and b2 in the plane
  Point centre;        ///< of the disc
  Quad twice_area;

  explicit Frame(const std::array<Vec3, 3>& corners) : x{point(corners[0]), point(corners[1]), point(corners[2])} {
    e1 = x[1] - x[0];
    e2 = x[2] - x[0];
    normal = cross(e1, e2);
    const Quad norm_sq = dot(normal, normal);
    twice_area = root(norm_sq);
    grad1 = (1 / norm_sq) * cross(e2, normal);
    grad2 = (1 / norm_sq) * cross(normal, e1);
    centre = (dot(x[0], normal) / norm_sq) * normal;
  }
  Point at(const Bary& b) const { return x[0] + b.b1 * e1 + b.b2 * e2; }
  bool contains(const Point& p) const {
    const Quad b1 = dot(p - x[0], grad1), b2 = dot(p - x[0], grad2);
    return b1 >= 0 && b2 >= 0 && b1 + b2 <= 1;
  }
};

/// Part [t0, t1] of the segment a + t d, t in [0, 1], that the ball of squared radius `r_sq` holds; false if none.
bool clip_edge(const Point& a, const Point& d, Quad r_sq, Quad& t0, Quad& t1) {
  const Quad aa = dot(d, d), b = dot(a, d), c = dot(a, a) - r_sq;
  const Quad discriminant = b * b - aa * c;
  if (discriminant < 0) return false;
  const Quad s = root(discriminant);
  const Quad q = b < 0 ? s - b : -(b + s);
  t0 = q / aa;
  t1 = q == 0 ? t0 : c / q;
  if (t0 > t1) std::swap(t0, t1);
  t0 = std::max<Quad>(t0, 0);
  t1 = std::min<Quad>(t1, 1);
  return t0 <= t1;
}

Bary on_edge(int edge, Quad t) {
  if (edge == 0) return {t, 0};
  if (edge == 1) return {1 - t, t};
  return {0, 1 - t};
}

/// Area and first moments in units of the triangle's area.
struct Moments {
  long double m = 0, m1 = 0, m2 = 0;
  void add(long double mass, long double b1, long double b2) {
    m += mass;
    m1 += mass * b1;
    m2 += mass * b2;
  }
};

/// Area of a circular segment of half-angle `beta` over radius^2, and first moment about its chord over radius^3.
void segment_moments(long double beta, long double& area, long double& moment) {
  if (beta > 0.5L) {
    const long double s = std::sin(beta), c = std::cos(beta);
    area = beta - s * c;
    moment = 2 * s * s * s / 3 - c * area;
    return;
  }
  // The closed forms cancel: integrate the widths 2 sin(phi) at the heights cos(phi) - cos(beta).
  static const GaussRule rule = gauss_rule(12);
  area = moment = 0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const long double phi = beta * rule.node[i], s = std::sin(phi);
    const long double strip = 2 * s * s * beta * rule.weight[i];
    area += strip;
    moment += strip * 2 * std::sin((beta + phi) / 2) * std::sin((beta - phi) / 2);
  }
}

void add_disc(const Frame& f, Quad rho_sq, Moments& to) {
  const Point p = f.centre - f.x[0];
  to.add(static_cast<long double>(2 * Quad(3.14159265358979323846264338327950288L) * rho_sq / f.twice_area),
         static_cast<long double>(dot(p, f.grad1)), static_cast<long double>(dot(p, f.grad2)));
}

/// The circular segment between the chord from `from` to `to_point` and the arc that runs counter-clockwise.
void add_arc(const Frame& f, const Bary& from, const Bary& to_point, Quad radius, Moments& to) {
  const Point p = f.at(from), q = f.at(to_point), chord = q - p;
  const Quad length = root(dot(chord, chord));
  const Quad rho_sq = dot(p - f.centre, p - f.centre);
  if (length <= Quad(1e-25L) * radius) {
    if (f.contains(2 * f.centre - p)) add_disc(f, rho_sq, to);
    return;
  }
  const Point outward = (1 / (length * f.twice_area)) * cross(chord, f.normal);
  const long double half = static_cast<long double>(length / 2);
  const long double height = static_cast<long double>(dot(p + q, outward) / 2);
  const long double rho = std::hypot(half, height);
  long double area = 0, moment = 0;
  segment_moments(std::atan2(half, height), area, moment);
  if (area <= 0) return;
  const Quad offset = rho * (moment / area);
  to.add(2 * (rho / static_cast<long double>(f.twice_area)) * rho * area,
         static_cast<long double>((from.b1 + to_point.b1) / 2 + offset * dot(outward, f.grad1)),
         static_cast<long double>((from.b2 + to_point.b2) / 2 + offset * dot(outward, f.grad2)));
}

void add_polygon(const std::vector<Bary>& p, Moments& to) {
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Quad ax = p[i].b1 - p[0].b1, ay = p[i].b2 - p[0].b2;
    const Quad bx = p[i + 1].b1 - p[0].b1, by = p[i + 1].b2 - p[0].b2;
    to.add(static_cast<long double>(ax * by - ay * bx), static_cast<long double>(p[0].b1 + (ax + bx) / 3),
           static_cast<long double>(p[0].b2 + (ay + by) / 3));
  }
}

Share share_of(const Moments& m) {
  if (m.m <= 0) return {};
  return {m.m, m.m1 / m.m, m.m2 / m.m};
}

}  // namespace

Share share_by_clipping(const std::array<Vec3, 3>& x, double radius) {
  const Frame f(x);
  const Quad r_sq = Quad(radius) * radius;
  std::vector<Bary> boundary;
  for (int e = 0; e < 3; ++e) {
    Quad t0, t1;
    if (!clip_edge(f.x[e], f.x[(e + 1) % 3] - f.x[e], r_sq, t0, t1)) continue;
    boundary.push_back(on_edge(e, t0));
    boundary.push_back(on_edge(e, t1));
  }
  Moments total;
  if (boundary.empty()) {
    const Quad rho_sq = r_sq - dot(f.centre, f.centre);
    if (rho_sq > 0 && f.contains(f.centre)) add_disc(f, rho_sq, total);
    return share_of(total);
  }
  add_polygon(boundary, total);
  for (std::size_t i = 1; i < boundary.size(); i += 2) {
    const Bary &from = boundary[i], &to = boundary[(i + 1) % boundary.size()];
    if (from.b1 != to.b1 || from.b2 != to.b2 || boundary.size() == 2) add_arc(f, from, to, radius, total);
  }
  return share_of(total);
}

namespace {

using Vector3 = std::array<long double, 3>;

/// Width of the ball on the line b2 = const of the triangle, and its first moments.
Vector3 chord_moments(const std::array<Vec3, 3>& x, long double radius, long double b2) {
  const LongVec3 e1 = (x[1] - x[0]).cast<long double>();
  const LongVec3 a = x[0].cast<long double>() + b2 * (x[2].cast<long double>() - x[0].cast<long double>());
  const long double aa = e1.squaredNorm(), b = a.dot(e1);
  // Distance of the line by a cross product: the discriminant b^2 - aa c would cancel far from the centre.
  const long double inside = radius * radius * aa - a.cross(e1).squaredNorm();
  if (inside <= 0) return {0, 0, 0};
  const long double s = std::sqrt(inside);
  const long double lo = std::max<long double>((-b - s) / aa, 0), hi = std::min<long double>((-b + s) / aa, 1 - b2);
  if (hi <= lo) return {0, 0, 0};
  return {hi - lo, (hi * hi - lo * lo) / 2, b2 * (hi - lo)};
}

using Integrand = std::function<Vector3(long double)>;

Vector3 simpson(long double h, const Vector3& a, const Vector3& m, const Vector3& b) {
  Vector3 s{};
  for (int i = 0; i < 3; ++i) s[i] = h / 6 * (a[i] + 4 * m[i] + b[i]);
  return s;
}

struct Panel {
  long double from, to;
  Vector3 a, m, b;
};

Vector3 refine(const Integrand& f, const Panel& p, const Vector3& whole, long double tolerance, int depth) {
  const long double mid = (p.from + p.to) / 2, h = (p.to - p.from) / 2;
  const Panel left{p.from, mid, p.a, f((p.from + mid) / 2), p.m}, right{mid, p.to, p.m, f((mid + p.to) / 2), p.b};
  const Vector3 l = simpson(h, left.a, left.m, left.b), r = simpson(h, right.a, right.m, right.b);
  long double error = 0;
  for (int i = 0; i < 3; ++i) error = std::max(error, std::abs(l[i] + r[i] - whole[i]));
  Vector3 sum{};
  if (depth == 0 || error < 15 * tolerance) {
    for (int i = 0; i < 3; ++i) sum[i] = l[i] + r[i] + (l[i] + r[i] - whole[i]) / 15;
    return sum;
  }
  const Vector3 ls = refine(f, left, l, tolerance / 2, depth - 1), rs = refine(f, right, r, tolerance / 2, depth - 1);
  for (int i = 0; i < 3; ++i) sum[i] = ls[i] + rs[i];
  return sum;
}

/// Panels of equal width first, so that a disc that is small in the triangle is not missed.
constexpr int kPanels = 128;

}  // namespace

Share share_by_quadrature(const std::array<Vec3, 3>& x, double radius) {
  const Integrand f = [&](long double b2) { return chord_moments(x, radius, b2); };
  Moments total;
  for (int i = 0; i < kPanels; ++i) {
    const long double from = static_cast<long double>(i) / kPanels, to = static_cast<long double>(i + 1) / kPanels;
    const Panel p{from, to, f(from), f((from + to) / 2), f(to)};
    const Vector3 s = refine(f, p, simpson(to - from, p.a, p.m, p.b), 1e-12L / kPanels, 30);
    total.m += 2 * s[0];
    total.m1 += 2 * s[1];
    total.m2 += 2 * s[2];
  }
  return share_of(total);
}

namespace {

using Polygon = std::vector<std::array<long double, 2>>;

/// Part of a convex polygon where g0 + g1 b1 + g2 b2 >= 0.
Polygon clip(const Polygon& p, long double g0, long double g1, long double g2) {
  Polygon out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    const long double fa = g0 + g1 * a[0] + g2 * a[1], fb = g0 + g1 * b[0] + g2 * b[1];
    if (fa >= 0) out.push_back(a);
    if ((fa >= 0) == (fb >= 0)) continue;
    const long double t = fa / (fa - fb);
    out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
  return out;
}

}  // namespace

Share share_of_collinear(const std::array<Vec3, 3>& x, double radius) {
  const LongVec3 a = x[0].cast<long double>();
  const LongVec3 e1 = x[1].cast<long double>() - a, e2 = x[2].cast<long double>() - a;
  const LongVec3 e3 = e2 - e1;
  LongVec3 along = e1.squaredNorm() >= e2.squaredNorm() ? e1 : e2;
  if (e3.squaredNorm() > along.squaredNorm()) along = e3;
  if (along.squaredNorm() == 0) return a.norm() <= radius ? Share{1, 1.0L / 3, 1.0L / 3} : Share{};
  along.normalize();
  const long double inside = static_cast<long double>(radius) * radius - a.cross(along).squaredNorm();
  if (inside < 0) return {};
  const long double s = std::sqrt(inside), l0 = a.dot(along), l1 = e1.dot(along), l2 = e2.dot(along);
  const Polygon p = clip(clip({{0, 0}, {1, 0}, {0, 1}}, s + l0, l1, l2), s - l0, -l1, -l2);
  Moments total;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const long double ax = p[i][0] - p[0][0], ay = p[i][1] - p[0][1];
    const long double bx = p[i + 1][0] - p[0][0], by = p[i + 1][1] - p[0][1];
    total.add(ax * by - ay * bx, p[0][0] + (ax + bx) / 3, p[0][1] + (ay + by) / 3);
  }
  return share_of(total);
}

namespace {

Quad segment_distance_sq(const Point& a, const Point& b) {
  const Point d = b - a;
  const Quad dd = dot(d, d), t = -dot(a, d);
  if (!(dd > 0) || t <= 0) return dot(a, a);
  if (t >= dd) return dot(b, b);
  const Point c = cross(a, b);
  return dot(c, c) / dd;
}

}  // namespace

long double distance_excess(const std::array<Vec3, 3>& x, double radius) {
  const std::array<Point, 3> p{point(x[0]), point(x[1]), point(x[2])};
  Quad best = segment_distance_sq(p[0], p[1]);
  best = std::min(best, segment_distance_sq(p[1], p[2]));
  best = std::min(best, segment_distance_sq(p[2], p[0]));
  const Point n = cross(p[1] - p[0], p[2] - p[0]);
  const Quad nn = dot(n, n);
  if (nn > 0) {
    const Frame f(x);
    if (f.contains(f.centre)) best = std::min(best, dot(f.centre, f.centre));
  }
  const Quad r_sq = Quad(radius) * radius;
  return static_cast<long double>((best - r_sq) / r_sq);
}

}  // namespace kappa::oracle
