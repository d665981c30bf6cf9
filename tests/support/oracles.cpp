// SPDX-License-Identifier: BSD-3-Clause
#include "oracles.hpp"

#include <algorithm>
#include <cmath>

namespace kappa::oracle {
namespace {

/// Position, normal and their derivatives at a point of a patch.
struct Jet {
  LongVec3 u, x_s, x_t, u_s, u_t;
};

long double det(const LongVec3& a, const LongVec3& b, const LongVec3& c) {
  return a.dot(b.cross(c));
}

/// The invariant 2-forms of section 3 of the SGP 2020 paper, each entry of mu^(X,Y) from its definition.
Forms forms_of(const Jet& j, long double weight) {
  Forms f;
  f.mu0 = weight * det(j.u, j.x_s, j.x_t);
  f.mu1 = weight * (det(j.u, j.x_s, j.u_t) + det(j.u, j.u_s, j.x_t));
  f.mu2 = weight * det(j.u, j.u_s, j.u_t);
  for (int row = 0; row < 3; ++row) {
    const LongVec3 ux = j.u.cross(LongVec3::Unit(row));
    for (int col = 0; col < 3; ++col) {
      f.mu_xy(row, col) = weight * (ux.dot(j.x_s) * j.u_t[col] - ux.dot(j.x_t) * j.u_s[col]);
    }
  }
  return f;
}

LongVec3 wide(const Vec3& v) {
  return v.cast<long double>();
}

Jet triangle_jet(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u, long double s, long double t) {
  const LongVec3 u_s = wide(u[1]) - wide(u[0]), u_t = wide(u[2]) - wide(u[0]);
  return {wide(u[0]) + s * u_s + t * u_t, wide(x[1]) - wide(x[0]), wide(x[2]) - wide(x[0]), u_s, u_t};
}

LongVec3 bilinear(const std::array<Vec3, 4>& p, long double s, long double t) {
  return (1 - s) * (1 - t) * wide(p[0]) + s * (1 - t) * wide(p[1]) + (1 - s) * t * wide(p[2]) + s * t * wide(p[3]);
}
LongVec3 bilinear_s(const std::array<Vec3, 4>& p, long double t) {
  return (1 - t) * (wide(p[1]) - wide(p[0])) + t * (wide(p[3]) - wide(p[2]));
}
LongVec3 bilinear_t(const std::array<Vec3, 4>& p, long double s) {
  return (1 - s) * (wide(p[2]) - wide(p[0])) + s * (wide(p[3]) - wide(p[1]));
}

/// Absolute values of the forms `f`, which hold `share` of a triangle. Where they vanish by cancellation (parallel
/// differences of normals) a thousandth of the products they are differences of stands in.
Forms magnitude(const Forms& f, const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u, long double share) {
  const long double e1 = (x[1] - x[0]).norm(), e2 = (x[2] - x[0]).norm();
  const long double d1 = (u[1] - u[0]).norm(), d2 = (u[2] - u[0]).norm(), floor = 5e-4L * share;
  Forms a;
  a.mu0 = std::max(std::abs(f.mu0), floor * e1 * e2);
  a.mu1 = std::max(std::abs(f.mu1), floor * (e1 * d2 + e2 * d1));
  a.mu2 = std::max(std::abs(f.mu2), floor * d1 * d2);
  a.mu_xy = f.mu_xy.cwiseAbs();
  return a;
}

Forms scaled(const Forms& f, long double factor) {
  Forms s = f;
  s.mu0 *= factor;
  s.mu1 *= factor;
  s.mu2 *= factor;
  s.mu_xy *= factor;
  return s;
}

long double area_of(const std::array<Vec3, 3>& x) {
  return (wide(x[1]) - wide(x[0])).cross(wide(x[2]) - wide(x[0])).norm() / 2;
}

}  // namespace

GaussRule gauss_rule(int n) {
  GaussRule rule;
  for (int i = 0; i < n; ++i) {
    long double z = std::cos(3.14159265358979323846264L * (i + 0.75L) / (n + 0.5L)), derivative = 1;
    for (int step = 0; step < 8; ++step) {
      long double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const long double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      derivative = n * (z * p - before) / (z * z - 1);
      z -= p / derivative;
    }
    rule.node.push_back((1 + z) / 2);
    rule.weight.push_back(1 / ((1 - z * z) * derivative * derivative));
  }
  return rule;
}

Forms& Forms::operator+=(const Forms& other) {
  mu0 += other.mu0;
  mu1 += other.mu1;
  mu2 += other.mu2;
  mu_xy += other.mu_xy;
  return *this;
}

Forms triangle_forms_at(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u, long double b1, long double b2) {
  return forms_of(triangle_jet(x, u, b1, b2), 0.5L);
}

Forms triangle_forms(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u) {
  static const GaussRule rule = gauss_rule(4);
  Forms sum;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const long double s = rule.node[i], t = rule.node[j] * (1 - s);
      sum += forms_of(triangle_jet(x, u, s, t), rule.weight[i] * rule.weight[j] * (1 - s));
    }
  }
  return sum;
}

Forms bilinear_forms(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u) {
  static const GaussRule rule = gauss_rule(6);
  Forms sum;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const long double s = rule.node[i], t = rule.node[j];
      const Jet jet{bilinear(u, s, t), bilinear_s(x, t), bilinear_t(x, s), bilinear_s(u, t), bilinear_t(u, s)};
      sum += forms_of(jet, rule.weight[i] * rule.weight[j]);
    }
  }
  return sum;
}

namespace {

/// The triangles of a face, split at its barycentre as SPEC section 1 has it.
struct Parts {
  std::vector<std::array<Vec3, 3>> x, u;
};

Parts parts_of(const Mesh& mesh, const Normals& normals, std::size_t face) {
  const Faces::View f = mesh.faces[face];
  Parts parts;
  for (const Index v : f) {
    if (!mesh.vertices[v].allFinite() || !normals[v].allFinite()) return parts;
  }
  if (f.size() == 3) {
    parts.x.push_back({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
    parts.u.push_back({normals[f[0]], normals[f[1]], normals[f[2]]});
    return parts;
  }
  Vec3 b = Vec3::Zero(), ub = Vec3::Zero();
  for (const Index v : f) {
    b += mesh.vertices[v] / static_cast<double>(f.size());
    ub += normals[v] / static_cast<double>(f.size());
  }
  ub = ub.norm() < 1e-12 ? Vec3::Zero() : Vec3(ub.normalized());
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Index p = f[i], q = f[(i + 1) % f.size()];
    parts.x.push_back({mesh.vertices[p], mesh.vertices[q], b});
    parts.u.push_back({normals[p], normals[q], ub});
  }
  return parts;
}

bool is_degenerate(const std::array<Vec3, 3>& x) {
  const long double longest =
      std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
  return 2 * area_of(x) <= 1e-12L * longest;
}

}  // namespace

BallForms ball_forms(const Mesh& mesh, const Normals& normals, const Vec3& centre, double radius, BallDefinition ball) {
  BallForms total;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    const Parts parts = parts_of(mesh, normals, face);
    for (std::size_t i = 0; i < parts.x.size(); ++i) {
      std::array<Vec3, 3> x = parts.x[i];
      for (Vec3& corner : x) corner -= centre;
      if (distance_excess(x, radius) > 0) continue;
      ++total.face_count;
      const Share s = is_degenerate(x) ? share_of_collinear(x, radius) : share_by_clipping(x, radius);
      const Forms density = ball == BallDefinition::ExactDensity ? triangle_forms_at(x, parts.u[i], s.b1, s.b2)
                                                                 : triangle_forms(x, parts.u[i]);
      const Forms part = scaled(density, s.share * mesh.weight(face));
      total.sum += part;
      total.scale += magnitude(part, x, parts.u[i], s.share * mesh.weight(face));
      total.area += s.share * mesh.weight(face) * area_of(x);
    }
  }
  return total;
}

double relative_error(const MeasureSum& got, const BallForms& expected) {
  const auto error = [](long double a, long double b, long double scale) {
    return a == b ? 0.0L : std::abs(a - b) / std::max(scale, 1e-300L);
  };
  const Forms &e = expected.sum, &s = expected.scale;
  long double worst = error(got.area, expected.area, expected.area);
  worst = std::max(worst, error(got.mu0, e.mu0, s.mu0));
  worst = std::max(worst, error(got.mu2, e.mu2, s.mu2));
  // Entries of one tensor share a scale: each is a sum of products of the same normals and edges.
  const long double tensor_scale = std::max(s.mu_xy.maxCoeff(), s.mu1);
  worst = std::max(worst, error(got.mu1(), e.mu1, tensor_scale));
  const LongMat3 sym = (e.mu_xy + e.mu_xy.transpose()) / 2;
  const Mat3 tensor = got.tensor();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) worst = std::max(worst, error(tensor(i, j), sym(i, j), tensor_scale));
  }
  return static_cast<double>(worst);
}

}  // namespace kappa::oracle
