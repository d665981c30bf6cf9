// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/normals.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/mesh/topology.hpp"
#include "support/expect_names.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

constexpr std::array<NormalWeights, 4> kAll = {NormalWeights::Uniform, NormalWeights::Area, NormalWeights::Angle,
                                               NormalWeights::Max};

TEST(NormalWeights, HaveTheWordsOfTheCommandLine) {
  test::expect_names<NormalWeights>({"geometric", "area", "angle", "max"});
}

TEST(VertexNormals, MaxIsExactOnSpheres) {
  shapes::Shape s = shapes::sphere(2.5, 3);
  // Slide the vertices along the sphere: irregular triangles, still inscribed.
  for (Vec3& x : s.mesh.vertices) {
    x = 2.5 * (x + 0.12 * Vec3(std::sin(7 * x.y()), std::cos(9 * x.z()), std::sin(8 * x.x()))).normalized();
  }
  const Normals u = vertex_normals(s.mesh, NormalWeights::Max), plain = vertex_normals(s.mesh, NormalWeights::Uniform);
  double worst = 0, worst_plain = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    worst = std::max(worst, (u[i] - s.mesh.vertices[i] / 2.5).norm());
    worst_plain = std::max(worst_plain, (plain[i] - s.mesh.vertices[i] / 2.5).norm());
  }
  EXPECT_LT(worst, 1e-13);
  EXPECT_GT(worst_plain, 1e-3) << "the mesh is too regular to tell the weights apart";
}

/// The weights from their definitions, for the centre of a fan of triangles.
Vec3 by_hand(const Mesh& mesh, NormalWeights weights) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 a = mesh.vertices[mesh.faces[f][1]] - mesh.vertices[0];
    const Vec3 b = mesh.vertices[mesh.faces[f][2]] - mesh.vertices[0];
    const Vec3 n = a.cross(b).normalized();
    double w = 1;
    if (weights == NormalWeights::Area) w = a.cross(b).norm() / 2;
    if (weights == NormalWeights::Angle) w = std::acos(a.dot(b) / (a.norm() * b.norm()));
    if (weights == NormalWeights::Max) w = a.cross(b).norm() / (a.squaredNorm() * b.squaredNorm());
    sum += w * mesh.weight(f) * n;
  }
  return sum.normalized();
}

TEST(VertexNormals, WeightsByHand) {
  Mesh mesh = shapes::fan(7, 5);
  Vec3 before = Vec3::Zero();
  for (const NormalWeights weights : kAll) {
    mesh.weights.clear();
    const Vec3 plain = vertex_normals(mesh, weights)[0];
    EXPECT_NEAR((plain - by_hand(mesh, weights)).norm(), 0, 1e-14);
    EXPECT_GT((plain - before).norm(), 1e-4) << "two weights give the same";
    mesh.weights = {1, 2, 3, 0.5, 1, 7, 0.25};
    EXPECT_NEAR((vertex_normals(mesh, weights)[0] - by_hand(mesh, weights)).norm(), 0, 1e-14) << "face weights";
    before = plain;
  }
}

TEST(VertexNormals, OfAPolygon) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1, 2, 0), Vec3(0, 1, 0)};
  mesh.faces.add({0, 1, 2, 3, 4});
  EXPECT_NEAR((polygon_vector_area(mesh, 0) - Vec3(0, 0, 3)).norm(), 0, 1e-15);
  for (const NormalWeights weights : kAll) {
    for (const Vec3& u : vertex_normals(mesh, weights)) EXPECT_NEAR((u - Vec3::UnitZ()).norm(), 0, 1e-15);
  }
}

TEST(VertexNormals, ZeroAreaFacesDoNotVote) {
  Mesh mesh = shapes::fan(5, 6);
  for (const NormalWeights weights : kAll) {
    const Normals clean = vertex_normals(mesh, weights);
    Mesh dirty = mesh;
    dirty.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
    dirty.vertices.push_back(mesh.vertices[0]);
    dirty.faces.add(0, 6, 6);
    dirty.faces.add(0, 0, 2);
    dirty.faces.add(0, 7, 3);
    const Normals u = vertex_normals(dirty, weights);
    for (std::size_t i = 0; i < clean.size(); ++i) EXPECT_EQ(u[i], clean[i]) << i;
    EXPECT_EQ(u[6], Vec3::Zero().eval()) << "only faces of zero area";
  }
}

TEST(VertexNormals, ZeroWhereNothingOrNoAgreement) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(5, 5, 5), Vec3(kNaN, 0, 0)};
  mesh.faces.add(0, 1, 2);
  mesh.faces.add(0, 2, 1);
  mesh.faces.add(0, 1, 4);
  for (const NormalWeights weights : kAll) {
    for (const Vec3& u : vertex_normals(mesh, weights)) EXPECT_EQ(u, Vec3::Zero().eval());
  }
}

/// Opposite faces written from another corner: their vector areas cancel but for rounding, which has no direction.
TEST(VertexNormals, ZeroWhereVotesCancelButForRounding) {
  Mesh mesh;
  mesh.vertices = {Vec3(0.1, 0.7, 0.3), Vec3(1.3, 0.2, -0.1), Vec3(0.4, 1.9, 0.6)};
  mesh.faces.add(0, 1, 2);
  mesh.faces.add(2, 1, 0);
  mesh.faces.add(1, 2, 0);
  mesh.faces.add(1, 0, 2);
  ASSERT_NE(polygon_vector_area(mesh, 0), Vec3(-polygon_vector_area(mesh, 1))) << "nothing is left to be refused";
  for (const NormalWeights weights : kAll) {
    for (const Vec3& u : vertex_normals(mesh, weights)) EXPECT_EQ(u, Vec3::Zero().eval());
  }
}

TEST(VertexNormals, AnyUnitAndAnyThreads) {
  const shapes::Shape s = shapes::torus(3, 1, 20, 13);
  Execution run;
  for (const NormalWeights weights : kAll) {
    const Normals u = vertex_normals(s.mesh, weights);
    for (const double unit : {0x1p-70, 0x1p70}) {  // the fourth power of a length leaves the range of float, not ours
      Mesh other = s.mesh;
      for (Vec3& x : other.vertices) x *= unit;
      const Normals v = vertex_normals(other, weights);
      for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR((u[i] - v[i]).norm(), 0, 1e-14) << unit;
    }
    for (const int threads : {2, 3}) {
      run.threads = threads;
      EXPECT_EQ(vertex_normals(s.mesh, weights, run), u);
    }
  }
}

Normals jacobi(const Mesh& mesh, const Normals& u, int passes) {
  Normals now = u;
  for (int pass = 0; pass < passes; ++pass) {
    Normals next = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (!now[i].allFinite() || now[i].isZero(0)) continue;
      std::vector<bool> near(now.size(), false);
      for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Faces::View v = mesh.faces[f];
        for (std::size_t c = 0; c < v.size(); ++c) {
          const Index a = v[c], b = v[(c + 1) % v.size()];
          if (a == i) near[b] = true;
          if (b == i) near[a] = true;
        }
      }
      near[i] = false;
      Vec3 sum = now[i];
      for (std::size_t j = 0; j < now.size(); ++j) {
        if (near[j] && now[j].allFinite()) sum += now[j];
      }
      next[i] = sum.normalized();
    }
    now = next;
  }
  return now;
}

TEST(AverageNormals, JacobiByHand) {
  shapes::Shape s = shapes::torus(3, 1, 9, 7);
  for (std::size_t i = 0; i < s.normals.size(); ++i) {
    const double a = static_cast<double>(i);
    s.normals[i] = (s.normals[i] + 0.4 * Vec3(std::sin(3 * a), std::cos(5 * a), std::sin(7 * a))).normalized();
  }
  EXPECT_EQ(average_normals(s.mesh, s.normals, 0), s.normals);
  Execution run;
  for (const int passes : {1, 4}) {
    const Normals expected = jacobi(s.mesh, s.normals, passes);
    const Normals got = average_normals(s.mesh, s.normals, passes);
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR((got[i] - expected[i]).norm(), 0, 1e-14);
    run.threads = 3;
    EXPECT_EQ(average_normals(s.mesh, s.normals, passes, run), got);
  }
}

TEST(AverageNormals, ZeroAndNaNStayAndDoNotSpread) {
  shapes::Shape s = shapes::torus(3, 1, 9, 7);
  s.normals[10] = Vec3(kNaN, 0, 1);
  s.normals[20] = Vec3::Zero();
  s.normals[30] = Vec3(HUGE_VAL, 0, 0);
  const Normals got = average_normals(s.mesh, s.normals, 5), expected = jacobi(s.mesh, s.normals, 5);
  EXPECT_TRUE(std::isnan(got[10].x()));
  EXPECT_EQ(got[20], Vec3::Zero().eval());
  EXPECT_EQ(got[30].x(), HUGE_VAL);
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (i == 10 || i == 20 || i == 30) continue;
    EXPECT_NEAR((got[i] - expected[i]).norm(), 0, 1e-14) << i;
  }
}

TEST(AverageNormals, ANormalThatItsNeighboursCancelStays) {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.faces.add(0, 1, 2);
  Normals normals;
  for (int i = 0; i < 3; ++i) normals.emplace_back(std::cos(2 * kPi * i / 3), std::sin(2 * kPi * i / 3), 0);
  ASSERT_NE(normals[0] + normals[1] + normals[2], Vec3::Zero().eval());
  EXPECT_EQ(average_normals(mesh, normals, 3), normals);
}

TEST(AverageNormals, Refuses) {
  const shapes::Shape s = shapes::torus(3, 1, 9, 7);
  EXPECT_THROW(average_normals(s.mesh, s.normals, -1), Error);
  EXPECT_THROW(average_normals(s.mesh, Normals(3, Vec3::UnitZ()), 1), Error);
  Mesh bad = s.mesh;
  bad.faces.add(0, 1, 4000);
  EXPECT_THROW(average_normals(bad, s.normals, 1), Error);
}

TEST(NormalLists, NormalisedAndFlipped) {
  const Normals u = {Vec3(0, 3, 4), Vec3::Zero(), Vec3(kNaN, 1, 0), Vec3(1e-200, 0, 0), Vec3(0, -1e200, 0)};
  const Normals n = normalised(u);
  EXPECT_NEAR((n[0] - Vec3(0, 0.6, 0.8)).norm(), 0, 1e-15);
  EXPECT_EQ(n[1], Vec3::Zero().eval());
  EXPECT_EQ(n[2], Vec3::Zero().eval());
  EXPECT_NEAR((n[3] - Vec3::UnitX()).norm(), 0, 1e-15);
  EXPECT_NEAR((n[4] + Vec3::UnitY()).norm(), 0, 1e-15);
  EXPECT_EQ(flipped(u)[0], Vec3(0, -3, -4));
}

}  // namespace
}  // namespace kappa
