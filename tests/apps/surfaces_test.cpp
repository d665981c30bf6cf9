// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/compare.hpp"
#include "kappa/scan/scan.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

constexpr double kSphere = 1, kDistance = 4;  // radius of a sphere, and how far its centre is from the scanner
constexpr double kBall = 0.2;                 // radius of the balls; what is left out is of the order of its square
constexpr double kOfBall = 0.5 * kBall * kBall;

/// Distance along the unit direction `d` to the sphere at (0, 0, kDistance), NaN beside it.
double distance_to_sphere(const Vec3& d) {
  const double along = kDistance * d.z(), off = kDistance * kDistance - along * along;
  return off < kSphere * kSphere ? along - std::sqrt(kSphere * kSphere - off) : kNaN;
}

/// What a depth camera at the origin sees of the sphere.
Scan depth_image() {
  Scan scan;
  scan.width = 120;
  scan.height = 90;
  scan.viewpoint = Vec3::Zero();
  for (std::size_t row = 0; row < scan.height; ++row) {
    for (std::size_t column = 0; column < scan.width; ++column) {
      const Vec3 d = Vec3((static_cast<double>(column) - 60) / 180, (static_cast<double>(row) - 45) / 180, 1);
      scan.points.emplace_back(distance_to_sphere(d.normalized()) * d.normalized());
    }
  }
  return scan;
}

/// Largest error of the mean curvature over the points well inside the sphere's outline.
double worst_mean_inside(const Scan& result) {
  double worst = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const Vec3 x = result.points[i] + result.origin;
    if (!(std::hypot(x.x(), x.y()) < 0.6 * kSphere)) continue;
    ++inside;
    worst = std::max(worst, std::abs(result.field("mean_curvature")->values[i] - 1 / kSphere));
  }
  EXPECT_GT(inside, 500u);
  return worst;
}

/// Errors of the mean curvature in a file against the truth in another.
ErrorStatistics mean_errors(const std::string& result, const std::string& truth) {
  for (const ErrorStatistics& s : compare_scans(read_scan(result), read_scan(truth))) {
    if (s.field == "mean_curvature") return s;
  }
  ADD_FAILURE() << result << " has no mean curvature";
  return {};
}

TEST(Surfaces, ADepthImageIsMeasuredAsAGrid) {
  const Folder f;
  write_scan(f.file("depth.pcd"), depth_image());
  const Outcome done =
      run({"curvature", f.file("depth.pcd"), f.file("o.pcd"), "--radius", std::to_string(kBall), "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("\"surface\": \"grid\""), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("organised"), std::string::npos) << "says why";
  EXPECT_LT(worst_mean_inside(read_scan(f.file("o.pcd"))), kOfBall);
}

TEST(Surfaces, OrganisedAndUnorganisedAgree) {
  const Folder f;
  write_scan(f.file("depth.pcd"), depth_image());
  const auto measure = [&](const std::string& surface) {
    const Outcome done = run({"curvature", f.file("depth.pcd"), f.file("o.ply"), "--radius", std::to_string(kBall),
                              "--surface", surface, "--normal-neighbours", "24"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return worst_mean_inside(read_scan(f.file("o.ply")));
  };
  EXPECT_LT(measure("umbrella"), kOfBall);
  EXPECT_LT(measure("grid"), kOfBall);
}

TEST(Surfaces, AngleOfTheCutDecidesHowFarTheGridGoes) {
  const Folder f;
  write_scan(f.file("depth.pcd"), depth_image());
  const auto faces = [&](const std::string& degrees) {
    EXPECT_EQ(run({"mesh", f.file("depth.pcd"), f.file("m.ply"), "--max-incidence", degrees}).exit_code, 0);
    return read_scan(f.file("m.ply")).faces.size();
  };
  EXPECT_LT(faces("45"), faces("70"));
}

TEST(Surfaces, DelaunayOfWavesComesCloseToTheTruth) {
  const Folder f;
  ASSERT_EQ(run({"generate", "waves", f.file("w.pcd"), "--points", "40000"}).exit_code, 0);
  const Outcome done = run({"curvature", f.file("w.pcd"), f.file("o.pcd"), "--radius", "20", "--surface", "delaunay"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_LT(mean_errors(f.file("o.pcd"), f.file("w.pcd")).p50, 2e-4);  // the true one has rms 2e-3
}

TEST(Surfaces, RandomTrianglesAreMeasuredPointByPoint) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--slices", "200", "--sides", "100"}).exit_code, 0);
  for (const std::string scheme : {"uniform", "independent", "hexagram", "avg-hexagram"}) {
    const Outcome done = run({"curvature", f.file("t.ply"), f.file("o.ply"), "--surface", scheme});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.out.find("each point alone"), std::string::npos) << done.out;
    EXPECT_LT(mean_errors(f.file("o.ply"), f.file("t.ply")).rms, 0.02) << scheme;  // the true one has rms 0.55
  }
}

TEST(Surfaces, SeedsDecideTheTriangles) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.pcd"), "--points", "2000"}).exit_code, 0);
  const auto measure = [&](const std::string& seed, const std::string& threads) {
    EXPECT_EQ(run({"curvature", f.file("t.pcd"), f.file("o.csv"), "--surface", "uniform", "--seed", seed, "--threads",
                   threads})
                  .exit_code,
              0);
    return contents(f.file("o.csv"));
  };
  const std::string first = measure("1", "1");
  EXPECT_EQ(first, measure("1", "2"));
  EXPECT_NE(first, measure("2", "1"));
}

TEST(Surfaces, WhatTheyCannotDoIsSaid) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.pcd"), "--points", "500"}).exit_code, 0);
  const auto refused = [&](const Arguments& arguments, int code, const std::string& expected) {
    const Outcome done = run(arguments);
    EXPECT_EQ(done.exit_code, code) << done.err;
    EXPECT_NE(done.err.find(expected), std::string::npos) << done.err;
    EXPECT_FALSE(std::filesystem::exists(f.file("o.ply")));
  };
  const std::string in = f.file("t.pcd"), out = f.file("o.ply");
  refused({"segment", in, out, "--surface", "hexagram"}, 2, "needs faces");
  refused({"mesh", in, out, "--surface", "uniform"}, 2, "needs faces");
  refused({"curvature", in, out, "--surface", "hexagram", "--radius", "1"}, 2, "leave it out");
  refused({"curvature", in, out, "--surface", "hexagram", "--smooth", "2"}, 1, "average");
  refused({"curvature", in, out, "--surface", "hexagram", "--normals", "max"}, 1, "no faces");
  refused({"curvature", in, out, "--surface", "grid"}, 1, "not organised");
  refused({"curvature", in, out, "--surface", "faces"}, 1, "no faces");
}

TEST(Surfaces, NormalsOfRandomSignAreWarnedOf) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--points", "3000"}).exit_code, 0);
  Scan scan = read_scan(f.file("t.ply"));
  for (std::size_t i = 0; i < scan.normals.size(); i += 3) scan.normals[i] = -scan.normals[i];
  write_scan(f.file("mixed.ply"), scan);
  const Outcome mixed = run({"curvature", f.file("mixed.ply"), f.file("o.ply"), "--radius", "0.3"});
  EXPECT_NE(mixed.out.find("warning"), std::string::npos) << mixed.out;
  const Outcome alike = run({"curvature", f.file("t.ply"), f.file("o.ply"), "--radius", "0.3"});
  EXPECT_EQ(alike.out.find("warning"), std::string::npos) << alike.out;
  const Outcome mended = run(
      {"curvature", f.file("mixed.ply"), f.file("o.ply"), "--radius", "0.3", "--normals", "pca", "--orient", "mst"});
  EXPECT_EQ(mended.out.find("warning"), std::string::npos) << mended.out;
  EXPECT_LT(mean_errors(f.file("o.ply"), f.file("t.ply")).p50, 0.1);
}

TEST(Program, NamesTheFitOfTheNormals) {
  const Folder f;
  ASSERT_EQ(run({"generate", "torus", f.file("t.ply"), "--points", "3000"}).exit_code, 0);
  for (const char* fit : {"pca", "quadric", "robust"}) {
    const Outcome o = run({"curvature", f.file("t.ply"), f.file("o.ply"), "--radius", "0.5", "--normals", fit,
                           "--normal-neighbours", "20", "--orient", "mst"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.out.find(std::string("normals     ") + fit + " of the 20 nearest"), std::string::npos) << o.out;
    EXPECT_LT(mean_errors(f.file("o.ply"), f.file("t.ply")).p50, 0.05) << fit;
  }
}

}  // namespace
}  // namespace kappa::apps
