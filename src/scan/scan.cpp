// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/scan/scan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

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

Mesh mesh_of(const Scan& scan) {
  if (!scan.is_mesh()) throw Error(ErrorCode::InvalidData, "the data has no faces; triangulate the points first");
  Mesh mesh;
  mesh.origin = scan.origin;
  mesh.vertices = scan.points;
  mesh.faces = scan.faces;
  return mesh;
}

void keep_points(Scan& scan, const std::vector<Index>& kept) {
  check_records(scan);
  check_kept(scan, kept);
  if (scan.records) scan.records = scan.records->picked(kept);
  scan.normals = gathered(scan.normals, kept);
  for (Field& field : scan.fields) field.values = gathered(field.values, kept);
  scan.points = gathered(scan.points, kept);
  scan.width = kept.size();
  scan.height = 1;
}

}  // namespace kappa
