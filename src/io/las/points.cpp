// SPDX-License-Identifier: BSD-3-Clause
#include "points.hpp"

#include <algorithm>

#include "bytes.hpp"
#include "io/pace.hpp"

namespace kappa::io {

namespace {

/// The multiple of the largest power of ten within the extent that is nearest to the middle: decimal
/// scales then give a decimal origin, and no point is far from it.
std::int64_t round_centre(std::int64_t min, std::int64_t max) {
  std::int64_t unit = 1;
  while (unit * 10 <= max - min) unit *= 10;
  const std::int64_t middle = min + (max - min) / 2;
  const std::int64_t below = middle - ((middle % unit) + unit) % unit;
  return middle - below > unit / 2 ? below + unit : below;
}

}  // namespace

LasPosition stored_position(const LasFile& las, std::size_t point) {
  const std::size_t at = point * las.record_length;
  return {get_int32(las.points, at), get_int32(las.points, at + 4), get_int32(las.points, at + 8)};
}

LasRange range_of(const LasFile& las, const Execution& run) {
  LasRange range;
  for_each_row(las.point_count(), run, [&](std::size_t i) {
    const LasPosition p = stored_position(las, i);
    if (i == 0) range = {p, p};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.min[axis] = std::min(range.min[axis], p[axis]);
      range.max[axis] = std::max(range.max[axis], p[axis]);
    }
  });
  return range;
}

LasGrid local_grid(const LasFile& las, const LasRange& range) {
  LasGrid grid;
  grid.scale = las.scale;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.centre[axis] = round_centre(range.min[axis], range.max[axis]);
    const auto i = static_cast<Eigen::Index>(axis);
    grid.origin[i] = static_cast<double>(grid.centre[axis]) * las.scale[i] + las.offset[i];
  }
  return grid;
}

}  // namespace kappa::io
