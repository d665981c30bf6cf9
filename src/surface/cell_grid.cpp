// SPDX-License-Identifier: BSD-3-Clause
#include "cell_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

constexpr std::size_t kRows = 8;

using Triangle = std::array<Index, 3>;

enum class Verdict { Keep, DepthJump, Grazing, Degenerate };

/// Triangles of one row of cells, with what was cut there.
struct Row {
  std::vector<Triangle> faces;
  GridCuts cuts;
};

/// Splits cells in triangles.
class CellSplitter {
 public:
  CellSplitter(const std::vector<Vec3>& x, const Vec3& viewpoint, const GridOptions& options)
      : x_(x),
        viewpoint_(viewpoint),
        max_jump_(options.max_depth_jump),
        min_cosine_(std::cos(options.max_incidence * kPi / 180)) {}

  /// A cell with corners a b / c d.
  void split(Index a, Index b, Index c, Index d, Row& row) const {
    std::array<Index, 4> round = {a, b, d, c};
    const auto missing = std::count(round.begin(), round.end(), kNoIndex);
    if (missing > 1) return;
    if (missing == 1) {
      std::rotate(round.begin(), std::find(round.begin(), round.end(), kNoIndex), round.end());
      take({round[1], round[2], round[3]}, row);
      return;
    }
    const std::array<Triangle, 2> along_bc = {{{a, b, c}, {b, d, c}}}, along_ad = {{{a, b, d}, {a, d, c}}};
    const int kept_bc = kept(along_bc), kept_ad = kept(along_ad);
    const bool shorter_ad = (x_[a] - x_[d]).squaredNorm() < (x_[b] - x_[c]).squaredNorm();
    const bool use_ad = kept_ad != kept_bc ? kept_ad > kept_bc : shorter_ad;
    for (const Triangle& t : use_ad ? along_ad : along_bc) take(t, row);
  }

 private:
  Verdict judge(const Triangle& t) const {
    const Vec3 &a = x_[t[0]], &b = x_[t[1]], &c = x_[t[2]];
    const std::array<double, 3> ranges = {(a - viewpoint_).norm(), (b - viewpoint_).norm(), (c - viewpoint_).norm()};
    const auto [nearest, farthest] = std::minmax_element(ranges.begin(), ranges.end());
    if (*farthest - *nearest > max_jump_ * *nearest) return Verdict::DepthJump;
    const Vec3 normal = (b - a).cross(c - a), sight = (a + b + c) / 3 - viewpoint_;
    constexpr double kFlat = 1e-12;
    const double edge_sq = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    if (!(normal.norm() > kFlat * edge_sq)) return Verdict::Degenerate;
    if (std::abs(normal.dot(sight)) < min_cosine_ * normal.norm() * sight.norm()) return Verdict::Grazing;
    return Verdict::Keep;
  }

  int kept(const std::array<Triangle, 2>& pair) const {
    return int{judge(pair[0]) == Verdict::Keep} + int{judge(pair[1]) == Verdict::Keep};
  }

  void take(const Triangle& t, Row& row) const {
    switch (judge(t)) {
      case Verdict::DepthJump:
        ++row.cuts.depth_jumps;
        return;
      case Verdict::Grazing:
        ++row.cuts.grazing;
        return;
      case Verdict::Degenerate:
        ++row.cuts.degenerate;
        return;
      case Verdict::Keep:
        break;
    }
    const Vec3& a = x_[t[0]];
    const bool away = (x_[t[1]] - a).cross(x_[t[2]] - a).dot(viewpoint_ - a) < 0;
    row.faces.push_back(away ? Triangle{t[0], t[2], t[1]} : t);
  }

  const std::vector<Vec3>& x_;
  const Vec3 viewpoint_;
  const double max_jump_, min_cosine_;
};

Row split_row(const CellGrid& grid, std::size_t j, const CellSplitter& splitter) {
  Row row;
  const bool closed = grid.columns == CellGrid::Columns::Closed && grid.width > 2;
  const std::size_t cells = closed ? grid.width : grid.width - 1;
  const Index* upper = grid.points.data() + j * grid.width;
  const Index* lower = upper + grid.width;
  for (std::size_t i = 0; i < cells; ++i) {
    const std::size_t next = (i + 1) % grid.width;
    splitter.split(upper[i], upper[next], lower[i], lower[next], row);
  }
  return row;
}

}  // namespace

void check(const GridOptions& options, const Vec3& viewpoint) {
  if (!(options.max_depth_jump > 0))
    throw Error(ErrorCode::InvalidArgument, "max_depth_jump = " + std::to_string(options.max_depth_jump) +
                                                ": give a positive share of the distance");
  if (!(options.max_incidence > 0 && options.max_incidence <= 90))
    throw Error(ErrorCode::InvalidArgument,
                "max_incidence = " + std::to_string(options.max_incidence) + ": give degrees above 0, up to 90");
  if (!is_finite(viewpoint))
    throw Error(ErrorCode::InvalidArgument, "the viewpoint is not finite; give three finite coordinates");
}

GridCuts add_cell_faces(const CellGrid& grid, const Vec3& viewpoint, const GridOptions& options, const Execution& run,
                        Mesh& mesh) {
  GridCuts cuts;
  if (grid.width < 2 || grid.height < 2) return cuts;
  const CellSplitter splitter(mesh.vertices, viewpoint, options);
  std::vector<Row> rows(grid.height - 1);
  parallel_for(rows.size(), kRows, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t j = begin; j < end; ++j) rows[j] = split_row(grid, j, splitter);
  });
  for (const Row& row : rows) {
    for (const Triangle& t : row.faces) mesh.faces.add(t[0], t[1], t[2]);
    cuts.depth_jumps += row.cuts.depth_jumps;
    cuts.grazing += row.cuts.grazing;
    cuts.degenerate += row.cuts.degenerate;
  }
  return cuts;
}

std::size_t count_faceless(const Mesh& mesh) {
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (const Index v : mesh.faces.corners()) used[v] = 1;
  std::size_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v) count += used[v] == 0 && is_finite(mesh.vertices[v]);
  return count;
}

}  // namespace kappa
