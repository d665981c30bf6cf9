// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <functional>

namespace kappa::experiments {
namespace {

/// Curvatures with their errors and the median CPU time of some runs.
Row measure(const std::vector<TrueCurvature>& truth, int runs, const std::function<CurvatureField()>& compute) {
  std::vector<double> seconds;
  CurvatureField field;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t start = std::clock();
    field = compute();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::sort(seconds.begin(), seconds.end());
  const auto points = std::count_if(truth.begin(), truth.end(), [](const auto& k) { return !std::isnan(k.mean); });
  Row row;
  row.order = field.order;
  row.errors = errors(field, truth);
  row.points_per_second = static_cast<double>(points) / seconds[seconds.size() / 2];
  return row;
}

std::string setting_of(const CurvatureOptions& options) {
  if (options.scale == ScaleChoice::PerPoint) return "own scale of each point";
  std::string setting = text("radius %g, order %d", options.radii[0], options.order);
  if (options.refine > 0) setting += text(", refined %d", options.refine);
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

}  // namespace

std::string text(const char* format, ...) {
  char line[300];
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(line, sizeof(line), format, values);
  va_end(values);
  return line;
}

std::string speed(const Row& row) {
  const double unit = std::pow(10.0, std::floor(std::log10(row.points_per_second)) - 1);
  std::string digits = text("%.0f", std::round(row.points_per_second / unit) * unit);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

Oriented with_exact_normals(const KnownScan& known) {
  return {known, known.scan.normals, automatic_radius(make_surface(known.scan, umbrella_with(NormalsKind::Input))),
          "exact normals"};
}

Oriented with_fitted_normals(const KnownScan& known, SurfaceOptions options) {
  options.surface = SurfaceKind::Umbrella;
  options.normals = NormalsKind::Quadric;
  Surface surface = make_surface(known.scan, options);
  const double wrong = correct_signs(known.scan.normals, surface.u);
  const std::string fit = surface.normal_radius > 0 ? text("quadrics within %.2g", surface.normal_radius)
                                                    : text("quadrics of %d points", surface.normal_neighbours);
  return {known, surface.u, automatic_radius(surface), fit + text(" (own signs: %.2g %% wrong)", 100 * wrong)};
}

KnownScan rotated(const KnownScan& known, const Mat3& rotation) {
  KnownScan turned = known;
  for (Vec3& x : turned.scan.points) x = rotation * x;
  for (Vec3& u : turned.scan.normals) u = rotation * u;
  return turned;
}

Row scheme_row(const Oriented& cloud, TriangleScheme scheme, int neighbours) {
  Row row = measure(cloud.known.truth, cloud.runs, [&] {
    return random_triangle_curvatures(cloud.known.scan.points, cloud.u, {scheme, neighbours, 100});
  });
  row.surface = name(scheme);
  row.setting = text("K = %d", neighbours);
  return row;
}

Row umbrella_row(const Oriented& cloud, const CurvatureOptions& options) {
  Row row = measure(cloud.known.truth, cloud.runs, [&] {
    const CloudSurface surface = umbrella_surface(Vec3::Zero(), cloud.known.scan.points, cloud.u, {});
    return estimate_curvatures(surface.mesh, cloud.u, options)[0];
  });
  row.surface = "umbrella";
  row.setting = setting_of(options);
  row.refine = options.refine;
  return row;
}

Row surface_row(const KnownScan& known, SurfaceKind kind, NormalsKind normals, const CurvatureOptions& options) {
  SurfaceOptions how;
  how.surface = kind;
  how.normals = normals;
  Row row = measure(known.truth, 3, [&] {
    const Surface surface = make_surface(known.scan, how);
    return estimate_curvatures(surface.mesh, surface.u, options)[0];
  });
  row.surface = std::string(name(kind)) + (normals == NormalsKind::Input ? ", exact normals" : ", normals of faces");
  row.setting = setting_of(options);
  return row;
}

std::string table(const std::string& title, const std::vector<Row>& rows) {
  std::string out = "\n" + title + "\n\n| surface | setting | mean | gaussian | k_min | k_max | none | points/s |\n" +
                    "|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const Errors& e = row.errors;
    out += "| " + row.surface + " | " + row.setting;
    out += text(" | %.1e / %.1e", e.mean, e.max_mean) + text(" | %.1e / %.1e", e.gaussian, e.max_gaussian);
    out += text(" | %.1e / %.1e", e.k_min, e.max_k_min) + text(" | %.1e / %.1e", e.k_max, e.max_k_max);
    out += text(" | %zu | ", e.missing) + speed(row) + " |\n";
  }
  return out;
}

}  // namespace kappa::experiments
