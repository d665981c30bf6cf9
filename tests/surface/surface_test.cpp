// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/surface.hpp"
#include "kappa/scan/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kappa/core/error.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

Scan sphere_scan(bool faces, bool normals) {
  const shapes::Shape sphere = shapes::sphere(2, 4);
  Scan scan;
  scan.points = sphere.mesh.vertices;
  if (faces) scan.faces = sphere.mesh.faces;
  if (normals) {
    for (const Vec3& u : sphere.normals) scan.normals.push_back(3 * u);
  }
  return scan;
}

Scan hill_scan(const Vec3& origin) {
  Scan scan;
  scan.origin = origin;
  for (int i = 0; i < 900; ++i) {
    const double x = i % 30 - 15, y = i / 30 - 15;
    scan.points.emplace_back(x + 0.1 * std::sin(7.0 * i), y, 3 * std::exp(-(x * x + y * y) / 50));
  }
  return scan;
}

TEST(MakeSurface, ChoosesByWhatTheScanHas) {
  EXPECT_EQ(make_surface(sphere_scan(true, true), {}).normals, NormalsKind::Input);
  EXPECT_EQ(make_surface(sphere_scan(true, true), {}).kind, SurfaceKind::Faces);
  EXPECT_EQ(make_surface(sphere_scan(true, false), {}).normals, NormalsKind::Max);
  EXPECT_EQ(make_surface(sphere_scan(true, false), {}).orientation, Orientation::AsFaces);
  EXPECT_EQ(make_surface(sphere_scan(false, true), {}).kind, SurfaceKind::Umbrella);
  EXPECT_EQ(make_surface(sphere_scan(false, false), {}).normals, NormalsKind::Quadric);
}

TEST(MakeSurface, NormalsAreUnitAndOutwardOnASphere) {
  for (const NormalsKind kind :
       {NormalsKind::Input, NormalsKind::Geometric, NormalsKind::Area, NormalsKind::Angle, NormalsKind::Max}) {
    SurfaceOptions options;
    options.normals = kind;
    const Scan scan = sphere_scan(true, true);
    const Surface s = make_surface(scan, options);
    for (std::size_t i = 0; i < s.u.size(); ++i) {
      EXPECT_NEAR(s.u[i].norm(), 1, 1e-14);
      EXPECT_GT(s.u[i].dot(scan.points[i].normalized()), 0.999) << name(kind);
    }
  }
}

TEST(MakeSurface, FittedNormalsPointUpOrToTheScanner) {
  const Surface up = make_surface(hill_scan({500000, 5400000, 100}), {});
  EXPECT_EQ(up.orientation, Orientation::Up);
  for (const Vec3& u : up.u) EXPECT_GT(u.z(), 0.5);

  Scan seen = hill_scan(Vec3::Zero());
  seen.viewpoint = Vec3(0, 0, -20);
  const Surface down = make_surface(seen, {});
  EXPECT_EQ(down.orientation, Orientation::Viewpoint);
  for (const Vec3& u : down.u) EXPECT_LT(u.z(), -0.5);

  // (0, 0, 0) in a file of projected coordinates is no place a scanner stood at.
  Scan far = hill_scan({500000, 5400000, 100});
  far.viewpoint = Vec3::Zero();
  EXPECT_EQ(make_surface(far, {}).orientation, Orientation::Up);
  // Nor is it for a tile moved to the origin, which would have been seen from under the ground.
  Scan tile = hill_scan(Vec3::Zero());
  for (Vec3& x : tile.points) x += Vec3(15, 15, 4);
  tile.viewpoint = Vec3::Zero();
  EXPECT_EQ(make_surface(tile, {}).orientation, Orientation::Up);
  // In a depth camera's frame it is, however small the object.
  for (Vec3& x : tile.points) x += Vec3(-15, -15, 100);
  EXPECT_EQ(make_surface(tile, {}).orientation, Orientation::Viewpoint);
  SurfaceOptions options;
  options.orientation = Orientation::Viewpoint;
  options.viewpoint = Vec3(500000, 5400000, 1000);
  for (const Vec3& u : make_surface(far, options).u) EXPECT_GT(u.z(), 0.5);
}

TEST(MakeSurface, NormalsFittedToAMeshPointToTheSideOfItsFaces) {
  Scan scan = sphere_scan(true, false);
  SurfaceOptions options;
  for (const NormalsKind kind : {NormalsKind::Pca, NormalsKind::Quadric, NormalsKind::Robust}) {
    options.normals = kind;
    const Surface s = make_surface(scan, options);
    EXPECT_EQ(s.orientation, Orientation::AsFaces);
    for (std::size_t i = 0; i < s.u.size(); ++i) EXPECT_GT(s.u[i].dot(scan.points[i].normalized()), 0.99) << name(kind);
  }
  options.orientation = Orientation::Up;
  for (const Vec3& u : make_surface(scan, options).u) EXPECT_GE(u.z(), 0);
}

TEST(MakeSurface, UmbrellaOfAMeshIgnoresItsFaces) {
  SurfaceOptions options;
  options.surface = SurfaceKind::Umbrella;
  const Scan scan = sphere_scan(true, true);
  const Surface s = make_surface(scan, options);
  EXPECT_EQ(s.kind, SurfaceKind::Umbrella);
  EXPECT_FALSE(s.mesh.weights.empty());
}

TEST(MakeSurface, AScannerInARoomIsLookedAtFromAllSides) {
  Scan room;  // wide and low as terrain is, most of it above the scanner
  room.viewpoint = Vec3::Zero();
  for (int i = -20; i <= 20; ++i) {
    for (int j = -15; j <= 15; ++j) {
      room.points.emplace_back(0.5 * i, 0.5 * j, 1.7);
      if ((i + j) % 2 == 0) room.points.emplace_back(0.5 * i, 0.5 * j, -1.3);
    }
  }
  const Surface s = make_surface(room, {});
  EXPECT_EQ(s.orientation, Orientation::Viewpoint);
  for (std::size_t i = 0; i < room.points.size(); ++i) EXPECT_LT(s.u[i].z() * room.points[i].z(), 0);
  for (Vec3& x : room.points) x.z() = std::abs(x.z());  // floor and ceiling of another storey
  EXPECT_EQ(make_surface(room, {}).orientation, Orientation::Up);
}

TEST(MakeSurface, DuplicatesGetTheNormalOfThePointThatStandsForThem) {
  Scan scan = hill_scan(Vec3::Zero());
  const std::size_t n = scan.points.size();
  scan.points.insert(scan.points.end(), scan.points.begin(), scan.points.end());
  for (const int passes : {0, 3}) {
    SurfaceOptions options;
    options.averaging_passes = passes;
    const Surface s = make_surface(scan, options);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(s.u[i], s.u[i + n]);
    EXPECT_EQ(s.duplicate_points, n);
    EXPECT_EQ(s.normalless_points, 0u);
  }
}

TEST(MakeSurface, SaysWhyItChose) {
  EXPECT_EQ(make_surface(sphere_scan(true, true), {}).reason, "the file has faces");
  SurfaceOptions options;
  options.surface = SurfaceKind::Delaunay;
  const Surface s = make_surface(hill_scan(Vec3::Zero()), options);
  EXPECT_EQ(s.reason, "as asked");
  EXPECT_EQ(s.kind, SurfaceKind::Delaunay);
  EXPECT_GE(s.mesh.faces.size(), 2 * 29 * 29u);  // and along the rows that are pushed to and fro
  EXPECT_EQ(s.orientation, Orientation::Up);
}

/// Returns of a scanner at 1.8 m height above flat ground: `rings` lasers, each a full turn.
Scan sweep_scan(int rings, std::size_t missing) {
  Scan scan;
  scan.viewpoint = Vec3::Zero();
  for (int ring = 0; ring < rings; ++ring) {
    const double distance = 1.8 / std::tan((8.0 + ring) * kPi / 180);
    for (int i = 0; i < 720; ++i) {
      const double a = 2 * kPi * i / 720;
      scan.points.emplace_back(distance * std::cos(a), distance * std::sin(a), -1.8);
    }
  }
  scan.points.insert(scan.points.end(), missing, Vec3::Zero());
  return scan;
}

TEST(MakeSurface, TellsASweepByItsReturnsAtTheScanner) {
  const Surface sweep = make_surface(sweep_scan(16, 300), {});
  EXPECT_EQ(sweep.kind, SurfaceKind::Spinning);
  EXPECT_EQ(sweep.normals, NormalsKind::Area);
  EXPECT_EQ(sweep.at_sensor, 300u);
  for (std::size_t i = 0; i < 16 * 720; ++i) EXPECT_NEAR(sweep.u[i].z(), 1, 1e-9) << "flat ground, seen from above";
  Scan marked = sweep_scan(16, 300);
  for (Vec3& x : marked.points) {
    if (x.isZero(0)) x.setConstant(kNaN);
  }
  EXPECT_EQ(make_surface(marked, {}).kind, SurfaceKind::Spinning);
  EXPECT_EQ(make_surface(sweep_scan(16, 0), {}).kind, SurfaceKind::Umbrella);
}

TEST(MakeSurface, ClosedCloudsAreOrientedOutwardAndTerrainUpward) {
  const Surface closed = make_surface(sphere_scan(false, false), {});
  EXPECT_EQ(closed.orientation, Orientation::Consistent);
  const Scan sphere = sphere_scan(false, false);
  for (std::size_t i = 0; i < closed.u.size(); ++i) EXPECT_GT(closed.u[i].dot(sphere.points[i]), 0);
  EXPECT_EQ(closed.agreement.opposed, 0u);
  EXPECT_GT(closed.agreement.pairs, 0u);
}

TEST(MakeSurface, RefusesContradictionsByName) {
  const auto message = [](const Scan& scan, const SurfaceOptions& options) {
    try {
      make_surface(scan, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  SurfaceOptions options;
  options.surface = SurfaceKind::Faces;
  EXPECT_NE(message(sphere_scan(false, true), options).find("no faces"), std::string::npos);
  options = {};
  options.normals = NormalsKind::Input;
  EXPECT_NE(message(sphere_scan(true, false), options).find("no normals"), std::string::npos);
  options = {};
  options.orientation = Orientation::Viewpoint;
  EXPECT_NE(message(sphere_scan(false, false), options).find("none is known"), std::string::npos);
  options = {};
  options.surface = SurfaceKind::Grid;
  EXPECT_NE(message(sphere_scan(false, false), options).find("not organised"), std::string::npos);
  options.surface = SurfaceKind::Spinning;
  EXPECT_NE(message(sphere_scan(false, false), options).find("place of the scanner"), std::string::npos);
  options.surface = SurfaceKind::Hexagram;
  options.averaging_passes = 2;
  EXPECT_NE(message(sphere_scan(false, false), options).find("no edges"), std::string::npos);
  Scan empty;
  empty.points.assign(5, Vec3::Constant(kNaN));
  EXPECT_NE(message(empty, {}).find("none of the 5 points"), std::string::npos);
  Scan line;
  for (int i = 0; i < 9; ++i) line.points.emplace_back(i, 0, 0);
  EXPECT_NE(message(line, {}), "");
}

TEST(AutomaticRadius, IsFiveSpacingsRounded) {
  Surface s;
  s.spacing = 0.7123;
  EXPECT_DOUBLE_EQ(automatic_radius(s), 3.6);
  s.spacing = 1.234e-5;
  EXPECT_DOUBLE_EQ(automatic_radius(s), 6.2e-5);
  s.spacing = 8123;
  EXPECT_DOUBLE_EQ(automatic_radius(s), 41000);
  s.spacing = kNaN;
  EXPECT_TRUE(std::isnan(automatic_radius(s)));
}

}  // namespace
}  // namespace kappa
