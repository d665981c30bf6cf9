// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/estimate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/scan/scan.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};
const std::vector<double> kRadii = {0.25, 0.7};

/// All fields that the tests compare: both ball definitions at two radii, and both vertex limits.
std::vector<CurvatureField> all_fields(const Mesh& mesh, const Normals& u, double unit = 1) {
  const BruteForceBallSum balls(triangles_of(mesh, u));
  std::vector<CurvatureField> fields;
  for (const BallDefinition ball : kBalls) {
    for (CurvatureField& f :
         curvatures_in_balls(balls, mesh.vertices, u, {{kRadii[0] * unit, kRadii[1] * unit}, 1, ball})) {
      fields.push_back(std::move(f));
    }
  }
  for (const VertexLimit limit : {VertexLimit::Star, VertexLimit::Limit}) {
    fields.push_back(curvatures_at_vertices(balls, u, limit));
  }
  return fields;
}

/// Compares curvatures after multiplying those of `b` by `scale` (and its square); 1/length is relative to `size`.
void expect_same(const std::vector<CurvatureField>& a, const std::vector<CurvatureField>& b, double scale, double sign,
                 double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t f = 0; f < a.size(); ++f) {
    ASSERT_EQ(a[f].samples.size(), b[f].samples.size());
    for (std::size_t i = 0; i < a[f].samples.size(); ++i) {
      const Curvatures &p = a[f].samples[i].k, &q = b[f].samples[i].k;
      ASSERT_EQ(p.status, q.status);
      ASSERT_EQ(a[f].samples[i].face_count, b[f].samples[i].face_count);
      const double size = std::max(std::abs(p.k_min), std::abs(p.k_max));
      EXPECT_NEAR(p.mean, sign * scale * q.mean, tolerance * size);
      EXPECT_NEAR(p.gaussian, scale * scale * q.gaussian, tolerance * size * size);
      EXPECT_NEAR(p.k_min, scale * (sign > 0 ? q.k_min : -q.k_max), tolerance * size);
      EXPECT_NEAR(p.k_max, scale * (sign > 0 ? q.k_max : -q.k_min), tolerance * size);
    }
  }
}

TEST(Invariance, ReversedFacesChangeNoCurvature) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  const auto a = all_fields(s.mesh, s.normals), b = all_fields(shapes::reversed(s.mesh), s.normals);
  expect_same(a, b, 1, 1, 1e-12);
  EXPECT_NEAR(a[0].samples[7].mu0, -b[0].samples[7].mu0, 1e-12) << "the measures do change sign";
  EXPECT_GT(a[0].samples[7].mu0, 0);
}

TEST(Invariance, FlippedNormalsFlipMeanAndPrincipalCurvatures) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  expect_same(all_fields(s.mesh, s.normals), all_fields(s.mesh, flipped(s.normals)), 1, -1, 1e-12);
}

TEST(Invariance, SignsOfATorus) {
  const Shape s = shapes::torus(3, 1, 40, 24);
  for (const CurvatureField& f : all_fields(s.mesh, s.normals)) {
    EXPECT_GT(f.samples[0].k.gaussian, 0) << "outer equator";
    EXPECT_LT(f.samples[12].k.gaussian, 0) << "inner equator";
    EXPECT_GT(f.samples[0].k.mean, 0.5);
    EXPECT_NEAR(std::abs(f.samples[0].k.dir_max.z()), 1, 1e-2) << "the small circle bends most";
  }
}

TEST(Invariance, Scaling) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  const auto expected = all_fields(s.mesh, s.normals);
  for (const double unit : {1e-6, 1e6}) {
    Mesh scaled = s.mesh;
    for (Vec3& x : scaled.vertices) x *= unit;
    const auto got = all_fields(scaled, s.normals, unit);
    expect_same(expected, got, unit, 1, 1e-9);
    EXPECT_NEAR(got[0].samples[3].mu0 / (unit * unit), expected[0].samples[3].mu0, 1e-9 * expected[0].samples[3].area);
    EXPECT_NEAR(got[0].samples[3].coverage, expected[0].samples[3].coverage, 1e-9);
  }
}

TEST(Invariance, RigidMotion) {
  const Shape s = shapes::torus(3, 1, 24, 16);
  Shape moved = s;
  const Mat3 r = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  for (std::size_t i = 0; i < s.normals.size(); ++i) {
    moved.mesh.vertices[i] = r * s.mesh.vertices[i] + Vec3(3, -8, 2);
    moved.normals[i] = r * s.normals[i];
  }
  expect_same(all_fields(s.mesh, s.normals), all_fields(moved.mesh, moved.normals), 1, 1, 1e-11);
}

/// Coordinates as a file at UTM magnitudes has them: rounded there, then moved to the local origin.
TEST(Invariance, GeoreferencedCoordinates) {
  const Shape s = shapes::torus(300, 100, 24, 16);
  Scan scan;
  const Vec3 utm(500000, 5400000, 100);
  for (const Vec3& x : s.mesh.vertices) scan.points.emplace_back(x + utm);
  scan.faces = s.mesh.faces;
  move_to_local_origin(scan);
  const Mesh far = mesh_of(scan);
  EXPECT_GT(far.origin.y(), 5e6);
  expect_same(all_fields(s.mesh, s.normals, 100), all_fields(far, s.normals, 100), 1, 1, 1e-8);
}

TEST(EstimateCurvatures, AreaCoverageAndMeasuresOfAPlane) {
  const Shape s = shapes::square(21);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const std::vector<Vec3> centres = {Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0), Vec3(0, 0, 0), Vec3(0.5, 0.5, 0.06)};
  const Normals up(4, Vec3::UnitZ());
  for (const BallDefinition ball : kBalls) {
    const CurvatureField f = curvatures_in_balls(balls, centres, up, {{0.1}, 1, ball})[0];
    EXPECT_EQ(f.radius, 0.1);
    const std::array<double, 4> coverage = {1, 0.5, 0.25, 0.64};
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(f.samples[i].coverage, coverage[i], 1e-12);
      EXPECT_NEAR(f.samples[i].area, coverage[i] * kPi * 0.01, 1e-13);
      EXPECT_NEAR(f.samples[i].mu0, f.samples[i].area, 1e-13);
      EXPECT_NEAR(f.samples[i].mu1, 0, 1e-15);
      EXPECT_NEAR(f.samples[i].mu2, 0, 1e-15);
      EXPECT_EQ(f.samples[i].k.status, PointStatus::Valid);
      EXPECT_NEAR(f.samples[i].k.k_max, 0, 1e-13);
    }
  }
}

void expect_nan(const CurvatureSample& s, PointStatus status) {
  EXPECT_EQ(s.k.status, status);
  for (const double v : {s.k.mean, s.k.gaussian, s.k.k_min, s.k.k_max, s.k.dir_min.x(), s.k.dir_max.z()}) {
    EXPECT_TRUE(std::isnan(v)) << v;
  }
}

TEST(EstimateCurvatures, StatusesGiveNaN) {
  const Shape s = shapes::square(5);
  Mesh mesh = s.mesh;
  Normals u = s.normals;
  // A separate face whose normals lie in its plane: mu0 vanishes.
  const Index n = static_cast<Index>(mesh.vertices.size());
  for (const Vec3& x : {Vec3(10, 0, 0), Vec3(11, 0, 0), Vec3(10, 1, 0)}) {
    mesh.vertices.push_back(x);
    u.push_back(Vec3::UnitX());
  }
  mesh.faces.add(n, n + 1, n + 2);
  const BruteForceBallSum balls(triangles_of(mesh, u));
  const std::vector<Vec3> centres = {Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 9), Vec3(10.2, 0.2, 0),
                                     Vec3(kNaN, 0, 0),  Vec3(0.5, 0.5, 0), Vec3(0.5, 0.5, 0)};
  const Normals at = {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitZ(), Vec3::Zero(), Vec3(0, kNaN, 1)};
  for (const BallDefinition ball : kBalls) {
    const CurvatureField f = curvatures_in_balls(balls, centres, at, {{0.3}, 1, ball})[0];
    EXPECT_EQ(f.samples[0].k.status, PointStatus::Valid);
    expect_nan(f.samples[1], PointStatus::Empty);
    EXPECT_EQ(f.samples[1].face_count, 0U);
    expect_nan(f.samples[2], PointStatus::Degenerate);
    EXPECT_EQ(f.samples[2].face_count, 1U);
    EXPECT_GT(f.samples[2].area, 0.01);
    for (const std::size_t i : {3, 4, 5}) expect_nan(f.samples[i], PointStatus::Invalid);
    EXPECT_TRUE(std::isnan(f.samples[3].mu0));
  }
}

TEST(EstimateAtVertices, StatusesGiveNaN) {
  Shape s = shapes::square(5);
  s.mesh.vertices.emplace_back(7, 7, 7);  // isolated
  s.normals.push_back(Vec3::UnitZ());
  s.normals[12] = Vec3::Zero();
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const VertexLimit limit : {VertexLimit::Star, VertexLimit::Limit}) {
    const CurvatureField f = curvatures_at_vertices(balls, s.normals, limit);
    EXPECT_EQ(f.radius, 0);
    ASSERT_EQ(f.samples.size(), s.normals.size());
    EXPECT_EQ(f.samples[0].k.status, PointStatus::Valid);
    EXPECT_TRUE(std::isnan(f.samples[0].coverage));
    expect_nan(f.samples[12], PointStatus::Invalid);
    expect_nan(f.samples[25], PointStatus::Empty);
  }
}

/// An irregular fan with weights: star and limit differ.
Shape weighted_fan() {
  Shape s;
  s.mesh = shapes::fan(6, 3);
  s.mesh.weights = {1, 2, 0.5, 1, 1, 3};
  for (const Vec3& x : s.mesh.vertices) s.normals.push_back((x + Vec3(0.1, 0, 1)).normalized());
  return s;
}

void expect_curvatures(const Curvatures& a, const Curvatures& b, double tolerance) {
  EXPECT_NEAR(a.mean, b.mean, tolerance);
  EXPECT_NEAR(a.gaussian, b.gaussian, tolerance);
  EXPECT_NEAR(a.k_min, b.k_min, tolerance);
  EXPECT_NEAR(a.k_max, b.k_max, tolerance);
}

TEST(EstimateAtVertices, StarAndLimitByHand) {
  const Shape s = weighted_fan();
  MeasureSum star, limit;
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const Faces::View v = s.mesh.faces[f];
    const std::array<Vec3, 3> x = {s.mesh.vertices[v[0]], s.mesh.vertices[v[1]], s.mesh.vertices[v[2]]};
    MeasureSum m = compact(triangle_measures(x, {s.normals[v[0]], s.normals[v[1]], s.normals[v[2]]}));
    m *= s.mesh.weight(f);
    star += m;
    const Vec3 a = x[1] - x[0], b = x[2] - x[0];
    m *= std::acos(a.dot(b) / (a.norm() * b.norm())) / (a.cross(b).norm() / 2);
    limit += m;
  }
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const Vec3& u = s.normals[0];
  expect_curvatures(curvatures_at_vertices(balls, s.normals, VertexLimit::Star).samples[0].k, curvatures(star, u),
                    1e-13);
  expect_curvatures(curvatures_at_vertices(balls, s.normals, VertexLimit::Limit).samples[0].k, curvatures(limit, u),
                    1e-13);
  EXPECT_GT(std::abs(curvatures(star, u).mean - curvatures(limit, u).mean), 1e-3) << "the fan cannot tell them apart";
}

TEST(EstimateAtVertices, LimitIsThatOfSmallBalls) {
  const Shape s = weighted_fan();
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const CurvatureField small =
      curvatures_in_balls(balls, {s.mesh.vertices[0]}, {s.normals[0]}, {{1e-3}, 1, BallDefinition::AreaFraction})[0];
  expect_curvatures(curvatures_at_vertices(balls, s.normals, VertexLimit::Limit).samples[0].k, small.samples[0].k,
                    1e-9);
}

TEST(EstimateCurvatures, SurvivesTheZoo) {
  for (const shapes::Specimen& s : shapes::zoo()) {
    for (const NormalWeights w : {NormalWeights::Uniform, NormalWeights::Max}) {
      const Normals u = vertex_normals(s.mesh, w);
      for (const CurvatureField& f : all_fields(s.mesh, u)) {
        for (std::size_t i = 0; i < f.samples.size(); ++i) {
          const Curvatures& k = f.samples[i].k;
          const bool lost = !s.mesh.vertices[i].allFinite() || u[i].isZero(0);
          EXPECT_TRUE(!lost || k.status == PointStatus::Invalid) << s.name << ' ' << i;
          const bool valid = k.status == PointStatus::Valid;
          EXPECT_EQ(valid, std::isfinite(k.mean)) << s.name << ' ' << i;
          EXPECT_EQ(valid, std::isfinite(k.k_max)) << s.name << ' ' << i;
          EXPECT_TRUE(!valid || k.k_min <= k.k_max) << s.name << ' ' << i;
          const bool empty = f.samples[i].face_count == 0 && !lost;
          EXPECT_TRUE(!empty || k.status == PointStatus::Empty) << s.name << ' ' << i;
        }
      }
    }
  }
}

TEST(EstimateCurvatures, Refuses) {
  const Shape s = shapes::sphere(1, 1);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const auto call = [&](const Normals& u, const std::vector<double>& radii) {
    return curvatures_in_balls(balls, s.mesh.vertices, u, {radii});
  };
  EXPECT_THROW(call(Normals(2, Vec3::UnitX()), {1}), Error);
  for (const double radius : {0.0, -0.5, kNaN, HUGE_VAL}) EXPECT_THROW(call(s.normals, {radius}), Error) << radius;
  CurvatureOptions options;
  EXPECT_NO_THROW(validate(options));
  for (const std::vector<double>& radii : {std::vector<double>{}, {-1.0}, {0.5, kNaN}, {HUGE_VAL}}) {
    options.radii = radii;
    EXPECT_THROW(validate(options), Error);
  }
}

TEST(MarkBorders, TakesAwayWhatIsMeasuredBesideItsCentre) {
  const Shape square = shapes::square(21);
  const Mesh& mesh = square.mesh;
  CurvatureOptions options;
  options.radii = {0.15};  // three edges
  CurvatureField field = estimate_curvatures(mesh, square.normals, options)[0];
  const CurvatureField before = field;
  mark_borders(field, 0.99);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    const CurvatureSample& s = field.samples[i];
    const Vec3& x = mesh.vertices[i];
    const double to_border = std::min({x.x(), x.y(), 1 - x.x(), 1 - x.y()});
    inside += to_border > 0.14;
    EXPECT_EQ(s.k.status, to_border > 0.14 ? PointStatus::Valid : PointStatus::Border) << to_border;
    EXPECT_EQ(std::isnan(s.k.mean), s.k.status == PointStatus::Border);
    EXPECT_EQ(s.coverage, before.samples[i].coverage);
    EXPECT_EQ(s.mu0, before.samples[i].mu0);
  }
  EXPECT_EQ(inside, 225u);
  EXPECT_EQ(summarise(field).border, 441u - summarise(field).valid);
  EXPECT_THROW(mark_borders(field, 1.5), Error);
  EXPECT_THROW(mark_borders(field, kNaN), Error);
  field.radius = 0;
  EXPECT_THROW(mark_borders(field, 0.5), Error);
}

TEST(Summarise, CountsAndPercentiles) {
  CurvatureField f;
  for (int i = 0; i <= 100; ++i) {
    CurvatureSample s;
    s.k.status = PointStatus::Valid;
    s.k.mean = 100 - i;
    s.k.gaussian = s.k.k_min = s.k.k_max = 1;
    f.samples.push_back(s);
  }
  for (const PointStatus status : {PointStatus::Empty, PointStatus::Empty, PointStatus::Degenerate}) {
    CurvatureSample s;
    s.k.status = status;
    f.samples.push_back(s);
  }
  const FieldSummary summary = summarise(f);
  EXPECT_EQ(summary.valid, 101U);
  EXPECT_EQ(summary.empty, 2U);
  EXPECT_EQ(summary.degenerate, 1U);
  EXPECT_EQ(summary.invalid, 0U);
  EXPECT_NEAR(summary.mean.p1, 1, 1);
  EXPECT_NEAR(summary.mean.p50, 50, 0.6);
  EXPECT_NEAR(summary.mean.p99, 99, 1);
  EXPECT_EQ(summary.k_max.p50, 1);
  EXPECT_TRUE(std::isnan(summarise(CurvatureField{}).mean.p50));
}

}  // namespace
}  // namespace kappa
