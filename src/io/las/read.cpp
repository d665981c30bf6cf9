// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <algorithm>
#include <cmath>

#include "coordinate_system.hpp"
#include "dimensions.hpp"
#include "io/pace.hpp"
#include "length_units.hpp"
#include "parse.hpp"
#include "points.hpp"

namespace kappa::io {

namespace {

std::vector<double> values_of(const LasFile& las, const LasDimension& dimension, const Execution& run) {
  std::vector<double> values;
  values.reserve(las.point_count());
  const char* const points = las.points.data();
  for_each_row(las.point_count(), run,
               [&](std::size_t i) { values.push_back(load(points + i * las.record_length, dimension)); });
  return values;
}

std::vector<Field> fields_of(const std::string& path, const LasFile& las, const Execution& run) {
  std::vector<Field> fields;
  const std::vector<LasDimension> dimensions = dimensions_of(path, las, silent(run));
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    const LasDimension& dimension = dimensions[k];
    if (!dimension.common && !is_used(las, dimension, silent(run))) continue;
    std::vector<double> values = values_of(las, dimension, part(run, k, dimensions.size()));
    fields.push_back({dimension.name, dimension.field_type(), std::move(values)});
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

Normals take_normals(std::vector<Field>& fields, const Execution& run) {
  const std::vector<double> x = take(fields, "nx"), y = take(fields, "ny"), z = take(fields, "nz");
  Normals normals(x.size());
  for_each_row(normals.size(), run, [&](std::size_t i) { normals[i] = Vec3(x[i], y[i], z[i]); });
  return normals;
}

void check_extent(const std::string& path, const LasFile& las, const LasGrid& grid, const LasRange& range) {
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

Scan read_las(const FileBytes& file, const Execution& run) {
  auto las = std::make_shared<LasFile>(parse_las(file, stage(run, 0.0, 0.2)));
  const LasRange range = range_of(*las, stage(run, 0.2, 0.25));
  const LasGrid grid = local_grid(*las, range);
  check_extent(file.path, *las, grid, range);
  Scan scan;
  scan.origin = grid.origin;
  scan.points.reserve(las->point_count());
  for_each_row(las->point_count(), stage(run, 0.25, 0.4),
               [&](std::size_t i) { scan.points.push_back(grid.local(stored_position(*las, i))); });
  scan.fields = fields_of(file.path, *las, stage(run, 0.4, 0.95));
  scan.normals = take_normals(scan.fields, stage(run, 0.95, 1.0));
  scan.units = length_units(*las);
  scan.geographic = states_degrees(*las);
  scan.records = std::move(las);
  return scan;
}

}  // namespace kappa::io
