// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/thin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/sort_by_key.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 16384;

/// The cells of a grid over a box, and their numbers.
class Cells {
 public:
  Cells(const Bounds& box, const Vec3& cell, const std::string& path) : least_(box.min), cell_(cell) {
    constexpr double kMost = 0x1p62;
    double total = 1;
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

/// The points that have a position, by their cells, those of a cell in their order.
std::vector<Keyed> sorted_by_cell(const std::vector<Vec3>& points, const Cells& cells, const Execution& run) {
  std::vector<Keyed> sorted;
  sorted.reserve(points.size());
  serial_for(points.size(), kBlock, stage(run, 0.0, 0.3), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_finite(points[i])) sorted.push_back({cells(points[i]), static_cast<Index>(i)});
    }
  });
  sort_by_key(sorted, stage(run, 0.3, 1.0));
  return sorted;
}

/// The point in [begin, end) that is nearest to their mean, distances being measured in cells.
Index nearest_to_mean(const std::vector<Vec3>& points, const Vec3& cell, const Keyed* begin, const Keyed* end) {
  const Vec3& first = points[begin->index];
  Vec3 mean = Vec3::Zero();
  for (const Keyed* c = begin; c != end; ++c) mean += points[c->index] - first;
  mean /= static_cast<double>(end - begin);
  Index nearest = begin->index;
  double least = std::numeric_limits<double>::infinity();
  for (const Keyed* c = begin; c != end; ++c) {
    const double distance = (points[c->index] - first - mean).cwiseQuotient(cell).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = c->index;
  }
  return nearest;
}

/// Which points stay: one of each cell.
std::vector<char> chosen_points(const std::vector<Vec3>& points, const Vec3& cell, const std::vector<Keyed>& sorted,
                                const Execution& run) {
  std::vector<char> chosen(points.size(), 0);
  Reporter report(run);
  constexpr std::size_t kCellsAtOnce = 4096;
  std::size_t cells = 0;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end].key == sorted[begin].key) ++end;
    chosen[nearest_to_mean(points, cell, &sorted[begin], sorted.data() + end)] = 1;
    if (++cells % kCellsAtOnce == 0) report(static_cast<double>(end) / static_cast<double>(sorted.size()));
  }
  return chosen;
}

}  // namespace

std::size_t thin(Scan& scan, const Vec3& cell, const std::string& path, const Execution& run) {
  if (!(cell.array() > 0).all() || !is_finite(cell)) {
    throw Error(ErrorCode::InvalidArgument, "'" + path + "': cells of size " + std::to_string(cell.minCoeff()) +
                                                " hold no point; give a positive size");
  }
  const Bounds box = bounds(scan.points);
  if (box.empty()) return 0;
  const std::vector<Keyed> sorted = sorted_by_cell(scan.points, Cells(box, cell, path), stage(run, 0.0, 0.5));
  const std::vector<char> chosen = chosen_points(scan.points, cell, sorted, stage(run, 0.5, 0.7));
  std::vector<Index> kept;
  for (Index i = 0; i < chosen.size(); ++i) {
    if (chosen[i]) kept.push_back(i);
  }
  const std::size_t before = scan.points.size();
  keep_points(scan, kept, stage(run, 0.7, 1.0));
  return before - kept.size();
}

}  // namespace kappa
