// SPDX-License-Identifier: BSD-3-Clause
#include "columns.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "file_bytes.hpp"
#include "pace.hpp"
#include "text.hpp"

namespace kappa::io {

namespace {

using Triple = std::array<std::size_t, 3>;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The column called `name`, else the first called so in another case.
std::size_t find_column(const std::vector<Field>& columns, const std::string& name) {
  std::size_t found = kNone;
  for (std::size_t i = columns.size(); i-- > 0;) {
    if (columns[i].name == name) return i;
    if (lower(columns[i].name) == name) found = i;
  }
  return found;
}

Triple find_triple(const std::vector<Field>& columns, const std::array<const char*, 3>& names) {
  Triple triple;
  for (std::size_t i = 0; i < 3; ++i) triple[i] = find_column(columns, names[i]);
  return triple;
}

bool complete(const Triple& t) {
  return t[0] != kNone && t[1] != kNone && t[2] != kNone;
}

std::vector<Vec3> gather(const std::vector<Field>& columns, const Triple& t, const Execution& run) {
  std::vector<Vec3> vectors(columns[t[0]].values.size());
  const double *x = columns[t[0]].values.data(), *y = columns[t[1]].values.data(), *z = columns[t[2]].values.data();
  for_each_row(vectors.size(), run, [&](std::size_t i) { vectors[i] = Vec3(x[i], y[i], z[i]); });
  return vectors;
}

void check_names(const std::string& path, const std::vector<Field>& columns) {
  std::set<std::string> names;
  for (const Field& column : columns) {
    if (!names.insert(column.name).second) refuse(path, "has two columns " + in_quotes(column.name) + ": rename one");
  }
}

Triple find_position(const std::string& path, const std::vector<Field>& columns) {
  const Triple position = find_triple(columns, {"x", "y", "z"});
  for (std::size_t i = 0; i < 3; ++i) {
    if (position[i] == kNone) {
      refuse(path, std::string("its points have no ") + "xyz"[i] + ": name the coordinates x, y and z");
    }
  }
  return position;
}

}  // namespace

Scan scan_from_columns(const std::string& path, std::vector<Field> columns, const Execution& run) {
  check_names(path, columns);
  const Triple position = find_position(path, columns);
  Triple normal = find_triple(columns, {"nx", "ny", "nz"});
  if (!complete(normal)) normal = find_triple(columns, {"normal_x", "normal_y", "normal_z"});
  Scan scan;
  scan.points = gather(columns, position, stage(run, 0.0, 0.5));
  if (complete(normal)) scan.normals = gather(columns, normal, stage(run, 0.5, 1.0));
  const auto in = [](const Triple& t, std::size_t i) { return std::find(t.begin(), t.end(), i) != t.end(); };
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (in(position, i) || (complete(normal) && in(normal, i))) continue;
    scan.fields.push_back(std::move(columns[i]));
  }
  return scan;
}

void finish(const std::string& path, Scan& scan) {
  if (scan.points.empty()) refuse(path, "holds no point: there is nothing to measure");
  if (std::none_of(scan.points.begin(), scan.points.end(), is_finite)) {
    refuse(path, "holds no point with finite coordinates: there is nothing to measure");
  }
  // One column or one row of points is a list, not a grid.
  if (scan.width <= 1 || scan.height <= 1) {
    scan.width = scan.points.size();
    scan.height = 1;
  }
  move_to_local_origin(scan);
}

void check_count(const std::string& path, std::size_t count) {
  if (count >= kNoIndex) {
    refuse(path, "promises " + std::to_string(count) + " points, more than the " + std::to_string(kNoIndex - 1) +
                     " that can be read: split it");
  }
}

}  // namespace kappa::io
