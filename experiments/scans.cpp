// SPDX-License-Identifier: BSD-3-Clause
#include "scans.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/shapes/implicit.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa::experiments {
namespace {

TrueCurvature torus_truth(const Vec3& x, double major, double minor) {
  const double to_axis = std::hypot(x.x(), x.y());
  const double ring = (to_axis - major) / (minor * to_axis), tube = 1 / minor;
  TrueCurvature k;
  k.mean = 0.5 * (ring + tube);
  k.gaussian = ring * tube;
  k.k_min = std::min(ring, tube);
  k.k_max = std::max(ring, tube);
  return k;
}

TrueCurvature truth_at(const std::string& name, const Vec3& x) {
  return name.rfind("torus", 0) == 0 ? torus_truth(x, 6, 2) : surface_point(x, goursat_function(x)).curvature;
}

/// Seen from the other side.
TrueCurvature turned(const TrueCurvature& k) {
  TrueCurvature t;
  t.mean = -k.mean;
  t.gaussian = k.gaussian;
  t.k_min = -k.k_max;
  t.k_max = -k.k_min;
  return t;
}

/// Where the beam from the middle meets Goursat's surface: 3 q t^4 - 200 t^2 - 800 = 0 has one positive root.
Vec3 goursat_along(const Vec3& direction) {
  const double q = direction.array().pow(4).sum();
  const double t_sq = (200 + std::sqrt(200.0 * 200.0 + 4 * 3 * q * 800)) / (2 * 3 * q);
  return std::sqrt(t_sq) * direction;
}

constexpr double kSameLevel = 1e-4;

/// The lines of a grid that noisy values lie on, increasing: the least value of each.
std::vector<double> levels(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> found = {values.front()};
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] - values[i - 1] > kSameLevel) found.push_back(values[i]);
  }
  return found;
}

std::size_t level_of(double value, const std::vector<double>& levels) {
  return static_cast<std::size_t>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin()) - 1;
}

}  // namespace

KnownScan published_scan(const std::string& name) {
  const std::string path = std::string(KAPPA_CLOUDS) + "/" + name + ".pts";
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::FileNotFound, path + ": not found; the clouds of the tables belong there");
  KnownScan known;
  known.name = name;
  for (std::string line; std::getline(file, line);) {
    std::istringstream columns(line);
    Vec3 x, u;
    if (!(columns >> x[0] >> x[1] >> x[2] >> u[0] >> u[1] >> u[2])) continue;
    known.scan.points.push_back(x);
    known.scan.normals.push_back(u.normalized());
    known.truth.push_back(truth_at(name, x));
  }
  known.scan.width = known.scan.points.size();
  return known;
}

KnownScan with_noise(const KnownScan& known, double per_cent) {
  constexpr std::uint64_t kSeed = 1;
  KnownScan noisy = known;
  const double deviation = per_cent / 100 * bounds(known.scan.points).diagonal();
  Random random(kSeed);
  for (Vec3& x : noisy.scan.points) {
    for (int axis = 0; axis < 3; ++axis) x[axis] += deviation * random.normal();
  }
  return noisy;
}

KnownScan cut(const KnownScan& known) {
  KnownScan part;
  part.name = known.name + " cut";
  for (std::size_t i = 0; i < known.truth.size(); ++i) {
    const Vec3& x = known.scan.points[i];
    if (!(x.x() + 0.3 * x.y() > 0.7 && x.z() < 1.1)) continue;
    part.scan.points.push_back(x);
    part.scan.normals.push_back(known.scan.normals[i]);
    part.truth.push_back(known.truth[i]);
  }
  part.scan.width = part.scan.points.size();
  return part;
}

KnownScan organised_torus(const KnownScan& torus_lidar) {
  constexpr double kHeight = 30;
  const auto& points = torus_lidar.scan.points;
  std::vector<double> across, along;
  for (const Vec3& x : points) {
    across.push_back(x.x() / (kHeight - x.z()));
    along.push_back(x.y() / (kHeight - x.z()));
  }
  const std::vector<double> columns = levels(across), rows = levels(along);
  KnownScan grid;
  grid.name = torus_lidar.name;
  grid.scan.viewpoint = Vec3(0, 0, kHeight);
  grid.scan.width = columns.size();
  grid.scan.height = rows.size();
  const std::size_t cells = columns.size() * rows.size();
  grid.scan.points.assign(cells, Vec3::Constant(kNaN));
  grid.scan.normals.assign(cells, Vec3::Zero());
  grid.truth.resize(cells);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t cell = level_of(along[i], rows) * columns.size() + level_of(across[i], columns);
    if (is_finite(grid.scan.points[cell]))
      throw Error(ErrorCode::InvalidData, "torus-lidar: point " + std::to_string(i) + " shares its cell");
    grid.scan.points[cell] = points[i];
    grid.scan.normals[cell] = torus_lidar.scan.normals[i];
    grid.truth[cell] = torus_lidar.truth[i];
  }
  return grid;
}

KnownScan goursat_sweep(std::size_t rings, std::size_t columns) {
  KnownScan sweep;
  sweep.name = "goursat sweep";
  sweep.scan.viewpoint = Vec3::Zero();
  sweep.scan.width = columns;
  sweep.scan.height = rings;
  for (std::size_t cell = 0; cell < rings * columns; ++cell) {
    const double row = static_cast<double>(cell / columns) / static_cast<double>(rings - 1);
    const double elevation = kPi / 6 * (1 - 2 * row);
    const double azimuth = 2 * kPi * static_cast<double>(cell % columns) / static_cast<double>(columns);
    const Vec3 x = goursat_along(
        {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)});
    const SurfacePoint seen = surface_point(x, goursat_function(x));
    sweep.scan.points.push_back(x);
    sweep.scan.normals.push_back(-seen.normal);
    sweep.truth.push_back(turned(seen.curvature));
  }
  return sweep;
}

}  // namespace kappa::experiments
