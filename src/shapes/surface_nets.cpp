// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <utility>

#include "level_set_grid.hpp"

namespace kappa::detail {
namespace {

/// Walks up the slabs of cells between layers of the grid, with one vertex in each cell that the surface
/// crosses and one quad across each grid edge that it crosses.
class SurfaceNets {
 public:
  SurfaceNets(const ImplicitFunction& f, const LevelSetGrid& grid)
      : f_(f), grid_(grid), upper_(layer_values(f, grid, 0)), slab_(grid.layer_size(), kNoIndex) {}

  LevelSetMesh run() {
    for (std::size_t k = 0; k + 1 < grid_.count[2]; ++k) {
      slab_below_ = std::exchange(slab_, std::vector<Index>(grid_.layer_size(), kNoIndex));
      lower_ = std::exchange(upper_, layer_values(f_, grid_, k + 1));
      for (std::size_t j = 0; j + 1 < grid_.count[1]; ++j) {
        for (std::size_t i = 0; i + 1 < grid_.count[0]; ++i) add_vertex(i, j, k);
      }
      add_quads();
    }
    return std::move(mesh_);
  }

 private:
  /// The vertex of a cell: the mean of where its edges cross the surface, pushed to the surface.
  void add_vertex(std::size_t i, std::size_t j, std::size_t k) {
    const std::size_t base[4] = {grid_.at(i, j), grid_.at(i + 1, j), grid_.at(i, j + 1), grid_.at(i + 1, j + 1)};
    std::array<double, 8> value;
    for (std::size_t c = 0; c < 8; ++c) value[c] = (c < 4 ? lower_ : upper_)[base[c % 4]];
    Vec3 sum = Vec3::Zero();
    int crossings = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t other = c | std::size_t{1} << axis;
        if (other == c || inside(value[c]) == inside(value[other])) continue;
        sum += Vec3(static_cast<double>(c & 1), static_cast<double>(c >> 1 & 1), static_cast<double>(c >> 2));
        sum[static_cast<Eigen::Index>(axis)] += value[c] / (value[c] - value[other]);
        ++crossings;
      }
    }
    if (crossings == 0) return;
    slab_[base[0]] = static_cast<Index>(mesh_.points.size());
    const Vec3 start = grid_.point(i, j, k) + grid_.step * sum / crossings;
    mesh_.points.push_back(project_to_surface(f_, start, grid_.tolerance));
  }

  /// Quads across the edges of the lower layer and those between the layers.
  void add_quads() {
    for (std::size_t j = 0; j < grid_.count[1]; ++j) {
      for (std::size_t i = 0; i < grid_.count[0]; ++i) {
        const std::size_t here = grid_.at(i, j), row = grid_.count[0];
        const bool in = inside(lower_[here]);
        if (j > 0 && i + 1 < row && in != inside(lower_[here + 1])) {
          add_quad({slab_below_[here - row], slab_below_[here], slab_[here], slab_[here - row]}, in);
        }
        if (i > 0 && j + 1 < grid_.count[1] && in != inside(lower_[here + row])) {
          add_quad({slab_below_[here - 1], slab_[here - 1], slab_[here], slab_below_[here]}, in);
        }
        if (i > 0 && j > 0 && in != inside(upper_[here])) {
          add_quad({slab_[here - 1 - row], slab_[here - row], slab_[here], slab_[here - 1]}, in);
        }
      }
    }
  }

  /// The four cells around a grid edge, counter-clockwise seen from the end it points to; `outward` if the
  /// edge leaves the inside. Split along the shorter diagonal.
  void add_quad(std::array<Index, 4> q, bool outward) {
    for (const Index corner : q) {
      if (corner == kNoIndex) return;  // on the border of the box
    }
    if (!outward) std::swap(q[1], q[3]);
    const auto length = [&](Index a, Index b) { return (mesh_.points[a] - mesh_.points[b]).squaredNorm(); };
    if (length(q[0], q[2]) <= length(q[1], q[3])) {
      mesh_.faces.add(q[0], q[1], q[2]);
      mesh_.faces.add(q[0], q[2], q[3]);
    } else {
      mesh_.faces.add(q[0], q[1], q[3]);
      mesh_.faces.add(q[1], q[2], q[3]);
    }
  }

  const ImplicitFunction& f_;
  const LevelSetGrid& grid_;
  std::vector<double> lower_, upper_;
  std::vector<Index> slab_below_, slab_;
  LevelSetMesh mesh_;
};

}  // namespace

LevelSetMesh surface_nets(const ImplicitFunction& f, const LevelSetGrid& grid) {
  return SurfaceNets(f, grid).run();
}

}  // namespace kappa::detail
