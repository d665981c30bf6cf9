// SPDX-License-Identifier: BSD-3-Clause
#include "ball_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

namespace kappa {
namespace {

constexpr std::size_t kBlock = 64;  // cells
constexpr std::size_t kLanes = 4;

/// A cell of the grid, ordered by z, y, x: cells next to each other along x are next to each other in memory.
struct Cell {
  std::int64_t z, y, x;
  friend bool operator<(const Cell& a, const Cell& b) {
    if (a.z != b.z) return a.z < b.z;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  }
  friend bool operator==(const Cell& a, const Cell& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

/// Points sorted by cells of the side of the radius: a ball lies in the 27 cells around its centre.
class CellOrder {
 public:
  CellOrder(const std::vector<Vec3>& points, double side) : order_(points.size()) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    for (const Vec3& x : points) low = low.cwiseMin(x);
    std::vector<Cell> cells(points.size());
    std::transform(points.begin(), points.end(), cells.begin(), [&](const Vec3& x) {
      constexpr double kMost = 4e15;
      const Vec3 at = ((x - low) / side).cwiseMin(kMost);
      const auto whole = [&](int axis) { return static_cast<std::int64_t>(std::floor(at[axis])); };
      return Cell{whole(2), whole(1), whole(0)};
    });
    std::iota(order_.begin(), order_.end(), Index{0});
    std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
      if (cells[a] == cells[b]) return a < b;
      return cells[a] < cells[b];
    });
    for (std::size_t i = 0; i < order_.size(); ++i) {
      if (!cells_.empty() && cells_.back() == cells[order_[i]]) continue;
      cells_.push_back(cells[order_[i]]);
      begin_.push_back(i);
    }
    begin_.push_back(order_.size());
  }

  std::size_t cells() const { return cells_.size(); }
  Index point(std::size_t place) const { return order_[place]; }
  std::size_t begin(std::size_t cell) const { return begin_[cell]; }
  std::size_t end(std::size_t cell) const { return begin_[cell + 1]; }

  /// Calls `use(begin, end)` for the places of all points in the cell and those around it, always in the same order.
  template <class Use>
  void around(std::size_t cell, const Use& use) const {
    const Cell c = cells_[cell];
    for (std::int64_t z = c.z - 1; z <= c.z + 1; ++z) {
      for (std::int64_t y = c.y - 1; y <= c.y + 1; ++y) {
        const auto first = std::lower_bound(cells_.begin(), cells_.end(), Cell{z, y, c.x - 1});
        const auto last = std::upper_bound(first, cells_.end(), Cell{z, y, c.x + 1});
        use(begin_[static_cast<std::size_t>(first - cells_.begin())],
            begin_[static_cast<std::size_t>(last - cells_.begin())]);
      }
    }
  }

 private:
  std::vector<Index> order_;  ///< points by cells
  std::vector<Cell> cells_;   ///< those that hold points
  std::vector<std::size_t> begin_;
};

/// The points that may lie in the balls of one cell, by coordinates; one thread's worth of memory.
class Candidates {
 public:
  void gather(const std::vector<Vec3>& points, const CellOrder& order, std::size_t cell, double radius) {
    std::size_t total = 0;
    order.around(cell, [&](std::size_t begin, std::size_t end) { total += end - begin; });
    const std::size_t step = (total + kMostInBall - 1) / kMostInBall;
    origin_ = points[order.point(order.begin(cell))];
    for (auto& axis : x_) axis.clear();
    std::size_t at = 0;
    order.around(cell, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (at++ % step == 0) add(points[order.point(i)] - origin_);
      }
    });
    while (x_[0].size() % kLanes != 0) add(Vec3::Constant(8 * radius));  // in no ball of this cell
  }

  /// The plane of the points in the ball around `centre`.
  Vec3 plane(const Vec3& centre, double radius, std::size_t least) const {
    // n, x y z, xx xy xz yy yz zz of the points about the centre, in lanes that a compiler can make vectors of.
    std::array<std::array<double, kLanes>, 10> m{};
    const Vec3 c = centre - origin_;
    const double radius_sq = radius * radius;
    for (std::size_t i = 0; i < x_[0].size(); i += kLanes) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const double x = x_[0][i + lane] - c.x(), y = x_[1][i + lane] - c.y(), z = x_[2][i + lane] - c.z();
        const double in = x * x + y * y + z * z <= radius_sq ? 1.0 : 0.0;
        const double wx = in * x, wy = in * y, wz = in * z;
        m[0][lane] += in;
        m[1][lane] += wx;
        m[2][lane] += wy;
        m[3][lane] += wz;
        m[4][lane] += wx * x;
        m[5][lane] += wx * y;
        m[6][lane] += wx * z;
        m[7][lane] += wy * y;
        m[8][lane] += wy * z;
        m[9][lane] += wz * z;
      }
    }
    const auto total = [&](std::size_t i) { return (m[i][0] + m[i][1]) + (m[i][2] + m[i][3]); };
    if (total(0) < static_cast<double>(least)) return Vec3::Zero();
    Mat3 products;
    products << total(4), total(5), total(6), total(5), total(7), total(8), total(6), total(8), total(9);
    return plane_of_moments(total(0), Vec3(total(1), total(2), total(3)), products);
  }

 private:
  void add(const Vec3& x) {
    for (std::size_t axis = 0; axis < 3; ++axis) x_[axis].push_back(x[static_cast<int>(axis)]);
  }
  Vec3 origin_ = Vec3::Zero();
  std::array<std::vector<double>, 3> x_;
};

}  // namespace

Vec3 plane_of_moments(double count, const Vec3& sum, const Mat3& products) {
  if (count < 3) return Vec3::Zero();
  const Mat3 covariance = products - sum * (sum / count).transpose();
  const double size = covariance.trace();
  if (!(size > 0)) return Vec3::Zero();
  Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance / size);
  constexpr double kCollinear = 1e-12;
  if (solver.eigenvalues()[1] <= kCollinear) return Vec3::Zero();
  return solver.eigenvectors().col(0).normalized();
}

Normals ball_planes(const std::vector<Vec3>& points, double radius, std::size_t least, const Execution& run) {
  Normals normals(points.size(), Vec3::Zero());
  const CellOrder order(points, radius);
  parallel_for(order.cells(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    Candidates candidates;
    for (std::size_t cell = begin; cell < end; ++cell) {
      candidates.gather(points, order, cell, radius);
      for (std::size_t i = order.begin(cell); i < order.end(cell); ++i)
        normals[order.point(i)] = candidates.plane(points[order.point(i)], radius, least);
    }
  });
  return normals;
}

}  // namespace kappa
