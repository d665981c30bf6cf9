// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <utility>

#include "level_set_grid.hpp"
#include "root.hpp"

namespace kappa::detail {
namespace {

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). Corners of its sides, counter-clockwise seen
/// from outside the cell.
constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// Edges of a cell: 4 axis + the two other coordinates of its corners.
int edge_between(int corner_a, int corner_b) {
  const int low = corner_a < corner_b ? corner_a : corner_b;
  switch (corner_a ^ corner_b) {
    case 1:
      return low >> 1;
    case 2:
      return 4 + (low & 1) + (low >> 2) * 2;
    default:
      return 8 + low;
  }
}

/// Where the surface runs through a cell, as closed loops over its edges: next[e] follows e, -1 if the
/// surface does not cross e.
///
/// On each side of the cell every run of inside corners is cut off by one segment, from where the walk
/// around the side enters it to where it leaves. The cell beyond the side sees the same runs in the
/// other sense, so segments agree and the mesh has no crack.
std::array<int, 12> link_edges(const std::array<bool, 8>& in) {
  std::array<int, 12> next;
  next.fill(-1);
  for (const auto& side : kSides) {
    for (int c = 0; c < 4; ++c) {
      if (in[static_cast<std::size_t>(side[c])] || !in[static_cast<std::size_t>(side[(c + 1) % 4])]) continue;
      int last = (c + 1) % 4;
      while (in[static_cast<std::size_t>(side[(last + 1) % 4])]) last = (last + 1) % 4;
      const int enter = edge_between(side[c], side[(c + 1) % 4]);
      next[static_cast<std::size_t>(enter)] = edge_between(side[last], side[(last + 1) % 4]);
    }
  }
  return next;
}

/// Walks up the layers of the grid with two layers of values and the vertices on their edges.
class MarchingCubes {
 public:
  MarchingCubes(const ImplicitFunction& f, const LevelSetGrid& grid) : f_(f), grid_(grid) { upper_ = load_layer(0); }

  LevelSetMesh run() {
    for (std::size_t k = 0; k + 1 < grid_.count[2]; ++k) {
      lower_ = std::move(upper_);
      upper_ = load_layer(k + 1);
      join_layers(k);
      for (std::size_t j = 0; j + 1 < grid_.count[1]; ++j) {
        for (std::size_t i = 0; i + 1 < grid_.count[0]; ++i) add_cell(i, j);
      }
    }
    return std::move(mesh_);
  }

 private:
  struct Layer {
    std::vector<double> values;
    std::vector<Index> on_x, on_y;  ///< vertex on the edge that leaves the grid point along the axis
  };

  Layer load_layer(std::size_t k) {
    Layer layer;
    layer.values = layer_values(f_, grid_, k);
    layer.on_x.assign(grid_.layer_size(), kNoIndex);
    layer.on_y = layer.on_x;
    for (std::size_t j = 0; j < grid_.count[1]; ++j) {
      for (std::size_t i = 0; i < grid_.count[0]; ++i) {
        const std::size_t here = grid_.at(i, j);
        const bool in = inside(layer.values[here]);
        if (i + 1 < grid_.count[0] && in != inside(layer.values[grid_.at(i + 1, j)])) {
          layer.on_x[here] = add_vertex(grid_.point(i, j, k), 0);
        }
        if (j + 1 < grid_.count[1] && in != inside(layer.values[grid_.at(i, j + 1)])) {
          layer.on_y[here] = add_vertex(grid_.point(i, j, k), 1);
        }
      }
    }
    return layer;
  }

  /// Vertices on the edges between layers k and k + 1.
  void join_layers(std::size_t k) {
    on_z_.assign(grid_.layer_size(), kNoIndex);
    for (std::size_t j = 0; j < grid_.count[1]; ++j) {
      for (std::size_t i = 0; i < grid_.count[0]; ++i) {
        const std::size_t here = grid_.at(i, j);
        if (inside(lower_.values[here]) != inside(upper_.values[here])) {
          on_z_[here] = add_vertex(grid_.point(i, j, k), 2);
        }
      }
    }
  }

  Index add_vertex(const Vec3& from, int axis) {
    const auto along = [&](double t) {
      const ImplicitJet jet = f_(from + t * Vec3::Unit(axis));
      return std::pair(jet.value, jet.gradient[axis]);
    };
    mesh_.points.push_back(from + bracketed_root(along, 0, grid_.step, 0.1 * grid_.tolerance) * Vec3::Unit(axis));
    return static_cast<Index>(mesh_.points.size() - 1);
  }

  void add_cell(std::size_t i, std::size_t j) {
    const std::size_t base[4] = {grid_.at(i, j), grid_.at(i + 1, j), grid_.at(i, j + 1), grid_.at(i + 1, j + 1)};
    std::array<bool, 8> in;
    int count = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      in[c] = inside((c < 4 ? lower_ : upper_).values[base[c % 4]]);
      count += in[c] ? 1 : 0;
    }
    if (count == 0 || count == 8) return;
    const std::array<Index, 12> vertices = {lower_.on_x[base[0]], lower_.on_x[base[2]], upper_.on_x[base[0]],
                                            upper_.on_x[base[2]], lower_.on_y[base[0]], lower_.on_y[base[1]],
                                            upper_.on_y[base[0]], upper_.on_y[base[1]], on_z_[base[0]],
                                            on_z_[base[1]],       on_z_[base[2]],       on_z_[base[3]]};
    add_loops(link_edges(in), vertices);
  }

  void add_loops(std::array<int, 12> next, const std::array<Index, 12>& vertices) {
    for (std::size_t start = 0; start < 12; ++start) {
      std::vector<Index>& loop = loop_;
      loop.clear();
      for (std::size_t e = start; next[e] >= 0;) {
        loop.push_back(vertices[e]);
        e = static_cast<std::size_t>(std::exchange(next[e], -1));
      }
      for (std::size_t c = 2; c < loop.size(); ++c) mesh_.faces.add(loop[0], loop[c - 1], loop[c]);
    }
  }

  const ImplicitFunction& f_;
  const LevelSetGrid& grid_;
  Layer lower_, upper_;
  std::vector<Index> on_z_;
  std::vector<Index> loop_;
  LevelSetMesh mesh_;
};

}  // namespace

LevelSetMesh marching_cubes(const ImplicitFunction& f, const LevelSetGrid& grid) {
  return MarchingCubes(f, grid).run();
}

}  // namespace kappa::detail
