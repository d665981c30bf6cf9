// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/output.hpp"

#include <utility>

#include "kappa/pipeline/fields.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

/// `places` are those of the points in the normals of the surface.
Scan points_and_normals(const SurfacedScan& surfaced, const std::vector<Index>& places, const Execution& run) {
  const Scan& in = surfaced.scan;
  Scan out;
  out.origin = in.origin;
  out.points = in.points;
  out.normals.resize(in.points.size());
  out.faces = in.faces;
  out.width = in.width;
  out.height = in.height;
  out.viewpoint = in.viewpoint;
  out.units = in.units;
  out.geographic = in.geographic;
  out.records = in.records;
  constexpr std::size_t kBlock = 4096;
  parallel_for(out.normals.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& u = surfaced.surface.u[places.empty() ? i : places[i]];
      out.normals[i] = u.isZero(0) ? Vec3::Constant(kNaN) : surfaced.filtered.heights.normal_of_file(u);
    }
  });
  return out;
}

void add_fields(std::vector<Field> more, const std::string& suffix, std::vector<Field>& fields) {
  for (Field& field : more) {
    field.name += suffix;
    fields.push_back(std::move(field));
  }
}

}  // namespace

Scan output_scan(const SurfacedScan& surfaced, const Execution& run) {
  return points_and_normals(surfaced, {}, run);
}

Scan output_scan(const ScanResult& result, const Execution& run) {
  Scan out = points_and_normals(result.prepared.surfaced, result.places, stage(run, 0.0, 0.3));
  for (std::size_t r = 0; r < result.fields.size(); ++r) {
    const std::string suffix = field_suffix(result, r);
    add_fields(curvature_fields(result.fields[r], "", result.places, stage(run, 0.3, 1.0)), suffix, out.fields);
    if (r < result.labels.size()) add_fields(segment_fields(result.labels[r].segmentation), suffix, out.fields);
  }
  return out;
}

std::string field_suffix(const ScanResult& result, std::size_t radius) {
  return result.fields.size() > 1 ? radius_suffix(result.fields[radius].radius) : "";
}

}  // namespace kappa
