// SPDX-License-Identifier: BSD-3-Clause
#include "height_grid.hpp"

#include <algorithm>
#include <cmath>

namespace kappa {
namespace {

constexpr std::size_t kRowsAtOnce = 16;

/// out[i] = least of in[i - reach .. i + reach], by the minima of blocks of the window's width from both ends (van
/// Herk).
class SlidingMinimum {
 public:
  explicit SlidingMinimum(std::size_t count) : from_left_(count), from_right_(count) {}

  void operator()(const double* in, std::size_t count, std::size_t reach, double* out) {
    const std::size_t width = 2 * reach + 1;
    for (std::size_t i = 0; i < count; ++i) from_left_[i] = i % width == 0 ? in[i] : std::min(from_left_[i - 1], in[i]);
    for (std::size_t i = count; i-- > 0;) {
      const bool last = i + 1 == count || (i + 1) % width == 0;
      from_right_[i] = last ? in[i] : std::min(from_right_[i + 1], in[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t begin = i < reach ? 0 : i - reach, end = std::min(i + reach, count - 1);
      // A window that the border cuts may lie within one block, of which only one end is its own.
      const bool at_right = end == count - 1 && begin / width == end / width;
      out[i] = begin == 0 ? (end / width == 0 ? from_left_[end] : std::min(from_right_[0], from_left_[end]))
               : at_right ? from_right_[begin]
                          : std::min(from_right_[begin], from_left_[end]);
    }
  }

 private:
  std::vector<double> from_left_, from_right_;
};

std::size_t half_width(std::size_t radius, std::size_t dy) {
  // Half a cell more than the radius gives rounder small discs; radius 1 is then the square of nine cells.
  const double r = static_cast<double>(radius) + 0.5, y = static_cast<double>(dy);
  return static_cast<std::size_t>(std::sqrt(r * r - y * y));
}

/// Least value within the disc, for rows [begin, end).
void erode_rows(const HeightGrid& in, std::size_t radius, std::size_t begin, std::size_t end, HeightGrid& out) {
  SlidingMinimum minimum(in.columns);
  std::vector<double> row(in.columns);
  const std::size_t first = begin < radius ? 0 : begin - radius, last = std::min(end + radius, in.rows);
  std::fill(out.z.begin() + static_cast<std::ptrdiff_t>(begin * in.columns),
            out.z.begin() + static_cast<std::ptrdiff_t>(end * in.columns), std::numeric_limits<double>::infinity());
  for (std::size_t source = first; source < last; ++source) {
    std::size_t known = kNoIndex;  // half width that `row` holds
    for (std::size_t dy = 0; dy <= radius; ++dy) {
      const std::size_t width = half_width(radius, dy);
      if (width != known) minimum(&in.z[source * in.columns], in.columns, width, row.data());
      known = width;
      const auto lower = [&](std::size_t target) {
        for (std::size_t x = 0; x < in.columns; ++x) out.at(x, target) = std::min(out.at(x, target), row[x]);
      };
      if (source >= begin + dy && source - dy < end) lower(source - dy);
      if (dy > 0 && source + dy >= begin && source + dy < end) lower(source + dy);
    }
  }
}

HeightGrid eroded(const HeightGrid& in, std::size_t radius, const Execution& run) {
  HeightGrid out(in.columns, in.rows);
  const std::size_t block = std::max(kRowsAtOnce, 2 * radius);
  parallel_for(in.rows, block, run,
               [&](std::size_t begin, std::size_t end, int) { erode_rows(in, radius, begin, end, out); });
  return out;
}

/// Mean of the known cells in a block of two by two; NaN if there is none.
double mean_of_block(const HeightGrid& fine, std::size_t column, std::size_t row) {
  double sum = 0;
  int count = 0;
  for (std::size_t y = 2 * row; y < std::min(2 * row + 2, fine.rows); ++y) {
    for (std::size_t x = 2 * column; x < std::min(2 * column + 2, fine.columns); ++x) {
      if (std::isnan(fine.at(x, y))) continue;
      sum += fine.at(x, y);
      ++count;
    }
  }
  return count ? sum / count : kNaN;
}

/// Means of the known cells in blocks of two by two.
HeightGrid coarser(const HeightGrid& fine, const Execution& run) {
  HeightGrid coarse((fine.columns + 1) / 2, (fine.rows + 1) / 2);
  parallel_for(coarse.rows, kRowsAtOnce, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t row = begin; row < end; ++row) {
      for (std::size_t column = 0; column < coarse.columns; ++column)
        coarse.at(column, row) = mean_of_block(fine, column, row);
    }
  });
  return coarse;
}

double mean_of_neighbours(const HeightGrid& g, std::size_t x, std::size_t y) {
  double sum = 0;
  int count = 0;
  const auto add = [&](double z) {
    sum += z;
    ++count;
  };
  if (x > 0) add(g.at(x - 1, y));
  if (x + 1 < g.columns) add(g.at(x + 1, y));
  if (y > 0) add(g.at(x, y - 1));
  if (y + 1 < g.rows) add(g.at(x, y + 1));
  return sum / count;
}

/// Relaxes the cells `holes` towards the mean of their neighbours, and beyond, which is faster.
void smooth_holes(HeightGrid& surface, const std::vector<std::size_t>& holes, const Execution& run) {
  constexpr int kSweeps = 16;
  constexpr std::size_t kBlock = 16384;
  constexpr double kBeyond = 1.5;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const Execution part = stage(run, static_cast<double>(sweep) / kSweeps, static_cast<double>(sweep + 1) / kSweeps);
    serial_for(holes.size(), kBlock, part, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t i = sweep % 2 ? holes[holes.size() - 1 - k] : holes[k];
        const double mean = mean_of_neighbours(surface, i % surface.columns, i / surface.columns);
        surface.z[i] += kBeyond * (mean - surface.z[i]);
      }
    });
  }
}

}  // namespace

double HeightGrid::interpolate(double x, double y) const {
  const double cx = std::clamp(x, 0.0, static_cast<double>(columns - 1)),
               cy = std::clamp(y, 0.0, static_cast<double>(rows - 1));
  const auto i = static_cast<std::size_t>(cx), j = static_cast<std::size_t>(cy);
  const std::size_t i1 = std::min(i + 1, columns - 1), j1 = std::min(j + 1, rows - 1);
  const double s = cx - static_cast<double>(i), t = cy - static_cast<double>(j);
  return (1 - t) * ((1 - s) * at(i, j) + s * at(i1, j)) + t * ((1 - s) * at(i, j1) + s * at(i1, j1));
}

void negate(HeightGrid& grid, const Execution& run) {
  for_each_cell(grid, run, [&](std::size_t i) { grid.z[i] = -grid.z[i]; });
}

HeightGrid opened(const HeightGrid& surface, std::size_t radius, const Execution& run) {
  HeightGrid low = eroded(surface, radius, stage(run, 0.0, 0.45));
  negate(low, stage(run, 0.45, 0.5));
  HeightGrid high = eroded(low, radius, stage(run, 0.5, 0.95));
  negate(high, stage(run, 0.95, 1.0));
  return high;
}

void fill(HeightGrid& surface, const Execution& run) {
  constexpr std::size_t kBlock = 16384;
  std::vector<std::size_t> holes;
  serial_for(surface.z.size(), kBlock, stage(run, 0.0, 0.1), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (std::isnan(surface.z[i])) holes.push_back(i);
    }
  });
  if (holes.empty() || holes.size() == surface.z.size()) return;
  HeightGrid coarse = coarser(surface, stage(run, 0.1, 0.2));
  fill(coarse, stage(run, 0.2, 0.4));
  parallel_for(holes.size(), kBlock, stage(run, 0.4, 0.5), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = holes[k], column = i % surface.columns, row = i / surface.columns;
      const auto x = static_cast<double>(column), y = static_cast<double>(row);
      surface.z[i] = coarse.interpolate(0.5 * (x - 0.5), 0.5 * (y - 0.5));
    }
  });
  smooth_holes(surface, holes, stage(run, 0.5, 1.0));
}

}  // namespace kappa
