// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/scan.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/gather.hpp"

namespace kappa {
namespace {

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

void check_records(const Scan& scan) {
  if (!scan.records || scan.records->point_count() == scan.points.size()) return;
  throw Error(ErrorCode::InvalidArgument, "the scan has " + std::to_string(scan.points.size()) + " points and " +
                                              std::to_string(scan.records->point_count()) +
                                              " records of its file: leave points out with keep_points, or reset "
                                              "Scan::records");
}

double LengthUnits::z_scale() const {
  constexpr double kSame = 1e-4;
  if (!horizontal || !vertical) return 1;
  const double ratio = *vertical / *horizontal;
  return std::abs(ratio - 1) < kSame ? 1 : ratio;
}

const Field* Scan::field(const std::string& name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void move_to_local_origin(Scan& scan) {
  const Vec3 shift = choose_origin(bounds(scan.points));
  if (shift.isZero(0)) return;
  for (Vec3& p : scan.points) p -= shift;
  scan.origin += shift;
}

Mesh mesh_of(const Scan& scan, const Execution& run) {
  if (!scan.is_mesh()) throw Error(ErrorCode::InvalidData, "the data has no faces; triangulate the points first");
  Mesh mesh;
  mesh.origin = scan.origin;
  mesh.vertices = scan.points;
  report_progress(run, 0.3);
  mesh.faces = scan.faces;
  report_progress(run, 1.0);
  return mesh;
}

void keep_points(Scan& scan, const std::vector<Index>& kept, const Execution& run) {
  check_records(scan);
  check_kept(scan, kept);
  double part = 0;
  const double parts = static_cast<double>(scan.fields.size() + 3);
  const auto next = [&] {
    const double from = part++;
    return stage(run, from / parts, part / parts);
  };
  // All that is kept is gathered beside the scan first: whoever cancels finds the scan as it was.
  const auto records = scan.records ? scan.records->picked(kept, next()) : nullptr;
  Normals normals = gathered(scan.normals, kept, next());
  std::vector<Vec3> points = gathered(scan.points, kept, next());
  std::vector<std::vector<double>> values;
  for (const Field& field : scan.fields) values.push_back(gathered(field.values, kept, next()));
  report_progress(run, 1.0);

  scan.records = records;
  scan.normals = std::move(normals);
  scan.points = std::move(points);
  for (std::size_t f = 0; f < values.size(); ++f) scan.fields[f].values = std::move(values[f]);
  scan.width = kept.size();
  scan.height = 1;
}

}  // namespace kappa
