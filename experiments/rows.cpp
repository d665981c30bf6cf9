// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <functional>

#include "tables.hpp"

namespace kappa::experiments {
namespace {

/// Adds the errors of what `compute` returns, and the median CPU time of some runs.
void measure(const std::vector<TrueCurvature>& truth, int runs, const std::function<CurvatureField()>& compute,
             Row& row) {
  std::vector<double> seconds;
  CurvatureField field;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    field = compute();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  const auto points = std::count_if(truth.begin(), truth.end(), [](const auto& k) { return !std::isnan(k.mean); });
  row.errors = errors(field, truth);
  row.points_per_second = static_cast<double>(points) / seconds[seconds.size() / 2];
}

std::string setting_of(const CurvatureOptions& options, int refine) {
  if (options.scale == ScaleChoice::PerPoint) return "own scale of each point";
  std::string setting = text("radius %g, order %d", options.radii[0], options.order.value_or(1));
  if (refine > 0) setting += text(", refined %d", refine);
  return setting;
}

SurfaceOptions umbrella_with(NormalsKind normals) {
  SurfaceOptions options;
  options.surface = SurfaceKind::Umbrella;
  options.normals = normals;
  return options;
}

/// Makes the signs those of the exact normals; returns the share that had another, or of the others if that is less:
/// one sign for all is a matter of convention.
double correct_signs(const Normals& exact, Normals& u) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (u[i].dot(exact[i]) >= 0) continue;
    u[i] = -u[i];
    ++wrong;
  }
  return static_cast<double>(std::min(wrong, u.size() - wrong)) / static_cast<double>(u.size());
}

double speed(const Row& row) {
  const double unit = std::pow(10.0, std::floor(std::log10(row.points_per_second)) - 1);
  return std::round(row.points_per_second / unit) * unit;
}

/// A row of a cloud, without its errors.
Row row_of(const Oriented& cloud, const std::string& surface, const std::string& setting) {
  Row row;
  row.normals = cloud.normals;
  row.wrong_signs = cloud.wrong_signs;
  row.surface = surface;
  row.setting = setting;
  return row;
}

}  // namespace

std::string text(const char* format, ...) {
  char line[300];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof(line), format, values);
  va_end(values);
  return line;
}

Oriented with_exact_normals(const KnownScan& known) {
  return {known, known.scan.normals, automatic_radius(make_surface(known.scan, umbrella_with(NormalsKind::Input))),
          "exact normals", ""};
}

Oriented with_fitted_normals(const KnownScan& known, SurfaceOptions options) {
  options.surface = SurfaceKind::Umbrella;
  options.normals = NormalsKind::Quadric;
  Surface surface = make_surface(known.scan, options);
  const double wrong = correct_signs(known.scan.normals, surface.u);
  const std::string fit = surface.normal_radius > 0 ? text("quadrics within %.2g", surface.normal_radius)
                                                    : text("quadrics of %d points", surface.normal_neighbours);
  return {known, surface.u, automatic_radius(surface), fit, text("%.2g", 100 * wrong)};
}

KnownScan rotated(const KnownScan& known, const Mat3& rotation) {
  KnownScan turned = known;
  for (Vec3& x : turned.scan.points) x = rotation * x;
  for (Vec3& u : turned.scan.normals) u = rotation * u;
  return turned;
}

Row scheme_row(const Oriented& cloud, TriangleScheme scheme, int neighbours) {
  Row row = row_of(cloud, name(scheme), text("K = %d", neighbours));
  const auto compute = [&] {
    return random_triangle_curvatures(cloud.known.scan.points, cloud.u, {scheme, neighbours, 100});
  };
  measure(cloud.known.truth, cloud.runs, compute, row);
  return row;
}

Row umbrella_row(const Oriented& cloud, const CurvatureOptions& options, int refine) {
  MeasureOptions splitting;
  splitting.refine = refine;
  Row row = row_of(cloud, "umbrella", setting_of(options, refine));
  const auto compute = [&] {
    const CloudSurface surface = umbrella_surface(Vec3::Zero(), cloud.known.scan.points, cloud.u, {});
    return estimate_curvatures(surface.mesh, cloud.u, options, splitting)[0];
  };
  measure(cloud.known.truth, cloud.runs, compute, row);
  return row;
}

Row surface_row(const KnownScan& known, SurfaceKind kind, NormalsKind normals, const CurvatureOptions& options) {
  SurfaceOptions how;
  how.surface = kind;
  how.normals = normals;
  Row row;
  row.normals = normals == NormalsKind::Input ? "exact normals" : "normals of faces";
  row.surface = name(kind);
  row.setting = setting_of(options, 0);
  const auto compute = [&] {
    const Surface surface = make_surface(known.scan, how);
    return estimate_curvatures(surface.mesh, surface.u, options)[0];
  };
  measure(known.truth, 3, compute, row);
  return row;
}

void print_columns() {
  std::printf("cloud,noise_percent,normals,wrong_signs_percent,surface,setting,mean,max_mean,gaussian,max_gaussian,");
  std::printf("k_min,max_k_min,k_max,max_k_max,missing,points_per_second\n");
}

void print_rows(const std::string& cloud, double noise_percent, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const Errors& e = row.errors;
    std::printf("%s,%g,%s,%s,", quoted(cloud).c_str(), noise_percent, quoted(row.normals).c_str(),
                row.wrong_signs.c_str());
    std::printf("%s,%s,", row.surface.c_str(), quoted(row.setting).c_str());
    std::printf("%.1e,%.1e,%.1e,%.1e,", e.mean, e.max_mean, e.gaussian, e.max_gaussian);
    std::printf("%.1e,%.1e,%.1e,%.1e,", e.k_min, e.max_k_min, e.k_max, e.max_k_max);
    std::printf("%zu,%.0f\n", e.missing, speed(row));
  }
  std::fflush(stdout);
}

}  // namespace kappa::experiments
