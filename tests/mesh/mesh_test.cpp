// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using test::expect_error;

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

}  // namespace
}  // namespace kappa
