// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/grid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "clouds.hpp"
#include "kappa/curvature/estimate.hpp"

namespace kappa {
namespace {

const Vec3 kEye(10, 20, 30);
const Vec3 kCentre = kEye + Vec3(0, 0, 5);  ///< of the sphere, radius 1
constexpr double kWall = 8;                 ///< distance of the plane behind it
constexpr std::size_t kWidth = 160, kHeight = 120;

/// The range image of a sphere in front of a plane, as a camera at kEye that looks along z sees them.
struct Picture {
  std::vector<Vec3> points;
  std::vector<bool> on_sphere;
};

Picture sphere_in_front_of_plane() {
  Picture picture;
  for (std::size_t j = 0; j < kHeight; ++j) {
    for (std::size_t i = 0; i < kWidth; ++i) {
      const Vec3 ray = Vec3(0.005 * (static_cast<double>(i) - 79.5), 0.005 * (static_cast<double>(j) - 59.5), 1);
      const Vec3 d = ray.normalized();
      const double along = d.dot(kCentre - kEye), off_sq = (kCentre - kEye).squaredNorm() - along * along;
      picture.on_sphere.push_back(off_sq < 1);
      picture.points.emplace_back(off_sq < 1 ? Vec3(kEye + (along - std::sqrt(1 - off_sq)) * d)
                                             : Vec3(kEye + kWall * ray));
    }
  }
  return picture;
}

/// A plane seen straight on, one point a unit.
std::vector<Vec3> flat(std::size_t width, std::size_t height) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < width * height; ++i)
    points.emplace_back(static_cast<double>(i % width), static_cast<double>(i / width), 0);
  return points;
}

GridSurface from_above(const std::vector<Vec3>& points, std::size_t width, const GridOptions& options = {}) {
  return grid_surface(Vec3::Zero(), points, width, points.size() / width, Vec3(1, 1, 100), options);
}

double total_area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) sum += 0.5 * clouds::area_vector(mesh, f).norm();
  return sum;
}

TEST(GridSurface, CutsBetweenSphereAndPlaneAndLooksAtTheScanner) {
  const Picture picture = sphere_in_front_of_plane();
  const GridSurface s = grid_surface(Vec3(1, 2, 3), picture.points, kWidth, kHeight, kEye, {});
  const Mesh& mesh = s.surface.mesh;
  EXPECT_EQ(mesh.origin, Vec3(1, 2, 3));
  EXPECT_EQ(mesh.vertices, picture.points);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    EXPECT_EQ(picture.on_sphere[face[0]], picture.on_sphere[face[1]]);
    EXPECT_EQ(picture.on_sphere[face[0]], picture.on_sphere[face[2]]);
    EXPECT_GT(clouds::area_vector(mesh, f).dot(kEye - mesh.vertices[face[0]]), 0);
  }
  EXPECT_GT(s.cuts.depth_jumps, 100u);
  EXPECT_EQ(mesh.faces.size() + s.cuts.depth_jumps + s.cuts.grazing + s.cuts.degenerate,
            2 * (kWidth - 1) * (kHeight - 1));
}

TEST(GridSurface, CurvatureOfTheSphereInThePicture) {
  const Picture picture = sphere_in_front_of_plane();
  const Mesh mesh = grid_surface(Vec3::Zero(), picture.points, kWidth, kHeight, kEye, {}).surface.mesh;
  Normals u;
  for (std::size_t i = 0; i < picture.points.size(); ++i)
    u.push_back(picture.on_sphere[i] ? Vec3((picture.points[i] - kCentre).normalized()) : Vec3(-Vec3::UnitZ()));
  CurvatureOptions options;
  options.radii = {0.2};
  const CurvatureField field = estimate_curvatures(mesh, u, options).front();
  std::size_t checked = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (field.samples[i].k.status != PointStatus::Valid) continue;
    EXPECT_NEAR(field.samples[i].k.mean, picture.on_sphere[i] ? 1.0 : 0.0, 1e-9);
    ++checked;
  }
  EXPECT_GT(checked, u.size() - 400);
}

TEST(GridSurface, CoversEveryCellOnce) {
  const GridSurface s = from_above(flat(30, 20), 30);
  EXPECT_NEAR(total_area(s.surface.mesh), 29 * 19, 1e-9);
  EXPECT_EQ(s.surface.mesh.faces.size(), 2u * 29 * 19);
  EXPECT_EQ(s.surface.starless_points, 0u);
  std::set<std::pair<Index, Index>> edges;
  for (std::size_t f = 0; f < s.surface.mesh.faces.size(); ++f) {
    const auto face = s.surface.mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(edges.emplace(face[i], face[(i + 1) % 3]).second) << "an edge is run through twice";
  }
}

TEST(GridSurface, MissingReturnsLeaveHoles) {
  std::vector<Vec3> points = flat(4, 4);
  points[5] = Vec3::Constant(kNaN);
  const GridSurface one = from_above(points, 4);
  EXPECT_NEAR(total_area(one.surface.mesh), 9 - 4 * 0.5, 1e-12);
  EXPECT_EQ(one.surface.invalid_points, 1u);
  EXPECT_EQ(one.surface.representative[5], kNoIndex);
  EXPECT_EQ(one.surface.representative[6], 6u);
  points[6] = Vec3::Constant(kNaN);
  EXPECT_NEAR(total_area(from_above(points, 4).surface.mesh), 9 - 4 * 0.5 - 2, 1e-12);
  points.assign(16, Vec3::Constant(kNaN));
  EXPECT_EQ(from_above(points, 4).surface.mesh.faces.size(), 0u);
  EXPECT_EQ(from_above(points, 4).surface.invalid_points, 16u);
}

/// One raised corner: the diagonal that does not touch it keeps the other half of the cell.
TEST(GridSurface, TheBetterDiagonalSavesATriangle) {
  for (const std::size_t raised : {0u, 1u, 2u, 3u}) {
    std::vector<Vec3> points = flat(2, 2);
    points[raised].z() = 50;
    const GridSurface s = from_above(points, 2);
    ASSERT_EQ(s.surface.mesh.faces.size(), 1u) << raised;
    for (const Index corner : s.surface.mesh.faces[0]) EXPECT_NE(corner, raised);
    EXPECT_EQ(s.cuts.depth_jumps, 1u);
    EXPECT_EQ(s.surface.starless_points, 1u);
  }
}

TEST(GridSurface, OfTwoDiagonalsTheShorter) {
  std::vector<Vec3> points = flat(2, 2);
  points[0].z() = points[3].z() = 1;
  const auto has_edge = [](const Mesh& mesh, Index a, Index b) {
    std::size_t faces = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto face = mesh.faces[f];
      const std::set<Index> corners(face.begin(), face.end());
      faces += corners.count(a) == 1 && corners.count(b) == 1;
    }
    return faces == 2;
  };
  points[1].z() = -1;
  EXPECT_TRUE(has_edge(from_above(points, 2).surface.mesh, 0, 3));
  points[1].z() = 1;
  points[3].z() = -1;
  EXPECT_TRUE(has_edge(from_above(points, 2).surface.mesh, 1, 2));
}

/// A wall tilted away by `angle` degrees from facing the scanner.
TEST(GridSurface, GrazingFacesAreCut) {
  const auto faces = [](double angle) {
    std::vector<Vec3> points = flat(5, 5);
    for (Vec3& p : points)
      p = Vec3(p.x() - 2, (p.y() - 2) * std::cos(angle * kPi / 180), (p.y() - 2) * std::sin(angle * kPi / 180));
    GridOptions options;
    options.max_incidence = 70;
    return grid_surface(Vec3::Zero(), points, 5, 5, Vec3(0, 0, 1e4), options).surface.mesh.faces.size();
  };
  EXPECT_EQ(faces(69), 32u);
  EXPECT_EQ(faces(-69), 32u);
  EXPECT_EQ(faces(71), 0u);
}

TEST(GridSurface, CoincidentReturnsMakeNoFace) {
  std::vector<Vec3> points = flat(2, 2);
  points[1] = points[0];
  const GridSurface s = from_above(points, 2);
  EXPECT_EQ(s.surface.mesh.faces.size(), 1u);
  EXPECT_EQ(s.cuts.degenerate, 1u);
  EXPECT_EQ(s.surface.representative[1], 1u);
}

TEST(GridSurface, IsTheSameForAnyNumberOfThreads) {
  const Picture picture = sphere_in_front_of_plane();
  Execution run;
  const GridSurface one = grid_surface(Vec3::Zero(), picture.points, kWidth, kHeight, kEye, {}, run);
  run.threads = 3;
  const GridSurface three = grid_surface(Vec3::Zero(), picture.points, kWidth, kHeight, kEye, {}, run);
  EXPECT_TRUE(clouds::same_faces(one.surface.mesh, three.surface.mesh));
}

TEST(GridSurface, TooSmallGridsHaveNoFace) {
  EXPECT_EQ(grid_surface(Vec3::Zero(), {}, 0, 0, kEye, {}).surface.mesh.faces.size(), 0u);
  EXPECT_EQ(grid_surface(Vec3::Zero(), {Vec3::Zero()}, 1, 1, kEye, {}).surface.starless_points, 1u);
  EXPECT_EQ(from_above(flat(5, 1), 5).surface.mesh.faces.size(), 0u);
}

TEST(GridSurface, RefusesByName) {
  const std::vector<Vec3> points = flat(3, 3);
  const auto message = [&](std::size_t width, const Vec3& eye, const GridOptions& options) {
    return clouds::refusal([&] { grid_surface(Vec3::Zero(), points, width, 3, eye, options); }).message;
  };
  EXPECT_NE(message(4, kEye, {}).find("9 points for a grid of 4 x 3"), std::string::npos);
  EXPECT_NE(message(3, Vec3::Constant(kNaN), {}).find("viewpoint is not finite"), std::string::npos);
  EXPECT_NE(message(3, kEye, {0, 80}).find("max_depth_jump = 0"), std::string::npos);
  EXPECT_NE(message(3, kEye, {0.1, 91}).find("max_incidence = 91"), std::string::npos);
}

}  // namespace
}  // namespace kappa
