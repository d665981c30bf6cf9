// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/border.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include <Eigen/Geometry>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/curvatures.hpp"
#include "kappa/core/error.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/curvature/shape_operators.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

/// The faces of `shape` whose corners are all wanted, and no other vertex.
Shape part_of(const Shape& shape, const std::function<bool(const Vec3&)>& wanted) {
  Shape part;
  std::vector<Index> place(shape.mesh.vertices.size(), kNoIndex);
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (!wanted(shape.mesh.vertices[v])) continue;
    place[v] = static_cast<Index>(part.normals.size());
    part.mesh.vertices.push_back(shape.mesh.vertices[v]);
    part.normals.push_back(shape.normals[v]);
    part.k_min.push_back(shape.k_min[v]);
    part.k_max.push_back(shape.k_max[v]);
    part.mean.push_back(shape.mean[v]);
  }
  for (std::size_t f = 0; f < shape.mesh.faces.size(); ++f) {
    const auto face = shape.mesh.faces[f];
    if (place[face[0]] != kNoIndex && place[face[1]] != kNoIndex && place[face[2]] != kNoIndex)
      part.mesh.faces.add(place[face[0]], place[face[1]], place[face[2]]);
  }
  return part;
}

/// Part of a torus with a slanting border across the tube and along it.
Shape cut_torus(int n) {
  return part_of(shapes::torus(3, 1, n, n), [](const Vec3& x) { return x.x() + 0.3 * x.y() > 0.7 && x.z() < 0.55; });
}

CurvatureField estimate(const Shape& s, double radius, int order, BorderEstimate border, const Execution& run = {}) {
  CurvatureOptions options;
  options.radii = {radius};
  options.order = order;
  options.border = border;
  return estimate_curvatures(s.mesh, s.normals, options, run)[0];
}

struct Rms {
  double mean, principal, std_error;
};

/// Over the vertices whose ball is not covered whole.
Rms rms_at_border(const Shape& s, const CurvatureField& field) {
  double mean = 0, principal = 0, told = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < s.mean.size(); ++i) {
    const CurvatureSample& q = field.samples[i];
    EXPECT_EQ(q.k.status, PointStatus::Valid);
    if (q.coverage > 0.9) continue;
    ++count;
    mean += std::pow(q.k.mean - s.mean[i], 2);
    principal += 0.5 * (std::pow(q.k.k_min - s.k_min[i], 2) + std::pow(q.k.k_max - s.k_max[i], 2));
    told += q.std_error * q.std_error;
  }
  const auto root = [&](double sum) { return std::sqrt(sum / static_cast<double>(count)); };
  return {root(mean), root(principal), root(told)};
}

/// Every vertex moved along its normal, which is kept, by up to `amount`; normals turned by up to `angle`.
Shape with_noise(Shape s, double amount, double angle, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> chance(-1, 1);
  for (std::size_t v = 0; v < s.normals.size(); ++v) {
    s.mesh.vertices[v] += amount * chance(random) * s.normals[v];
    s.normals[v] = (s.normals[v] + angle * Vec3(chance(random), chance(random), chance(random))).normalized();
  }
  return s;
}

TEST(BoxTree, FindsWhatIsNear) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  std::vector<Bounds> boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 low(place(random), place(random), place(random));
    boxes.push_back({low, low + 0.1 * Vec3(place(random), place(random), 0)});
  }
  const BoxTree tree(boxes);
  for (int i = 0; i < 50; ++i) {
    const Vec3 c(place(random), place(random), place(random));
    std::vector<int> found(boxes.size());
    EXPECT_FALSE(tree.find(c, 0.2, [&](Index b) { return ++found[b] > 1; }));
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const Vec3 nearest = c.cwiseMax(boxes[b].min).cwiseMin(boxes[b].max);
      EXPECT_EQ(found[b] == 1, (nearest - c).norm() <= 0.2);
    }
  }
  EXPECT_FALSE(BoxTree({}).find(Vec3::Zero(), 1, [](Index) { return true; }));
}

TEST(Border, IsWhereFacesEnd) {
  const auto edges = [](const Mesh& mesh, const Normals& u) { return border_edges(triangles_of(mesh, u), {}).size(); };
  const Shape torus = shapes::torus(3, 1, 20, 12), square = shapes::square(7), tube = shapes::cylinder(1, 2, 16, 5);
  EXPECT_EQ(edges(torus.mesh, torus.normals), 0u);
  EXPECT_EQ(edges(square.mesh, square.normals), 24u);
  EXPECT_EQ(edges(tube.mesh, tube.normals), 32u);
  const Mesh band = shapes::moebius(20);
  EXPECT_EQ(edges(band, Normals(band.vertices.size(), Vec3::UnitZ())), 40u);
}

TEST(Border, OfRefinedFacesIsNotTold) {
  const Shape square = shapes::square(5);
  EXPECT_TRUE(border_edges(refined_triangles(square.mesh, square.normals, 2), {}).empty());
  Mesh quads;
  quads.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  quads.faces.add({0, 1, 4, 3});
  quads.faces.add({1, 2, 5, 4});
  EXPECT_EQ(border_edges(triangles_of(quads, Normals(6, Vec3::UnitZ())), {}).size(), 6u) << "parts of polygons are";
}

/// Chord at distance d from the centre of a disc of radius r: what is left when the part beyond it is cut off.
double centroid_behind_chord(double r, double d) {
  const double area = r * r * (kPi - std::acos(d / r)) + d * std::sqrt(r * r - d * d);
  return 2.0 / 3 * std::pow(r * r - d * d, 1.5) / area;
}

TEST(Border, CentroidsOfThePlaneAreExact) {
  const Shape square = shapes::square(11);
  const MeasureTree balls(triangles_of(square.mesh, square.normals));
  const Border border(balls.triangles(), {});
  const auto centroid = [&](const Vec3& c, double r) {
    Vec3 at = Vec3::Zero();
    balls.sum({c}, {r}, BallDefinition::ExactDensity, {},
              [&](std::size_t, const BallMeasures* b) { at = border.centroid(c, r, b->sum.area); });
    return at;
  };
  const double r = 0.37, half_disc = 4 * r / (3 * kPi);
  EXPECT_LT((centroid({0.47, 0, 0}, r) - Vec3(0, half_disc, 0)).norm(), 1e-12);
  EXPECT_LT((centroid({1, 1, 0}, r) + half_disc * Vec3(1, 1, 0)).norm(), 1e-12);
  for (const double d : {0.01, 0.123, 0.3})
    EXPECT_LT((centroid({1 - d, 0.51, 0}, r) + centroid_behind_chord(r, d) * Vec3::UnitX()).norm(), 1e-12) << d;
  EXPECT_EQ(centroid({0.5, 0.5, 0}, r), Vec3::Zero());
}

TEST(Border, WeightsOfFacesCount) {
  Shape square = shapes::square(11);
  const std::size_t faces = square.mesh.faces.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const std::vector<Index> corners(square.mesh.faces[f].begin(), square.mesh.faces[f].end());
    square.mesh.faces.add(corners);
  }
  square.mesh.weights.assign(2 * faces, 0.5);
  const Border border(triangles_of(square.mesh, square.normals), {});
  const double r = 0.3, area = kPi * r * r / 2;
  EXPECT_LT((border.centroid({0.5, 1, 0}, r, area) + 4 * r / (3 * kPi) * Vec3::UnitY()).norm(), 1e-12);
}

TEST(BorderEstimate, HalvesTheErrorAndMore) {
  const Shape s = cut_torus(100);
  for (const auto& [radius, order] : {std::pair(0.2, 1), {0.2, 2}, {0.4, 2}, {0.4, 3}}) {
    const Rms in_ball = rms_at_border(s, estimate(s, radius, order, BorderEstimate::InBall));
    const Rms at_centre = rms_at_border(s, estimate(s, radius, order, BorderEstimate::AtCentre));
    EXPECT_LT(at_centre.mean, 0.5 * in_ball.mean) << radius << " " << order;
    EXPECT_LT(at_centre.principal, (order == 1 ? 0.9 : 0.75) * in_ball.principal) << radius << " " << order;
  }
}

TEST(BorderEstimate, ErrorIsOfSecondOrder) {
  const Shape s = cut_torus(200);
  const auto order_of = [&](BorderEstimate border) {
    const double wide = rms_at_border(s, estimate(s, 0.32, 1, border)).mean;
    return std::log2(wide / rms_at_border(s, estimate(s, 0.16, 1, border)).mean);
  };
  EXPECT_LT(order_of(BorderEstimate::InBall), 1.3);
  EXPECT_GT(order_of(BorderEstimate::AtCentre), 1.7);
}

TEST(BorderEstimate, ErrorToldIsHonest) {
  const Shape clean = cut_torus(100);
  for (const Shape& s : {clean, with_noise(clean, 0, 0.02, 1)}) {
    for (const int order : {2, 3}) {
      const Rms rms = rms_at_border(s, estimate(s, 0.3, order, BorderEstimate::AtCentre));
      EXPECT_GT(rms.std_error, 0.5 * rms.principal) << order;
    }
  }
}

TEST(BorderEstimate, NoiseIsHardlyAmplified) {
  const Shape s = with_noise(cut_torus(100), 0.01, 0.1, 5);
  for (const int order : {1, 2, 3}) {
    const Rms in_ball = rms_at_border(s, estimate(s, 0.15, order, BorderEstimate::InBall));
    const Rms at_centre = rms_at_border(s, estimate(s, 0.15, order, BorderEstimate::AtCentre));
    EXPECT_LT(at_centre.principal, 1.15 * in_ball.principal) << order;
  }
}

TEST(BorderEstimate, NothingChangesInside) {
  const double radius = 0.3;
  const Shape s = cut_torus(60);
  const Border border(triangles_of(s.mesh, s.normals), {});
  const CurvatureField a = estimate(s, radius, 2, BorderEstimate::InBall);
  const CurvatureField b = estimate(s, radius, 2, BorderEstimate::AtCentre);
  std::size_t same = 0, changed = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const bool inside = !border.is_near(s.mesh.vertices[i], radius);
    (inside ? same : changed) += 1;
    EXPECT_EQ(a.samples[i].area, b.samples[i].area);
    EXPECT_EQ(a.samples[i].mu1, b.samples[i].mu1);
    if (!inside) continue;
    EXPECT_EQ(a.samples[i].k.mean, b.samples[i].k.mean);
    EXPECT_EQ(a.samples[i].k.k_max, b.samples[i].k.k_max);
    EXPECT_EQ(a.samples[i].std_error, b.samples[i].std_error);
  }
  EXPECT_GT(same, 200u);
  EXPECT_GT(changed, 200u);
}

TEST(BorderEstimate, OfAMovedAndScaledSurface) {
  const Shape s = cut_torus(40);
  Shape moved = s;
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).matrix();
  constexpr double kScale = 1000;
  for (Vec3& x : moved.mesh.vertices) x = kScale * (turn * x) + Vec3(5, 6, 7);
  for (Vec3& u : moved.normals) u = turn * u;
  const CurvatureField a = estimate(s, 0.4, 2, BorderEstimate::AtCentre);
  const CurvatureField b = estimate(moved, 0.4 * kScale, 2, BorderEstimate::AtCentre);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_NEAR(b.samples[i].k.mean * kScale, a.samples[i].k.mean, 1e-9);
    EXPECT_NEAR(b.samples[i].k.gaussian * kScale * kScale, a.samples[i].k.gaussian, 1e-9);
    EXPECT_NEAR(b.samples[i].k.k_min * kScale, a.samples[i].k.k_min, 1e-9);
    EXPECT_NEAR(b.samples[i].std_error * kScale, a.samples[i].std_error, 1e-9);
  }
}

TEST(BorderEstimate, ThreadsChangeNoBit) {
  const Shape s = cut_torus(80);
  Execution three;
  three.threads = 3;
  const CurvatureField a = estimate(s, 0.3, 2, BorderEstimate::AtCentre);
  const CurvatureField b = estimate(s, 0.3, 2, BorderEstimate::AtCentre, three);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].k.mean, b.samples[i].k.mean);
    EXPECT_EQ(a.samples[i].std_error, b.samples[i].std_error);
  }
}

/// A tile with a margin as wide as what a vertex sees gives the vertices in its middle what the whole gives.
TEST(BorderEstimate, ATileIsThatPartOfTheWhole) {
  const Shape whole = cut_torus(60);
  const auto wanted = [](double limit) { return [limit](const Vec3& x) { return x.y() < limit; }; };
  const Shape tile = part_of(whole, wanted(1.6));
  const double radius = 0.2;
  const CurvatureField a = estimate(whole, radius, 1, BorderEstimate::AtCentre);
  const CurvatureField b = estimate(tile, radius, 1, BorderEstimate::AtCentre);
  std::size_t in_tile = 0, compared = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    const double y = whole.mesh.vertices[i].y();
    if (!(y < 1.6)) continue;
    const CurvatureSample& there = b.samples[in_tile++];
    if (y > 1.6 - 5 * radius) continue;
    ++compared;
    EXPECT_NEAR(there.k.mean, a.samples[i].k.mean, 1e-11);
  }
  EXPECT_GT(compared, 300u);
}

TEST(BorderEstimate, TooFewPointsTellNothing) {
  Mesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.faces.add(0, 1, 2);
  const Shape s{triangle, {Vec3(-0.1, -0.1, 1).normalized(), Vec3(0.2, 0, 1).normalized(), Vec3::UnitZ()}, {}, {}, {},
                {}};
  const CurvatureField a = estimate(s, 0.7, 1, BorderEstimate::InBall);
  const CurvatureField b = estimate(s, 0.7, 1, BorderEstimate::AtCentre);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::isfinite(b.samples[i].k.mean));
    EXPECT_EQ(a.samples[i].k.mean, b.samples[i].k.mean);
  }
}

TEST(BorderEstimate, AtCentreIsForBallsAtTheVerticesOfPlainFaces) {
  const Shape s = cut_torus(30);
  CurvatureOptions options;
  options.radii = {0.5};
  options.border = BorderEstimate::AtCentre;
  EXPECT_NO_THROW(estimate_curvatures(s.mesh, s.normals, options));
  const auto refused = [](const std::function<void()>& call) {
    try {
      call();
    } catch (const OptionError& e) {
      return e.option() == "border" && std::string(e.what()).find("border centre") == 0;
    }
    return false;
  };
  CurvatureOptions at_zero = options, own_scales = options;
  at_zero.radii = {0.5, 0};
  own_scales.scale = ScaleChoice::PerPoint;
  MeasureOptions refined;
  refined.refine = 1;
  EXPECT_TRUE(refused([&] { estimate_curvatures(s.mesh, s.normals, at_zero); }));
  EXPECT_TRUE(refused([&] { estimate_curvatures(s.mesh, s.normals, own_scales); }));
  EXPECT_TRUE(refused([&] { estimate_curvatures(s.mesh, s.normals, options, refined); }));
  const MeasureTree plain(triangles_of(s.mesh, s.normals)), split(refined_triangles(s.mesh, s.normals, 1));
  EXPECT_NO_THROW(estimate_curvatures(plain, s.normals, options));
  EXPECT_TRUE(refused([&] { estimate_curvatures(split, s.normals, options); }));
}

/// Centres of the caller's choice have no neighbours to fit a gradient to: a BallPlan cannot ask for it.
TEST(BorderEstimate, OfCentresThatAreGivenIsThatInTheBall) {
  const Shape s = cut_torus(30);
  const MeasureTree balls(triangles_of(s.mesh, s.normals));
  const CurvatureField of_centres = curvatures_in_balls(balls, s.mesh.vertices, s.normals, {{0.5}, 2})[0];
  const CurvatureField in_ball = estimate(s, 0.5, 2, BorderEstimate::InBall);
  const CurvatureField at_centre = estimate(s, 0.5, 2, BorderEstimate::AtCentre);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < in_ball.samples.size(); ++i) {
    EXPECT_EQ(of_centres.samples[i].k.mean, in_ball.samples[i].k.mean) << i;
    EXPECT_EQ(of_centres.samples[i].k.k_max, in_ball.samples[i].k.k_max) << i;
    changed += of_centres.samples[i].k.mean != at_centre.samples[i].k.mean;
  }
  EXPECT_GT(changed, 20u) << "no border near: this test could not fail";
}

}  // namespace
}  // namespace kappa
