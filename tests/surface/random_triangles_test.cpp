// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/random_triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "clouds.hpp"
#include "kappa/shapes/implicit.hpp"

namespace kappa {
namespace {

constexpr std::array kSchemes = {TriangleScheme::Uniform, TriangleScheme::Independent, TriangleScheme::Hexagram,
                                 TriangleScheme::AveragedHexagram};

RandomTriangleOptions options_of(TriangleScheme scheme) {
  RandomTriangleOptions options;
  options.scheme = scheme;
  return options;
}

double rms_of_mean(const CurvatureField& field, const std::vector<Vec3>& x, const ImplicitFunction& f) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += std::pow(field.samples[i].k.mean - surface_point(x[i], f(x[i])).curvature.mean, 2);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

bool same_bits(const CurvatureField& a, const CurvatureField& b) {
  const auto bits = [](const CurvatureSample& s) {
    std::array<double, 9> values = {s.k.mean, s.k.gaussian, s.k.k_min, s.k.k_max,        s.mu0,
                                    s.mu1,    s.mu2,        s.area,    s.k.dir_min.sum()};
    return values;
  };
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const auto x = bits(a.samples[i]), y = bits(b.samples[i]);
    if (std::memcmp(x.data(), y.data(), sizeof(x)) != 0) return false;
  }
  return a.samples.size() == b.samples.size();
}

/// With true normals mu1 = 2 mu0 / R and mu2 = mu0 / R^2 hold on every triangle inscribed in a sphere, however large.
TEST(RandomTriangles, MeanAndGaussianAreExactOnASphere) {
  const double radius = 2.5;
  const auto cloud = clouds::sphere(radius, 800, 4);
  for (const TriangleScheme scheme : {TriangleScheme::Uniform, TriangleScheme::Independent, TriangleScheme::Hexagram}) {
    const CurvatureField f =
        random_triangle_curvatures(clouds::positions(cloud), clouds::normals(cloud), options_of(scheme));
    for (const CurvatureSample& s : f.samples) {
      ASSERT_EQ(s.k.status, PointStatus::Valid) << name(scheme);
      EXPECT_NEAR(s.k.mean, 1 / radius, 1e-10) << name(scheme);
      EXPECT_NEAR(s.k.gaussian, 1 / (radius * radius), 1e-10) << name(scheme);
    }
  }
}

TEST(RandomTriangles, PlaneIsFlatAndFlippedNormalsFlipTheSign) {
  const auto cloud = clouds::torus(3000, 5);
  const std::vector<Vec3> x = clouds::positions(cloud);
  const Normals u = clouds::normals(cloud);
  Normals flipped;
  for (const Vec3& v : u) flipped.emplace_back(-v);
  const Normals up(x.size(), Vec3::UnitZ());
  std::vector<Vec3> flat = x;
  for (Vec3& p : flat) p.z() = 0;
  for (const TriangleScheme scheme : kSchemes) {
    const CurvatureField outward = random_triangle_curvatures(x, u, options_of(scheme));
    const CurvatureField inward = random_triangle_curvatures(x, flipped, options_of(scheme));
    const CurvatureField plane = random_triangle_curvatures(flat, up, options_of(scheme));
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(outward.samples[i].k.mean, -inward.samples[i].k.mean, 1e-9) << name(scheme);
      EXPECT_NEAR(outward.samples[i].k.gaussian, inward.samples[i].k.gaussian, 1e-9) << name(scheme);
      EXPECT_GT(outward.samples[i].mu0, 0);
      EXPECT_EQ(plane.samples[i].k.mean, 0) << name(scheme);
      EXPECT_NEAR(plane.samples[i].mu0, plane.samples[i].area, 1e-12);
    }
  }
}

/// Rms errors of the mean curvature that the published implementation has on its own clouds with 20 neighbours. Where
/// points lie in rows (the simulated scan) the hexagrams depend on how they are turned in the tangent plane.
TEST(RandomTriangles, AreAsGoodAsPublished) {
  struct Case {
    const char* file;
    ImplicitFunction f;
    double uniform, hexagram, averaged, tolerance;
  };
  const std::vector<Case> cases = {{"torus_010000.pts", clouds::torus_function, 1.7e-3, 2.2e-3, 1.7e-3, 0.05},
                                   {"goursat_010000.pts", goursat_function, 4.1e-3, 3.7e-3, 3.3e-3, 0.05},
                                   {"torus-lidar.pts", clouds::torus_function, 3.7e-3, 2.2e-3, 4.1e-3, 0.2}};
  for (const Case& c : cases) {
    const clouds::TextCloud cloud = clouds::read_text(std::string(KAPPA_SHARED_DATA) + "/clouds/" + c.file);
    if (cloud.x.empty()) GTEST_SKIP() << "no " << c.file << " in " << KAPPA_SHARED_DATA;
    const auto rms = [&](TriangleScheme scheme) {
      return rms_of_mean(random_triangle_curvatures(cloud.x, cloud.u, options_of(scheme)), cloud.x, c.f);
    };
    EXPECT_NEAR(rms(TriangleScheme::Uniform), c.uniform, c.tolerance * c.uniform) << c.file;
    EXPECT_NEAR(rms(TriangleScheme::Hexagram), c.hexagram, c.tolerance * c.hexagram) << c.file;
    EXPECT_NEAR(rms(TriangleScheme::AveragedHexagram), c.averaged, c.tolerance * c.averaged) << c.file;
  }
}

/// On a dense cloud every scheme comes near to the truth, also in the principal curvatures.
TEST(RandomTriangles, PrincipalCurvaturesOfATorus) {
  const auto cloud = clouds::torus(20000, 6);
  for (const TriangleScheme scheme : kSchemes) {
    const CurvatureField f =
        random_triangle_curvatures(clouds::positions(cloud), clouds::normals(cloud), options_of(scheme));
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      sum += std::pow(f.samples[i].k.k_max - cloud[i].curvature.k_max, 2) +
             std::pow(f.samples[i].k.k_min - cloud[i].curvature.k_min, 2);
    EXPECT_LT(std::sqrt(sum / (2 * static_cast<double>(cloud.size()))), 6e-3) << name(scheme);
  }
}

TEST(RandomTriangles, DependOnTheSeedButNotOnThreads) {
  const auto cloud = clouds::torus(2000, 7);
  const std::vector<Vec3> x = clouds::positions(cloud);
  const Normals u = clouds::normals(cloud);
  for (const TriangleScheme scheme : kSchemes) {
    Execution one, three;
    three.threads = 3;
    RandomTriangleOptions other = options_of(scheme);
    other.seed = 1;
    const CurvatureField f = random_triangle_curvatures(x, u, options_of(scheme), one);
    EXPECT_TRUE(same_bits(f, random_triangle_curvatures(x, u, options_of(scheme), one)));
    EXPECT_TRUE(same_bits(f, random_triangle_curvatures(x, u, options_of(scheme), three)));
    const bool random = scheme == TriangleScheme::Uniform || scheme == TriangleScheme::Independent;
    EXPECT_EQ(!same_bits(f, random_triangle_curvatures(x, u, other)), random) << name(scheme);
  }
}

/// A third of the draws of three of three neighbours would be lost to repetitions at most: 6 of 27 are kept.
TEST(RandomTriangles, CountsOfTriangles) {
  const auto cloud = clouds::sphere(1, 500, 8);
  const auto count = [&](TriangleScheme scheme, int neighbours, int triangles) {
    const RandomTriangleOptions options{scheme, neighbours, triangles};
    const CurvatureField f = random_triangle_curvatures(clouds::positions(cloud), clouds::normals(cloud), options);
    double sum = 0;
    for (const CurvatureSample& s : f.samples) sum += s.face_count;
    return sum / static_cast<double>(f.samples.size());
  };
  EXPECT_EQ(count(TriangleScheme::Independent, 20, 100), 6);
  EXPECT_EQ(count(TriangleScheme::Independent, 20, 4), 4);
  EXPECT_EQ(count(TriangleScheme::Independent, 255, 100), 85);
  EXPECT_NEAR(count(TriangleScheme::Uniform, 3, 270), 60, 1);
  EXPECT_NEAR(count(TriangleScheme::Uniform, 20, 100), 100 * 19 * 18 / 400.0, 0.5);
  EXPECT_GT(count(TriangleScheme::Hexagram, 20, 100), 1.8);
  EXPECT_GT(count(TriangleScheme::AveragedHexagram, 20, 100), 1.9);
}

TEST(RandomTriangles, DuplicatesMissingPointsAndLines) {
  const auto cloud = clouds::torus(500, 9);
  std::vector<Vec3> x = clouds::positions(cloud);
  Normals u = clouds::normals(cloud);
  const CurvatureField clean = random_triangle_curvatures(x, u, {});
  x.insert(x.end(), x.begin(), x.begin() + 500);
  u.insert(u.end(), u.begin(), u.begin() + 500);
  x.emplace_back(kNaN, 0, 0);
  u.push_back(Vec3::UnitZ());
  x.emplace_back(6, 0, 2);
  u.push_back(Vec3::Zero());
  const CurvatureField f = random_triangle_curvatures(x, u, {});
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(f.samples[i].k.mean, clean.samples[i].k.mean);
    EXPECT_EQ(f.samples[i].k.mean, f.samples[i + 500].k.mean);
  }
  EXPECT_EQ(f.samples[1000].k.status, PointStatus::Invalid);
  EXPECT_EQ(f.samples[1001].k.status, PointStatus::Invalid);
  EXPECT_TRUE(std::isnan(f.samples[1001].k.mean));

  std::vector<Vec3> line;
  for (int i = 0; i < 30; ++i) line.emplace_back(i, 0, 0);
  for (const TriangleScheme scheme : kSchemes) {
    const CurvatureField g = random_triangle_curvatures(line, Normals(line.size(), Vec3::UnitZ()), options_of(scheme));
    for (const CurvatureSample& s : g.samples) EXPECT_EQ(s.k.status, PointStatus::Empty) << name(scheme);
    const CurvatureField one = random_triangle_curvatures({Vec3::Zero()}, {Vec3::UnitZ()}, options_of(scheme));
    EXPECT_EQ(one.samples.front().k.status, PointStatus::Empty);
  }
}

/// Ratios and measures of a sample belong together; with normals that are not parallel the corrected area is less.
TEST(RandomTriangles, MeasuresAreThoseOfTheCurvatures) {
  const auto cloud = clouds::torus(500, 12);
  for (const TriangleScheme scheme : kSchemes) {
    const CurvatureField f =
        random_triangle_curvatures(clouds::positions(cloud), clouds::normals(cloud), options_of(scheme));
    for (const CurvatureSample& s : f.samples) {
      EXPECT_NEAR(s.mu1, 2 * s.k.mean * s.mu0, 1e-12 * s.area) << name(scheme);
      EXPECT_NEAR(s.mu2, s.k.gaussian * s.mu0, 1e-12 * s.area) << name(scheme);
      EXPECT_GT(s.area, s.mu0) << name(scheme);
    }
  }
}

/// What a point draws depends on its index in the cloud, not on whether others are valid.
TEST(RandomTriangles, AnInvalidPointChangesNoDraw) {
  const auto cloud = clouds::torus(300, 14);
  std::vector<Vec3> x = clouds::positions(cloud);
  const Normals u = clouds::normals(cloud);
  for (const TriangleScheme scheme : {TriangleScheme::Uniform, TriangleScheme::Independent}) {
    x[0] = Vec3(1000, 0, 0);
    const CurvatureField far = random_triangle_curvatures(x, u, options_of(scheme));
    x[0] = Vec3::Constant(kNaN);
    const CurvatureField missing = random_triangle_curvatures(x, u, options_of(scheme));
    for (std::size_t i = 1; i < x.size(); ++i) EXPECT_EQ(far.samples[i].mu1, missing.samples[i].mu1) << name(scheme);
  }
}

TEST(RandomTriangles, TakesTheLargestNumbersAllowed) {
  const std::vector<Vec3> x = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  const Normals u(3, Vec3::UnitZ());
  const CurvatureField f = random_triangle_curvatures(x, u, {TriangleScheme::Uniform, 255, 1000000});
  EXPECT_NEAR(f.samples[0].face_count, 1e6 * 6 / 27, 4 * std::sqrt(1e6 * 6 * 21) / 27);
  EXPECT_NE(clouds::refusal([&] {
              random_triangle_curvatures(x, u, {TriangleScheme::Uniform, 256, 100});
            }).message.find("neighbours = 256"),
            std::string::npos);
  EXPECT_NE(clouds::refusal([&] {
              random_triangle_curvatures(x, u, {TriangleScheme::Uniform, 20, 1000001});
            }).message.find("triangles = 1000001"),
            std::string::npos);
}

TEST(RandomTriangles, RefuseByName) {
  const std::vector<Vec3> x(5, Vec3::Zero());
  const Normals u(5, Vec3::UnitZ());
  const auto message = [&](const Normals& normals, const RandomTriangleOptions& options) {
    return clouds::refusal([&] { random_triangle_curvatures(x, normals, options); }).message;
  };
  EXPECT_NE(message(u, {TriangleScheme::Uniform, 2, 100}).find("neighbours = 2: give 3 to 255"), std::string::npos);
  EXPECT_NE(message(u, {TriangleScheme::Uniform, 20, 0}).find("triangles = 0: give 1"), std::string::npos);
  EXPECT_NE(message(Normals(4, Vec3::UnitZ()), {}).find("4 normals for 5 points"), std::string::npos);
  EXPECT_NE(message(Normals(5, Vec3::Zero()), {}).find("none of the 5 points"), std::string::npos);
}

}  // namespace
}  // namespace kappa
