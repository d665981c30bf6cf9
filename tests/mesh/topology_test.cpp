// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/topology.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"

namespace kappa {
namespace {

using List = std::vector<Index>;

List at(const Adjacency& a, std::size_t i) {
  return List(a.begin(i), a.end(i));
}

TEST(Adjacency, OfATetrahedron) {
  const Mesh mesh = shapes::tetrahedron();
  const Adjacency faces = faces_of_vertices(mesh), neighbours = vertex_neighbours(mesh);
  ASSERT_EQ(faces.size(), 4U);
  EXPECT_EQ(at(faces, 0), (List{0, 1, 2}));
  EXPECT_EQ(at(faces, 3), (List{1, 2, 3}));
  EXPECT_EQ(at(neighbours, 2), (List{0, 1, 3}));
}

TEST(Adjacency, EdgesOnlyAndEachOnce) {
  Mesh mesh;
  mesh.vertices.assign(7, Vec3::Zero());
  mesh.faces.add({0, 1, 2, 3});
  mesh.faces.add({0, 1, 2, 3});
  mesh.faces.add({4, 4, 5});
  const Adjacency faces = faces_of_vertices(mesh), neighbours = vertex_neighbours(mesh);
  EXPECT_EQ(at(neighbours, 0), (List{1, 3})) << "a diagonal is no edge";
  EXPECT_EQ(at(faces, 0), (List{0, 1}));
  EXPECT_EQ(at(faces, 4), (List{2, 2})) << "a repeated corner stands twice";
  EXPECT_TRUE(at(faces, 6).empty());
  EXPECT_TRUE(at(neighbours, 6).empty());
}

TEST(Topology, Tetrahedron) {
  const Topology t = topology(shapes::tetrahedron());
  EXPECT_EQ(t.vertices, 4U);
  EXPECT_EQ(t.faces, 4U);
  EXPECT_EQ(t.edges, 6U);
  EXPECT_EQ(t.triangles, 4U);
  EXPECT_EQ(t.border_edges + t.nonmanifold_edges + t.inconsistent_edges + t.isolated_vertices, 0U);
  EXPECT_EQ(t.components, 1U);
  EXPECT_EQ(t.euler, 2);
}

TEST(Topology, Torus) {
  const Topology t = topology(shapes::torus(3, 1, 12, 8).mesh);
  EXPECT_EQ(t.edges, 3U * 96U);
  EXPECT_EQ(t.euler, 0);
  EXPECT_EQ(t.border_edges, 0U);
  EXPECT_EQ(t.inconsistent_edges, 0U);
}

TEST(Topology, MoebiusBandIsInconsistentSomewhere) {
  const Topology t = topology(shapes::moebius(24));
  EXPECT_EQ(t.euler, 0);
  EXPECT_EQ(t.components, 1U);
  EXPECT_EQ(t.border_edges, 48U);
  EXPECT_EQ(t.nonmanifold_edges, 0U);
  EXPECT_EQ(t.inconsistent_edges, 1U);
}

TEST(Topology, FanAndReversedFace) {
  Mesh mesh = shapes::fan(6, 1);
  Topology t = topology(mesh);
  EXPECT_EQ(t.border_edges, 6U);
  EXPECT_EQ(t.edges, 12U);
  EXPECT_EQ(t.euler, 1);
  EXPECT_EQ(t.inconsistent_edges, 0U);
  mesh.faces.clear();
  for (Index i = 0; i < 6; ++i) {
    const Index a = 1 + i, b = 1 + (i + 1) % 6;
    i == 2 ? mesh.faces.add(0, b, a) : mesh.faces.add(0, a, b);
  }
  EXPECT_EQ(topology(mesh).inconsistent_edges, 2U);
}

Mesh specimen(const std::string& name) {
  for (const shapes::Specimen& s : shapes::zoo()) {
    if (s.name == name) return s.mesh;
  }
  ADD_FAILURE() << name;
  return {};
}

TEST(Topology, NonManifoldSpecimens) {
  const Topology tie = topology(specimen("bow tie"));
  EXPECT_EQ(tie.components, 1U) << "joined by the shared vertex";
  EXPECT_EQ(tie.border_edges, 6U);
  EXPECT_EQ(tie.nonmanifold_edges, 0U);
  EXPECT_EQ(tie.euler, 1);

  const Topology sheets = topology(specimen("isolated vertices"));
  EXPECT_EQ(sheets.nonmanifold_edges, 1U);
  EXPECT_EQ(sheets.border_edges, 6U);
  EXPECT_EQ(sheets.isolated_vertices, 2U);
  EXPECT_EQ(sheets.vertices, 7U);
  EXPECT_EQ(sheets.euler, 5 - 7 + 3);

  const Topology mixed = topology(specimen("mixed polygons"));
  EXPECT_EQ(mixed.triangles, 1U);
  EXPECT_EQ(mixed.quads, 1U);
  EXPECT_EQ(mixed.polygons, 2U);

  Mesh two = shapes::tetrahedron();
  two.vertices.insert(two.vertices.end(), 3, Vec3::Zero());
  two.faces.add(4, 5, 6);
  EXPECT_EQ(topology(two).components, 2U);
  EXPECT_EQ(topology(Mesh{}).components, 0U);
}

}  // namespace
}  // namespace kappa
