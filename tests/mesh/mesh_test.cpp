// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "kappa/core/error.hpp"
#include "kappa/mesh/statistics.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

void expect_error(ErrorCode code, const std::function<void()>& call, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    for (const std::string& word : words) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << '"' << word << "\" not in: " << e.what();
    }
  }
}

TEST(Faces, HoldsAnySizes) {
  Faces faces;
  EXPECT_TRUE(faces.empty());
  faces.add(0, 1, 2);
  faces.add({3, 4, 5, 6});
  faces.add({});
  const std::vector<Index> five = {7, 8, 9, 10, 11};
  faces.add(five.data(), five.size());
  ASSERT_EQ(faces.size(), 4U);
  EXPECT_EQ(faces[1].size(), 4U);
  EXPECT_EQ(faces[1][3], 6U);
  EXPECT_EQ(faces[2].size(), 0U);
  EXPECT_EQ(faces.offset(3), 7U);
  EXPECT_EQ(std::vector<Index>(faces[3].begin(), faces[3].end()), five);
  EXPECT_EQ(faces.corners().size(), 12U);
  faces.clear();
  EXPECT_TRUE(faces.empty());
  EXPECT_EQ(faces.corners().size(), 0U);
}

TEST(Bounds, OfTheFinitePoints) {
  EXPECT_TRUE(bounds({}).empty());
  EXPECT_EQ(bounds({}).diagonal(), 0);
  EXPECT_TRUE(bounds({Vec3(kNaN, 0, 0)}).empty());
  const Bounds b = bounds({Vec3(1, 5, -2), Vec3(kNaN, 100, 100), Vec3(-3, 2, 0), Vec3(0, HUGE_VAL, 0)});
  EXPECT_EQ(b.min, Vec3(-3, 2, -2));
  EXPECT_EQ(b.max, Vec3(1, 5, 0));
  EXPECT_DOUBLE_EQ(b.diagonal(), std::sqrt(16 + 9 + 4));
}

/// Coordinates as files hold them: decimal numbers of 0 to 4 places around a UTM position.
std::vector<Vec3> utm_points(const Vec3& centre, double extent, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> some(-extent, extent);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) {
    Vec3 p = centre + Vec3(some(random), some(random), some(random) / 10);
    const double places = std::pow(10.0, static_cast<double>(i % 5));
    if (i % 7) p = (p * places).array().round() / places;
    points.push_back(p);
  }
  return points;
}

TEST(ChooseOrigin, SubtractingAndAddingBackIsExact) {
  const std::vector<Vec3> centres = {Vec3(500000, 5400000, 100), Vec3(-512345.678, 5.4e6 + 0.1, -33.3),
                                     Vec3(4e6, -3e5, 4.9e6), Vec3(123.456, 0, 1e7), Vec3(1e12 + 0.25, 1e-3, 65536)};
  std::uint64_t seed = 1;
  for (const Vec3& centre : centres) {
    for (const double extent : {0.5, 30.0, 2000.0, 1e5}) {
      const std::vector<Vec3> points = utm_points(centre, extent, seed++);
      const Vec3 origin = choose_origin(bounds(points));
      for (const Vec3& p : points) {
        const Vec3 local = p - origin, back = local + origin;
        ASSERT_EQ(back, p) << "origin " << origin.transpose() << " extent " << extent;
      }
    }
  }
}

TEST(ChooseOrigin, ZeroWhereTheDataIsNear) {
  EXPECT_EQ(choose_origin(bounds(shapes::torus(3, 1, 12, 8).mesh.vertices)), Vec3::Zero().eval());
  EXPECT_EQ(choose_origin(Bounds{}), Vec3::Zero().eval());
  const Vec3 o = choose_origin(bounds(utm_points(Vec3(500000, 5400000, 3), 50, 3)));
  EXPECT_NEAR(o.x(), 500000, 500);
  EXPECT_NEAR(o.y(), 5400000, 500);
  EXPECT_EQ(o.z(), 0);
  EXPECT_EQ(o, o.array().round().matrix().eval()) << "a round number";
}

TEST(MoveToLocalOrigin, KeepsPositionsAndIsIdempotent) {
  Scan scan;
  scan.points = utm_points(Vec3(500000, 5400000, 100), 100, 9);
  scan.points.emplace_back(kNaN, kNaN, kNaN);
  const std::vector<Vec3> before = scan.points;
  move_to_local_origin(scan);
  EXPECT_LT(bounds(scan.points).max.norm(), 2000);
  for (std::size_t i = 0; i + 1 < before.size(); ++i) ASSERT_EQ((scan.points[i] + scan.origin).eval(), before[i]);
  const std::vector<Vec3> local = scan.points;
  const Vec3 origin = scan.origin;
  move_to_local_origin(scan);
  EXPECT_EQ(scan.origin, origin);
  for (std::size_t i = 0; i + 1 < local.size(); ++i) ASSERT_EQ(scan.points[i], local[i]);
  EXPECT_TRUE(std::isnan(scan.points.back().x()));
}

TEST(MeshOf, NeedsFaces) {
  Scan scan;
  scan.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  expect_error(ErrorCode::InvalidData, [&] { mesh_of(scan); }, {"faces"});
  scan.faces.add(0, 1, 2);
  scan.origin = Vec3(7, 8, 9);
  const Mesh mesh = mesh_of(scan);
  EXPECT_EQ(mesh.origin, scan.origin);
  EXPECT_EQ(mesh.vertices.size(), 3U);
  EXPECT_EQ(mesh.faces.size(), 1U);
}

TEST(Scan, FindsFieldsByName) {
  Scan scan;
  scan.fields.push_back({"intensity", Field::Type::UInt16, {1, 2}});
  ASSERT_NE(scan.field("intensity"), nullptr);
  EXPECT_EQ(scan.field("intensity")->values[1], 2);
  EXPECT_EQ(scan.field("none"), nullptr);
}

TEST(ValidateMesh, NamesTheFaceAtFault) {
  const Mesh good = shapes::tetrahedron();
  EXPECT_NO_THROW(validate(good));
  EXPECT_NO_THROW(validate(Mesh{}));
  Mesh mesh = good;
  mesh.faces.add(0, 1, 4);
  expect_error(ErrorCode::InvalidData, [&] { validate(mesh); }, {"face 4", "4"});
  mesh = good;
  mesh.faces.add({0, 1});
  expect_error(ErrorCode::InvalidData, [&] { validate(mesh); }, {"face 4", "2"});
  mesh = good;
  mesh.weights = {1, 1, 1};
  expect_error(ErrorCode::InvalidData, [&] { validate(mesh); }, {"3", "4"});
  for (const double bad : {0.0, -1.0, kNaN, HUGE_VAL}) {
    mesh.weights = {1, 1, bad, 1};
    expect_error(ErrorCode::InvalidData, [&] { validate(mesh); }, {"2"});
  }
  mesh.weights = {1, 0.5, 2, 1e-9};
  EXPECT_NO_THROW(validate(mesh));
}

TEST(MedianEdgeLength, OfAllFaces) {
  EXPECT_TRUE(std::isnan(median_edge_length(Mesh{})));
  EXPECT_DOUBLE_EQ(median_edge_length(shapes::tetrahedron()), std::sqrt(8.0));
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 4, 0)};
  mesh.faces.add(0, 1, 2);
  EXPECT_DOUBLE_EQ(median_edge_length(mesh), 4.0);
}

TEST(Statistics, PercentilesAreRankedValues) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(-0.3, 1);
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{1000}, std::size_t{50001}}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      const double v = normal(random);
      values.push_back(i % 3 ? v : i % 2 ? std::exp(20 * v) : std::round(v) * 1e-3);  // also far apart, and many equal
    }
    if (count > 2) values[1] = HUGE_VAL, values[2] = -HUGE_VAL;
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::vector<double> parts = {0.0, 1.0, 37.5, 50.0, 99.0, 100.0}, together = percentiles(values, parts);
    for (const double p : parts) {
      const auto rank = static_cast<std::size_t>(std::llround(p / 100 * static_cast<double>(count - 1)));
      EXPECT_EQ(percentile(values, p), sorted[rank]) << p << " of " << count;
      const auto at = std::find(parts.begin(), parts.end(), p) - parts.begin();
      EXPECT_EQ(together[static_cast<std::size_t>(at)], sorted[rank]) << p << " of " << count << " with others";
    }
  }
  std::vector<double> none;
  EXPECT_TRUE(std::isnan(percentile(none, 50)));
}

}  // namespace
}  // namespace kappa
