// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_ball_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace kappa::test {
namespace {

/// Random numbers of the shapes the families need.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  double uniform(double a, double b) { return a + (b - a) * std::generate_canonical<double, 53>(random_); }
  double log_uniform(double a, double b) { return std::pow(10.0, uniform(std::log10(a), std::log10(b))); }
  bool coin() { return random_() & 1; }
  int pick(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  Vec3 direction() {
    Vec3 v;
    do v = Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
    return v.normalized();
  }
  /// Relative distance from contact: 0, a rounding error or up to 1e-2, either sign.
  double contact() { return coin() && coin() ? 0.0 : (coin() ? 1 : -1) * log_uniform(1e-16, 1e-2); }

 private:
  std::mt19937_64 random_;
};

/// Two tangents of the triangle's plane and its normal, half of the time along the axes.
struct Basis {
  Vec3 t1 = Vec3::UnitX(), t2 = Vec3::UnitY(), n = Vec3::UnitZ();
};

Basis random_basis(Dice& dice) {
  Basis b;
  if (dice.coin()) return b;
  b.n = dice.direction();
  b.t1 = b.n.cross(dice.direction()).normalized();
  b.t2 = b.n.cross(b.t1);
  return b;
}

TrianglePlan random_plan(Dice& dice, double min_size, double max_size, double min_height) {
  TrianglePlan p;
  p.longest = dice.log_uniform(min_size, max_size);
  p.height = dice.log_uniform(min_height, 0.86);
  p.foot = dice.uniform(0, 1);
  p.b1 = dice.uniform(0, 1);
  p.b2 = dice.uniform(0, 1);
  if (p.b1 + p.b2 > 1) {
    p.b1 = 1 - p.b1;
    p.b2 = 1 - p.b2;
  }
  return p;
}

/// The plan with the point that is to be placed on its long edge.
TrianglePlan on_edge(TrianglePlan p) {
  p.b2 = 0;
  return p;
}

/// A place from which the sphere of radius 1 runs through or near a triangle of the given size.
Vec3 near_sphere(Dice& dice, double size) {
  const double r = dice.coin() ? dice.uniform(0, 1.2) : 1 + std::min(size, 1.0) * dice.uniform(-1, 1);
  return r * dice.direction();
}

BallCase generic(Dice& dice, double min_size, double max_size, double min_height) {
  const Basis b = random_basis(dice);
  const TrianglePlan p = random_plan(dice, min_size, max_size, min_height);
  return {planned_triangle(p, b.t1, b.t2, near_sphere(dice, p.longest)), 1};
}

BallCase centre_on_corner(Dice& dice) {
  const Basis b = random_basis(dice);
  TrianglePlan p = random_plan(dice, 1e-1, 1e4, 1e-6);
  p.b1 = p.b2 = 0;
  return {planned_triangle(p, b.t1, b.t2, Vec3::Zero()), 1};
}

BallCase in_plane(Dice& dice, TrianglePlan p) {
  const Basis b = random_basis(dice);
  const double a = dice.uniform(0, 2 * kPi), r = dice.uniform(0, 1);
  const Vec3 place = r * (std::cos(a) * b.t1 + std::sin(a) * b.t2);
  return {planned_triangle(p, b.t1, b.t2, place), 1};
}

BallCase tangent_plane(Dice& dice) {
  const Basis b = random_basis(dice);
  return {planned_triangle(random_plan(dice, 1e-4, 1e4, 1e-6), b.t1, b.t2, (1 + dice.contact()) * b.n), 1};
}

BallCase tangent_edge(Dice& dice) {
  const Basis b = random_basis(dice);
  const double tilt = dice.coin() ? 0.0 : dice.uniform(-1.5, 1.5), side = dice.coin() ? 1 : -1;
  const Vec3 place = (1 + dice.contact()) * (side * std::cos(tilt) * b.t2 + std::sin(tilt) * b.n);
  return {planned_triangle(on_edge(random_plan(dice, 1e-4, 1e4, 1e-6)), b.t1, b.t2, place), 1};
}

BallCase obtuse_needle(Dice& dice) {
  const Basis b = random_basis(dice);
  TrianglePlan p = random_plan(dice, 1e-4, 1e4, 1e-6);
  p.height = dice.log_uniform(1e-6, 1e-2);
  p.foot = dice.coin() ? 0.5 : dice.log_uniform(1e-5, 0.5);
  return {planned_triangle(p, b.t1, b.t2, near_sphere(dice, p.longest)), 1};
}

BallCase missed(Dice& dice) {
  const Basis b = random_basis(dice);
  const double far = 1 + dice.log_uniform(1e-12, 1e2);
  const Vec3 place = dice.coin() ? Vec3(far * b.n) : Vec3(-far * b.t2);
  return {planned_triangle(on_edge(random_plan(dice, 1e-4, 1e4, 1e-6)), b.t1, b.t2, place), 1};
}

BallCase ball_inside(Dice& dice) {
  const Basis b = random_basis(dice);
  TrianglePlan p = random_plan(dice, 10, 1e4, 0.5);
  p.b1 = p.b2 = 1.0 / 3;
  return {planned_triangle(p, b.t1, b.t2, dice.uniform(0, 1) * b.n), 1};
}

BallCase triangle_inside(Dice& dice) {
  BallCase c;
  for (Vec3& x : c.x) x = (dice.coin() ? dice.uniform(0, 1) : 1 - dice.log_uniform(1e-15, 1e-2)) * dice.direction();
  return c;
}

BallCase corner_on_sphere(Dice& dice) {
  const Basis b = random_basis(dice);
  TrianglePlan p = random_plan(dice, 1e-4, 1e4, 1e-6);
  p.b1 = p.b2 = 0;
  return {planned_triangle(p, b.t1, b.t2, dice.coin() ? Vec3(b.t1) : dice.direction()), 1};
}

BallCase one_case(Family family, Dice& dice) {
  switch (family) {
    case Family::Generic:
      return generic(dice, 1e-4, 1e4, 0.05);
    case Family::Sliver:
      return generic(dice, 1e-4, 1e4, 1e-6);
    case Family::CentreOnCorner:
      return centre_on_corner(dice);
    case Family::CentreOnEdge:
      return {planned_triangle(on_edge(random_plan(dice, 1e-1, 1e4, 1e-6)), Vec3::UnitX(),
                               dice.direction().cross(Vec3::UnitX()).normalized(), Vec3::Zero()),
              1};
    case Family::CentreInPlane:
      return in_plane(dice, random_plan(dice, 1e-1, 1e4, 1e-6));
    case Family::TangentPlane:
      return tangent_plane(dice);
    case Family::TangentEdge:
      return tangent_edge(dice);
    case Family::ObtuseNeedle:
      return obtuse_needle(dice);
    case Family::Missed:
      return missed(dice);
    case Family::BallInside:
      return ball_inside(dice);
    case Family::TriangleInside:
      return triangle_inside(dice);
    case Family::CornerOnSphere:
      return corner_on_sphere(dice);
    case Family::Giant:
      return generic(dice, 1e3, 1e4, 1e-6);
    case Family::Tiny:
      break;
  }
  return generic(dice, 1e-4, 1e-3, 1e-6);
}

/// The case with its corners permuted and, half of the time, in other units.
void disguise(BallCase& c, Dice& dice) {
  for (int i = 2; i > 0; --i) std::swap(c.x[i], c.x[dice.pick(i + 1)]);
  if (dice.coin()) return;
  c.radius = dice.log_uniform(1e-3, 1e3);
  for (Vec3& x : c.x) x *= c.radius;
}

}  // namespace

const char* family_name(Family family) {
  static constexpr std::array<const char*, kFamilies> kNames = {
      "generic",      "sliver",        "centre on corner", "centre on edge", "centre in plane", "tangent plane",
      "tangent edge", "obtuse needle", "missed",           "ball inside",    "triangle inside", "corner on sphere",
      "giant",        "tiny"};
  return kNames[static_cast<std::size_t>(family)];
}

std::array<Vec3, 3> planned_triangle(const TrianglePlan& p, const Vec3& t1, const Vec3& t2, const Vec3& place) {
  const auto at = [&](double along, double up) {
    const double s = p.longest * (along - p.b1 - p.b2 * p.foot), t = p.longest * p.height * (up - p.b2);
    return Vec3(place + s * t1 + t * t2);
  };
  return {at(0, 0), at(1, 0), at(p.foot, 1)};
}

std::vector<BallCase> ball_cases(Family family, std::size_t count, std::uint64_t seed) {
  Dice dice(seed);
  std::vector<BallCase> cases;
  cases.reserve(count);
  while (cases.size() < count) {
    BallCase c = one_case(family, dice);
    disguise(c, dice);
    cases.push_back(c);
  }
  return cases;
}

double distance_rounding(const BallCase& c) {
  const double farthest = std::max({c.x[0].norm(), c.x[1].norm(), c.x[2].norm()});
  return 2 * 4 * 0x1p-53 * std::max(1.0, farthest / c.radius);
}

std::string describe(const BallCase& c) {
  std::string text = "{{";
  char buffer[128];
  for (const Vec3& x : c.x) {
    std::snprintf(buffer, sizeof buffer, "Vec3(%a, %a, %a), ", x.x(), x.y(), x.z());
    text += buffer;
  }
  std::snprintf(buffer, sizeof buffer, "}, %a}", c.radius);
  return text + buffer;
}

}  // namespace kappa::test
