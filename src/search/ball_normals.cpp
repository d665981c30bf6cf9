// SPDX-License-Identifier: BSD-3-Clause
#include "ball_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "quadric_fit.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 64;  // cells
constexpr std::size_t kLanes = 4;

/// Points by coordinates.
using Columns = std::array<std::vector<double>, 3>;

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

  /// Calls `use(begin, end)` for the places of all points in the cell and those at most `reach` cells from it, always
  /// in the same order.
  template <class Use>
  void around(std::size_t cell, std::int64_t reach, const Use& use) const {
    const Cell c = cells_[cell];
    for (std::int64_t z = c.z - reach; z <= c.z + reach; ++z) {
      for (std::int64_t y = c.y - reach; y <= c.y + reach; ++y) {
        const auto first = std::lower_bound(cells_.begin(), cells_.end(), Cell{z, y, c.x - reach});
        const auto last = std::upper_bound(first, cells_.end(), Cell{z, y, c.x + reach});
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
  void gather(const std::vector<Vec3>& points, const CellOrder& order, std::size_t cell, std::int64_t reach) {
    std::size_t total = 0;
    order.around(cell, reach, [&](std::size_t begin, std::size_t end) { total += end - begin; });
    const std::size_t step = (total + kMostInBall - 1) / kMostInBall;
    origin_ = points[order.point(order.begin(cell))];
    for (auto& axis : x_) axis.clear();
    std::size_t at = 0;
    order.around(cell, reach, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (at++ % step == 0) add(points[order.point(i)] - origin_);
      }
    });
  }

  /// Those in the ball around `centre`, relative to it.
  void select(const Vec3& centre, double radius, Columns& ball) const {
    const std::size_t all = x_[0].size();
    for (auto& axis : ball) axis.resize(all);
    const Vec3 c = centre - origin_;
    const double radius_sq = radius * radius;
    std::size_t in = 0;
    for (std::size_t i = 0; i < all; ++i) {
      // Every point is written; one outside is written over by the next.
      const double x = x_[0][i] - c.x(), y = x_[1][i] - c.y(), z = x_[2][i] - c.z();
      ball[0][in] = x;
      ball[1][in] = y;
      ball[2][in] = z;
      in += x * x + y * y + z * z <= radius_sq;
    }
    for (auto& axis : ball) axis.resize(in);
  }

 private:
  void add(const Vec3& x) {
    for (std::size_t axis = 0; axis < 3; ++axis) x_[axis].push_back(x[static_cast<int>(axis)]);
  }
  Vec3 origin_ = Vec3::Zero();
  Columns x_;
};

/// The plane of points about a centre.
Plane plane_through(const Columns& points) {
  // x y z, xx xy xz yy yz zz in lanes that a compiler can make vectors of.
  std::array<std::array<double, kLanes>, 9> m{};
  const auto add = [&](std::size_t lane, std::size_t i) {
    const double x = points[0][i], y = points[1][i], z = points[2][i];
    const std::array<double, 9> terms{x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
    for (std::size_t term = 0; term < terms.size(); ++term) m[term][lane] += terms[term];
  };
  const std::size_t count = points[0].size(), whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) add(lane, i + lane);
  }
  for (std::size_t i = whole; i < count; ++i) add(i - whole, i);
  const auto total = [&](std::size_t i) { return (m[i][0] + m[i][1]) + (m[i][2] + m[i][3]); };
  Mat3 products;
  products << total(3), total(4), total(5), total(4), total(6), total(7), total(5), total(7), total(8);
  const Vec3 sum(total(0), total(1), total(2));
  return plane_of_moments(count, sum, products);
}

QuadricFit quadric_through(const Columns& points, double radius, const Vec3& plane) {
  QuadricFit quadric(frame_around(plane), radius);
  quadric.add(points[0], points[1], points[2]);
  return quadric;
}

/// Fits to the balls around the points of one cell after the other; one thread's worth of memory.
class CellFits {
 public:
  CellFits(const std::vector<Vec3>& points, const CellOrder& order, double radius, std::size_t least, NormalFit fit)
      : points_(points), order_(order), radius_(radius), least_(least), fit_(fit) {}

  void fit_cell(std::size_t cell, Normals& normals) {
    lopsided_.clear();
    candidates_.gather(points_, order_, cell, 1);
    for (std::size_t i = order_.begin(cell); i < order_.end(cell); ++i) fit_point(order_.point(i), normals);
    if (lopsided_.empty()) return;
    candidates_.gather(points_, order_, cell, 2);
    for (const Lopsided& l : lopsided_) {
      candidates_.select(points_[l.point], l.growth * radius_, ball_);
      const QuadricFit grown = quadric_through(ball_, l.growth * radius_, l.plane);
      normals[l.point] = better_fit(l.quadric, grown).normal_or(l.plane);
    }
  }

 private:
  void fit_point(Index point, Normals& normals) {
    candidates_.select(points_[point], radius_, ball_);
    if (ball_[0].size() < least_) return;
    const Plane plane = plane_through(ball_);
    normals[point] = plane.normal;
    if (fit_ == NormalFit::Plane || plane.normal.isZero(0)) return;
    const double growth = growth_of_ball(plane.offset / radius_, ball_[0].size());
    const QuadricFit quadric = quadric_through(ball_, radius_, plane.normal);
    normals[point] = quadric.normal_or(plane.normal);
    if (growth > 1) lopsided_.push_back({point, growth, plane.normal, quadric});
  }

  const std::vector<Vec3>& points_;
  const CellOrder& order_;
  double radius_;
  std::size_t least_;
  NormalFit fit_;
  Candidates candidates_;
  Columns ball_;

  /// A point whose ball is to grow, with what was fitted to it as it was.
  struct Lopsided {
    Index point;
    double growth;
    Vec3 plane;
    QuadricFit quadric;
  };
  std::vector<Lopsided> lopsided_;  ///< of the cell
};

}  // namespace

Plane plane_of_moments(std::size_t count, const Vec3& sum, const Mat3& products) {
  Plane plane{Vec3::Zero(), sum.norm() / static_cast<double>(count)};
  if (count < 3) return plane;
  const Mat3 covariance = products - sum * (sum / static_cast<double>(count)).transpose();
  const double size = covariance.trace();
  if (!(size > 0)) return plane;
  Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance / size);
  constexpr double kCollinear = 1e-12;
  if (solver.eigenvalues()[1] > kCollinear) plane.normal = solver.eigenvectors().col(0).normalized();
  return plane;
}

double growth_of_ball(double offset, std::size_t count) {
  constexpr double kHalfDisc = 4 / (3 * kPi);
  const double even = std::max(0.1, 1 / std::sqrt(static_cast<double>(count)));
  if (offset <= even) return 1;
  return offset < kHalfDisc ? 1 + (offset - even) / (kHalfDisc - even) : 2;
}

Normals ball_normals(const std::vector<Vec3>& points, double radius, std::size_t least, NormalFit fit,
                     const Execution& run) {
  Normals normals(points.size(), Vec3::Zero());
  const CellOrder order(points, radius);
  parallel_for(order.cells(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    CellFits fits(points, order, radius, least, fit);
    for (std::size_t cell = begin; cell < end; ++cell) fits.fit_cell(cell, normals);
  });
  return normals;
}

}  // namespace kappa
