// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/topology.hpp"

#include <algorithm>
#include <numeric>

namespace kappa {
namespace {

/// A side of a face, its ends in increasing order.
struct HalfEdge {
  Index low, high;
  bool upward;  ///< run through from low to high
  bool operator<(const HalfEdge& other) const { return low != other.low ? low < other.low : high < other.high; }
  bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.faces.corners().size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Faces::View face = mesh.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index a = face[i], b = face[(i + 1) % face.size()];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Union-find over vertices.
class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

 private:
  std::vector<Index> parent_;
};

void count_edges(const std::vector<HalfEdge>& edges, Topology& t) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    std::size_t upward = 0;
    for (end = begin; end < edges.size() && edges[end].same_edge(edges[begin]); ++end) upward += edges[end].upward;
    const std::size_t faces = end - begin;
    ++t.edges;
    t.border_edges += faces == 1;
    t.nonmanifold_edges += faces > 2;
    t.inconsistent_edges += faces == 2 && upward != 1;
  }
}

void count_faces(const Mesh& mesh, Topology& t) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::size_t corners = mesh.faces[f].size();
    t.triangles += corners == 3;
    t.quads += corners == 4;
    t.polygons += corners > 4;
  }
}

void count_components(const Mesh& mesh, Topology& t) {
  Components components(mesh.vertices.size());
  std::vector<bool> used(mesh.vertices.size(), false);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const Index v : mesh.faces[f]) {
      used[v] = true;
      components.join(mesh.faces[f][0], v);
    }
  }
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    t.isolated_vertices += !used[v];
    t.components += used[v] && components.find(v) == v;
  }
}

}  // namespace

Adjacency faces_of_vertices(const Mesh& mesh) {
  Adjacency around;
  around.offsets.assign(mesh.vertices.size() + 1, 0);
  for (const Index v : mesh.faces.corners()) ++around.offsets[v + 1];
  std::partial_sum(around.offsets.begin(), around.offsets.end(), around.offsets.begin());
  around.items.resize(mesh.faces.corners().size());
  std::vector<std::size_t> next(around.offsets.begin(), around.offsets.end() - 1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const Index v : mesh.faces[f]) around.items[next[v]++] = static_cast<Index>(f);
  }
  return around;
}

Adjacency vertex_neighbours(const Mesh& mesh) {
  std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  edges.erase(std::unique(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.same_edge(b); }),
              edges.end());
  Adjacency near;
  near.offsets.assign(mesh.vertices.size() + 1, 0);
  for (const HalfEdge& e : edges) {
    ++near.offsets[e.low + 1];
    ++near.offsets[e.high + 1];
  }
  std::partial_sum(near.offsets.begin(), near.offsets.end(), near.offsets.begin());
  near.items.resize(2 * edges.size());
  std::vector<std::size_t> next(near.offsets.begin(), near.offsets.end() - 1);
  // Edges are sorted by (low, high): first all neighbours below a vertex, then all above, each increasing.
  for (const HalfEdge& e : edges) near.items[next[e.high]++] = e.low;
  for (const HalfEdge& e : edges) near.items[next[e.low]++] = e.high;
  return near;
}

Topology topology(const Mesh& mesh) {
  Topology t;
  t.vertices = mesh.vertices.size();
  t.faces = mesh.faces.size();
  count_faces(mesh, t);
  count_edges(sorted_half_edges(mesh), t);
  count_components(mesh, t);
  t.euler =
      static_cast<long>(t.vertices - t.isolated_vertices) - static_cast<long>(t.edges) + static_cast<long>(t.faces);
  return t;
}

}  // namespace kappa
