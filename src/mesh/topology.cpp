// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/topology.hpp"

#include <algorithm>
#include <numeric>

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

/// A side of a face, as the lower of its ends sees it.
struct Side {
  Index high;   ///< the other end
  bool upward;  ///< the face runs through it towards `high`
  bool operator<(const Side& other) const { return high < other.high; }
};

/// The sides of all faces by their lower ends, those of an end in increasing order.
struct Sides {
  std::vector<std::size_t> offsets;
  std::vector<Side> items;
  std::size_t size() const { return offsets.size() - 1; }
};

/// Calls `use(low, side)` for each side of the faces that joins two different vertices.
template <class Use>
void for_each_side(const Faces& faces, const Execution& run, const Use& use) {
  serial_for(faces.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const Faces::View face = faces[f];
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Index a = face[i], b = face[i + 1 < face.size() ? i + 1 : 0];
        if (a != b) use(std::min(a, b), Side{std::max(a, b), a < b});
      }
    }
  });
}

Sides sorted_sides(const Mesh& mesh, const Execution& run) {
  Sides sides;
  sides.offsets.assign(mesh.vertices.size() + 1, 0);
  for_each_side(mesh.faces, stage(run, 0.0, 0.3), [&](Index low, const Side&) { ++sides.offsets[low + 1]; });
  std::partial_sum(sides.offsets.begin(), sides.offsets.end(), sides.offsets.begin());
  sides.items.resize(sides.offsets.back());
  std::vector<std::size_t> next(sides.offsets.begin(), sides.offsets.end() - 1);
  for_each_side(mesh.faces, stage(run, 0.3, 0.6),
                [&](Index low, const Side& side) { sides.items[next[low]++] = side; });
  const auto at = [&](std::size_t v) { return sides.items.begin() + static_cast<std::ptrdiff_t>(sides.offsets[v]); };
  parallel_for(sides.size(), kBlock, stage(run, 0.6, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t v = begin; v < end; ++v) std::sort(at(v), at(v + 1));
  });
  return sides;
}

/// Calls `use(low, first, last)` for each edge in increasing order; [first, last) are its sides.
template <class Use>
void for_each_edge(const Sides& sides, const Execution& run, const Use& use) {
  serial_for(sides.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Side* const all = sides.items.data() + sides.offsets[v + 1];
      for (const Side *first = sides.items.data() + sides.offsets[v], *last = first; first != all; first = last) {
        while (last != all && last->high == first->high) ++last;
        use(static_cast<Index>(v), first, last);
      }
    }
  });
}

/// Union-find over vertices.
class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

void count_edges(const Mesh& mesh, Topology& t, const Execution& run) {
  const Sides sides = sorted_sides(mesh, stage(run, 0.0, 0.8));
  for_each_edge(sides, stage(run, 0.8, 1.0), [&](Index, const Side* first, const Side* last) {
    const auto faces = last - first;
    const auto upward = std::count_if(first, last, [](const Side& side) { return side.upward; });
    ++t.edges;
    t.border_edges += faces == 1;
    t.nonmanifold_edges += faces > 2;
    t.inconsistent_edges += faces == 2 && upward != 1;
  });
}

void count_faces(const Mesh& mesh, Topology& t, const Execution& run) {
  serial_for(mesh.faces.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::size_t corners = mesh.faces[f].size();
      t.triangles += corners == 3;
      t.quads += corners == 4;
      t.polygons += corners > 4;
    }
  });
}

void count_components(const Mesh& mesh, Topology& t, const Execution& run) {
  Components components(mesh.vertices.size());
  std::vector<bool> used(mesh.vertices.size(), false);
  serial_for(mesh.faces.size(), kBlock, stage(run, 0.0, 0.7), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (const Index v : mesh.faces[f]) {
        used[v] = true;
        components.join(mesh.faces[f][0], v);
      }
    }
  });
  serial_for(mesh.vertices.size(), kBlock, stage(run, 0.7, 1.0), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      t.isolated_vertices += !used[v];
      t.components += used[v] && components.find(static_cast<Index>(v)) == v;
    }
  });
}

}  // namespace

Adjacency faces_of_vertices(const Mesh& mesh, const Execution& run) {
  Adjacency around;
  const std::vector<Index>& corners = mesh.faces.corners();
  around.offsets.assign(mesh.vertices.size() + 1, 0);
  serial_for(corners.size(), kBlock, stage(run, 0.0, 0.4), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++around.offsets[corners[i] + 1];
  });
  std::partial_sum(around.offsets.begin(), around.offsets.end(), around.offsets.begin());
  around.items.resize(corners.size());
  std::vector<std::size_t> next(around.offsets.begin(), around.offsets.end() - 1);
  serial_for(mesh.faces.size(), kBlock, stage(run, 0.4, 1.0), [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (const Index v : mesh.faces[f]) around.items[next[v]++] = static_cast<Index>(f);
    }
  });
  return around;
}

Adjacency vertex_neighbours(const Mesh& mesh, const Execution& run) {
  const Sides sides = sorted_sides(mesh, stage(run, 0.0, 0.6));
  Adjacency near;
  near.offsets.assign(mesh.vertices.size() + 1, 0);
  for_each_edge(sides, stage(run, 0.6, 0.7), [&](Index low, const Side* side, const Side*) {
    ++near.offsets[low + 1];
    ++near.offsets[side->high + 1];
  });
  std::partial_sum(near.offsets.begin(), near.offsets.end(), near.offsets.begin());
  near.items.resize(near.offsets.back());
  std::vector<std::size_t> next(near.offsets.begin(), near.offsets.end() - 1);
  // The edges come in the order of (low, high): first all neighbours below a vertex, then all above, each increasing.
  for_each_edge(sides, stage(run, 0.7, 0.85),
                [&](Index low, const Side* side, const Side*) { near.items[next[side->high]++] = low; });
  for_each_edge(sides, stage(run, 0.85, 1.0),
                [&](Index low, const Side* side, const Side*) { near.items[next[low]++] = side->high; });
  return near;
}

Topology topology(const Mesh& mesh, const Execution& run) {
  Topology t;
  t.vertices = mesh.vertices.size();
  t.faces = mesh.faces.size();
  count_faces(mesh, t, stage(run, 0.0, 0.05));
  count_edges(mesh, t, stage(run, 0.05, 0.8));
  count_components(mesh, t, stage(run, 0.8, 1.0));
  t.euler =
      static_cast<long>(t.vertices - t.isolated_vertices) - static_cast<long>(t.edges) + static_cast<long>(t.faces);
  return t;
}

}  // namespace kappa
