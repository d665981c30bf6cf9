// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/thin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

namespace {

/// A point and the number of its cell.
using Celled = std::pair<std::uint64_t, Index>;

class Cells {
 public:
  Cells(const std::vector<Vec3>& points, const Vec3& cell, const std::string& path)
      : least_(bounds(points).min), cell_(cell) {
    constexpr double kMost = 0x1p62;
    double total = 1;
    const Bounds box = bounds(points);
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::floor(position(box.max, axis)) + 1;
      total *= count;
      if (!(total <= kMost)) {
        throw Error(ErrorCode::InvalidArgument,
                    "'" + path + "': an extent of " + std::to_string((box.max - box.min).maxCoeff()) +
                        " cannot be divided into cells of " + std::to_string(cell.minCoeff()) + "; give larger ones");
      }
      count_[static_cast<std::size_t>(axis)] = static_cast<std::uint64_t>(count);
    }
  }

  std::uint64_t operator()(const Vec3& p) const {
    const auto at = [&](int axis) { return static_cast<std::uint64_t>(position(p, axis)); };
    return (at(2) * count_[1] + at(1)) * count_[0] + at(0);
  }

 private:
  /// In cells; the tolerance puts points of a regular grid on one side of the borders, however they were rounded.
  double position(const Vec3& p, int axis) const {
    constexpr double kTolerance = 1e-6;
    return (p[axis] - least_[axis]) / cell_[axis] + kTolerance;
  }

  Vec3 least_, cell_;
  std::array<std::uint64_t, 3> count_{};
};

std::vector<Celled> sorted_by_cell(const std::vector<Vec3>& points, const Cells& cells) {
  std::vector<Celled> sorted;
  sorted.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) sorted.emplace_back(cells(points[i]), static_cast<Index>(i));
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// The point in [begin, end) that is nearest to their mean, distances being measured in cells.
Index nearest_to_mean(const std::vector<Vec3>& points, const Vec3& cell, const Celled* begin, const Celled* end) {
  const Vec3& first = points[begin->second];
  Vec3 mean = Vec3::Zero();
  for (const Celled* c = begin; c != end; ++c) mean += points[c->second] - first;
  mean /= static_cast<double>(end - begin);
  Index nearest = begin->second;
  double least = std::numeric_limits<double>::infinity();
  for (const Celled* c = begin; c != end; ++c) {
    const double distance = (points[c->second] - first - mean).cwiseQuotient(cell).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = c->second;
  }
  return nearest;
}

}  // namespace

std::size_t thin(Scan& scan, const Vec3& cell, const std::string& path) {
  if (!(cell.array() > 0).all() || !is_finite(cell)) {
    throw Error(ErrorCode::InvalidArgument, "'" + path + "': cells of size " + std::to_string(cell.minCoeff()) +
                                                " hold no point; give a positive size");
  }
  if (bounds(scan.points).empty()) return 0;
  const std::vector<Celled> sorted = sorted_by_cell(scan.points, Cells(scan.points, cell, path));
  std::vector<Index> kept;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end].first == sorted[begin].first) ++end;
    kept.push_back(nearest_to_mean(scan.points, cell, &sorted[begin], sorted.data() + end));
  }
  std::sort(kept.begin(), kept.end());
  const std::size_t before = scan.points.size();
  keep_points(scan, kept);
  return before - kept.size();
}

}  // namespace kappa
