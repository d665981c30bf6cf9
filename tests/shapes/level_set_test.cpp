// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/implicit.hpp"

namespace kappa {
namespace {

using test::mesh_facts;
using test::MeshFacts;

ImplicitJet sphere_function(const Vec3& x, const Vec3& centre, double radius) {
  return {(x - centre).squaredNorm() - radius * radius, 2 * (x - centre), 2 * Mat3::Identity()};
}

LevelSetOptions box_of(double half, double step, Extraction extraction) {
  LevelSetOptions options;
  options.box.min = Vec3(-half, -half * 1.013, -half * 1.007);
  options.box.max = Vec3::Constant(half);
  options.step = step;
  options.extraction = extraction;
  return options;
}

class EveryExtraction : public testing::TestWithParam<Extraction> {};
INSTANTIATE_TEST_SUITE_P(LevelSet, EveryExtraction,
                         testing::Values(Extraction::MarchingCubes, Extraction::SurfaceNets));

TEST_P(EveryExtraction, GoursatIsClosedAndTrue) {
  const auto normals = test::normal_field([](const Vec3& x) { return Vec3(12 * x.array().cube() - 400 * x.array()); });
  for (const double step : {2.0, 1.0, 0.5}) {
    const Scan scan = goursat({step, GetParam()});
    test::expect_complete(scan);
    for (const auto& x : scan.points) {
      const double value = 3 * x.array().pow(4).sum() - 200 * x.squaredNorm() - 800;
      const double slope = Vec3(12 * x.array().cube() - 400 * x.array()).norm();
      ASSERT_NEAR(value / slope, 0, 1e-13) << "distance to the surface at step " << step;
    }
    test::expect_truth(scan, normals, 2e-3, 1, 1e-9);
    const MeshFacts facts = mesh_facts(scan);
    EXPECT_EQ(facts.border_edges, 0U) << step;
    EXPECT_EQ(facts.repeated_edges, 0U) << step;
    EXPECT_EQ(facts.euler, 2) << step;
    EXPECT_LT(facts.area_vector.norm(), 1e-10);
    EXPECT_GT(facts.volume, 0);
    if (step < 2) test::expect_faces_follow_normals(scan);
  }
}

TEST_P(EveryExtraction, GoursatIsConvexAtItsCornersAndConcaveOnItsSides) {
  const Scan scan = goursat({0.5, GetParam()});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3 x = scan.points[i].cwiseAbs();
    if (x.minCoeff() > 0.97 * x.maxCoeff()) {
      ASSERT_GT(test::values(scan, "k_min")[i], 0);
    }
    if (x.norm() < 8.5) {
      ASSERT_LT(test::values(scan, "k_max")[i], 0);
    }
  }
}

// Both extractions approximate one surface: their volumes meet at the rate h^2.
TEST(Goursat, VolumesConverge) {
  const auto gap = [](double step) {
    return std::abs(mesh_facts(goursat({step, Extraction::MarchingCubes})).volume -
                    mesh_facts(goursat({step, Extraction::SurfaceNets})).volume);
  };
  EXPECT_LT(gap(1.0), 15);
  EXPECT_LT(gap(0.25), gap(1.0) / 8);
}

TEST(Goursat, HasAVertexOnEachCrossedGridEdge) {
  // Marching cubes of a surface of area A have about 1.5 A / h^2 vertices for any orientation of it.
  const MeshFacts facts = mesh_facts(goursat({0.25, Extraction::MarchingCubes}));
  const double vertices = static_cast<double>(goursat({0.25, Extraction::MarchingCubes}).points.size());
  EXPECT_NEAR(vertices * 0.25 * 0.25 / facts.area, 1.4, 0.3);
}

TEST_P(EveryExtraction, SphereHasItsVolume) {
  const ImplicitFunction f = [](const Vec3& x) { return sphere_function(x, Vec3(0.01, 0.02, 0.03), 1); };
  const MeshFacts facts = mesh_facts(level_set(f, box_of(1.3, 0.05, GetParam())));
  EXPECT_NEAR(facts.volume, 4 * kPi / 3, 0.005 * 4);
  EXPECT_EQ(facts.euler, 2);
}

TEST_P(EveryExtraction, SurfaceThatLeavesTheBoxHasABorder) {
  const ImplicitFunction f = [](const Vec3& x) { return sphere_function(x, Vec3::Zero(), 1); };
  LevelSetOptions options = box_of(1.3, 0.1, GetParam());
  options.box.max.z() = 0.4;
  const MeshFacts facts = mesh_facts(level_set(f, options));
  EXPECT_GT(facts.border_edges, 0U);
  EXPECT_EQ(facts.euler, 1);
}

// Sheets much closer than the grid: ambiguous faces of every kind, and still no crack.
TEST(MarchingCubes, LeaveNoCrackOnCoarseGrids) {
  const ImplicitFunction wild = [](const Vec3& x) {
    const double wave = std::sin(7.3 * x.x() + 1) * std::sin(8.9 * x.y() + 2) * std::sin(6.1 * x.z() + 3);
    return ImplicitJet{x.norm() < 1.9 ? wave : 1.0, Vec3::Ones(), Mat3::Zero()};
  };
  const Scan scan = level_set(wild, box_of(2.5, 0.31, Extraction::MarchingCubes));
  std::map<std::pair<Index, Index>, int> balance;
  for (std::size_t face = 0; face < scan.faces.size(); ++face) {
    const auto corners = scan.faces[face];
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = corners[c], b = corners[(c + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  EXPECT_GT(scan.faces.size(), 1000U);
  for (const auto& [edge, sum] : balance) ASSERT_EQ(sum, 0) << "edge " << edge.first << " " << edge.second;
}

TEST(LevelSet, ProjectionFindsTheSurfaceOrSaysSo) {
  const ImplicitFunction f = [](const Vec3& x) { return sphere_function(x, Vec3::Zero(), 2); };
  const Vec3 start(0.3, -1.1, 0.8);
  const Vec3 x = project_to_surface(f, start, 1e-14);
  EXPECT_LT((x - 2 * start.normalized()).norm(), 1e-14 * 10);
  EXPECT_TRUE(std::isnan(project_to_surface(f, Vec3::Zero(), 1e-14).x()));
}

TEST(LevelSet, SaysWhatIsWrong) {
  const ImplicitFunction positive = [](const Vec3&) { return ImplicitJet{1, Vec3::UnitX(), Mat3::Zero()}; };
  try {
    level_set(positive, box_of(1, 0.5, Extraction::MarchingCubes));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidData);
  }
  EXPECT_THROW(level_set(positive, box_of(1, 0, Extraction::MarchingCubes)), Error);
  EXPECT_THROW(level_set(positive, box_of(1, 1e-5, Extraction::MarchingCubes)), Error);
  EXPECT_THROW(level_set(positive, LevelSetOptions()), Error);
}

}  // namespace
}  // namespace kappa
