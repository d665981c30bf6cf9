// SPDX-License-Identifier: BSD-3-Clause
#include "las_points.hpp"

#include <algorithm>

#include "kappa/core/error.hpp"
#include "kappa/mesh/gather.hpp"
#include "las_bytes.hpp"

namespace kappa {

namespace io {

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

LasRange range_of(const LasFile& las) {
  LasRange range;
  for (std::size_t i = 0; i < las.point_count(); ++i) {
    const LasPosition p = stored_position(las, i);
    if (i == 0) range = {p, p};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.min[axis] = std::min(range.min[axis], p[axis]);
      range.max[axis] = std::max(range.max[axis], p[axis]);
    }
  }
  return range;
}

void check_records(const Scan& scan) {
  if (!scan.las || scan.las->point_count() == scan.points.size()) return;
  throw Error(ErrorCode::InvalidArgument, "the scan has " + std::to_string(scan.points.size()) + " points and " +
                                              std::to_string(scan.las->point_count()) +
                                              " records of its LAS file: leave points out with keep_points, or reset "
                                              "Scan::las");
}

LasGrid local_grid(const LasFile& las) {
  const LasRange range = range_of(las);
  LasGrid grid;
  grid.scale = las.scale;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.centre[axis] = round_centre(range.min[axis], range.max[axis]);
    const auto i = static_cast<Eigen::Index>(axis);
    grid.origin[i] = static_cast<double>(grid.centre[axis]) * las.scale[i] + las.offset[i];
  }
  return grid;
}

}  // namespace io

namespace {

std::shared_ptr<const LasFile> picked(const LasFile& las, const std::vector<Index>& kept) {
  auto chosen = std::make_shared<LasFile>();
  chosen->header = las.header;
  chosen->format = las.format;
  chosen->record_length = las.record_length;
  chosen->scale = las.scale;
  chosen->offset = las.offset;
  chosen->records = las.records;
  chosen->gap = las.gap;
  chosen->extended = las.extended;
  chosen->waveform = las.waveform;
  chosen->points.reserve(kept.size() * las.record_length);
  for (const Index i : kept) chosen->points.append(las.points, i * las.record_length, las.record_length);
  return chosen;
}

void check_kept(const Scan& scan, const std::vector<Index>& kept) {
  if (scan.is_mesh()) {
    throw Error(ErrorCode::InvalidArgument, "points of a mesh cannot be left out: its faces need them; give a cloud");
  }
  const auto outside = std::find_if(kept.begin(), kept.end(), [&](Index i) { return i >= scan.points.size(); });
  if (outside != kept.end()) {
    throw Error(ErrorCode::InvalidArgument, "point " + std::to_string(*outside) + " cannot be kept: the scan has " +
                                                std::to_string(scan.points.size()) + "; give indices below that");
  }
}

}  // namespace

bool LasRecord::is(const std::string& user, std::uint16_t wanted) const {
  return id == wanted && user_id.substr(0, user_id.find('\0')) == user;
}

void keep_points(Scan& scan, const std::vector<Index>& kept) {
  io::check_records(scan);
  check_kept(scan, kept);
  if (scan.las) scan.las = picked(*scan.las, kept);
  scan.normals = gathered(scan.normals, kept);
  for (Field& field : scan.fields) field.values = gathered(field.values, kept);
  scan.points = gathered(scan.points, kept);
  scan.width = kept.size();
  scan.height = 1;
}

}  // namespace kappa
