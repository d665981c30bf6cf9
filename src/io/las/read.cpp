// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <algorithm>
#include <cmath>

#include "coordinate_system.hpp"
#include "dimensions.hpp"
#include "length_units.hpp"
#include "parse.hpp"
#include "points.hpp"

namespace kappa::io {

namespace {

std::vector<double> values_of(const LasFile& las, const LasDimension& dimension) {
  std::vector<double> values;
  values.reserve(las.point_count());
  for (std::size_t at = 0; at < las.points.size(); at += las.record_length) {
    values.push_back(load(las.points.data() + at, dimension));
  }
  return values;
}

std::vector<Field> fields_of(const std::string& path, const LasFile& las) {
  std::vector<Field> fields;
  for (const LasDimension& dimension : dimensions_of(path, las)) {
    const bool shown = dimension.common || is_used(las, dimension);
    if (shown) fields.push_back({dimension.name, dimension.field_type(), values_of(las, dimension)});
  }
  return fields;
}

/// Takes the field called `name` off the list; empty if there is none.
std::vector<double> take(std::vector<Field>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  if (found == fields.end()) return {};
  std::vector<double> values = std::move(found->values);
  fields.erase(found);
  return values;
}

Normals take_normals(std::vector<Field>& fields) {
  const std::vector<double> x = take(fields, "nx"), y = take(fields, "ny"), z = take(fields, "nz");
  Normals normals(x.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = Vec3(x[i], y[i], z[i]);
  return normals;
}

void check_extent(const std::string& path, const LasFile& las, const LasGrid& grid) {
  const LasRange range = range_of(las);
  for (int axis = 0; axis < 3 && las.point_count() > 0; ++axis) {
    for (const std::int32_t end : {range.min[axis], range.max[axis]}) {
      if (std::isfinite(grid.local(end, axis)) && std::isfinite(grid.origin[axis] + grid.local(end, axis))) continue;
      refuse(path, "its scale of " + std::to_string(las.scale[axis]) +
                       " puts coordinates out of the range of a double: "
                       "correct the header");
    }
  }
}

}  // namespace

Scan read_las(const FileBytes& file) {
  auto las = std::make_shared<LasFile>(parse_las(file));
  const LasGrid grid = local_grid(*las);
  check_extent(file.path, *las, grid);
  Scan scan;
  scan.origin = grid.origin;
  scan.points.reserve(las->point_count());
  for (std::size_t i = 0; i < las->point_count(); ++i) scan.points.push_back(grid.local(stored_position(*las, i)));
  scan.fields = fields_of(file.path, *las);
  scan.normals = take_normals(scan.fields);
  scan.units = length_units(*las);
  scan.geographic = states_degrees(*las);
  scan.records = std::move(las);
  return scan;
}

}  // namespace kappa::io
