// SPDX-License-Identifier: BSD-3-Clause
#include "subjects.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "kappa/core/error.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/search/cloud_normals.hpp"
#include "kappa/shapes/implicit.hpp"
#include "kappa/shapes/noise.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa::experiments {
namespace {

std::vector<TrueCurvature> truth_of(const Scan& scan) {
  std::vector<TrueCurvature> truth(scan.points.size());
  const auto fill = [&](const char* field, double TrueCurvature::*member) {
    for (std::size_t i = 0; i < truth.size(); ++i) truth[i].*member = scan.field(field)->values[i];
  };
  fill("mean_curvature", &TrueCurvature::mean);
  fill("gaussian_curvature", &TrueCurvature::gaussian);
  fill("k_min", &TrueCurvature::k_min);
  fill("k_max", &TrueCurvature::k_max);
  return truth;
}

Subject subject_of(const Scan& scan) {
  return {mesh_of(scan), scan.normals, truth_of(scan)};
}

Scan torus_scan(int n) {
  TorusOptions options;
  options.slices = options.sides = n;
  return torus(options);
}

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

Scan read_cloud(const std::string& name) {
  const std::string path = std::string(KAPPA_CLOUDS) + "/" + name + ".pts";
  std::ifstream file(path);
  if (!file) throw Error(ErrorCode::FileNotFound, path + ": not found; the clouds of the tables belong there");
  Scan scan;
  for (std::string line; std::getline(file, line);) {
    std::istringstream columns(line);
    Vec3 x, u;
    if (columns >> x[0] >> x[1] >> x[2] >> u[0] >> u[1] >> u[2]) {
      scan.points.push_back(x);
      scan.normals.push_back(u.normalized());
    }
  }
  scan.width = scan.points.size();
  return scan;
}

}  // namespace

Subject torus(int n) {
  return subject_of(torus_scan(n));
}

Subject noisy_torus(int n, double amount, int passes, std::uint64_t seed) {
  Scan scan = torus_scan(n);
  NoiseOptions noise;
  noise.amount = amount;
  noise.seed = seed;
  add_noise(scan, noise);
  Subject s = subject_of(scan);
  s.u = average_normals(s.mesh, vertex_normals(s.mesh, NormalWeights::Uniform), passes);
  return s;
}

Subject goursat(double h) {
  GoursatOptions options;
  options.step = h;
  return subject_of(kappa::goursat(options));
}

Subject cloud(const std::string& name, double noise) {
  Scan scan = read_cloud(name);
  Subject s;
  for (const Vec3& x : scan.points)
    s.truth.push_back(name.rfind("torus", 0) == 0 ? torus_truth(x, 6, 2)
                                                  : surface_point(x, goursat_function(x)).curvature);
  if (noise > 0) {
    const Normals exact = scan.normals;
    add_noise(scan, {NoiseKind::Normal, noise, 1, NoisyNormals::Keep, {}});
    SurfaceOptions options;
    options.normals = NormalsKind::Pca;
    options.orientation = Orientation::Up;
    Surface surface = make_surface(scan, options);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      if (surface.u[i].dot(exact[i]) < 0) surface.u[i] = -surface.u[i];
    }
    scan.normals = surface.u;
  }
  Surface surface = make_surface(scan, {});
  s.mesh = std::move(surface.mesh);
  s.u = std::move(surface.u);
  return s;
}

Errors errors(const CurvatureField& field, const std::vector<TrueCurvature>& truth) {
  Errors e;
  std::size_t n = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Curvatures& k = field.samples[i].k;
    if (k.status != PointStatus::Valid) {
      ++e.missing;
      continue;
    }
    ++n;
    const auto add = [](double& to, double error) { to += error * error; };
    add(e.mean, k.mean - truth[i].mean);
    add(e.gaussian, k.gaussian - truth[i].gaussian);
    add(e.k_min, k.k_min - truth[i].k_min);
    add(e.k_max, k.k_max - truth[i].k_max);
    e.max_mean = std::max(e.max_mean, std::abs(k.mean - truth[i].mean));
  }
  for (double* sum : {&e.mean, &e.gaussian, &e.k_min, &e.k_max}) *sum = std::sqrt(*sum / static_cast<double>(n));
  return e;
}

}  // namespace kappa::experiments
