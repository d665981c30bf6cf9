// SPDX-License-Identifier: BSD-3-Clause
#include "subjects.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/shapes/noise.hpp"
#include "kappa/surface/surface.hpp"
#include "scans.hpp"

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

Subject with_mesh_noise(Scan scan, double amount, int passes, std::uint64_t seed) {
  NoiseOptions noise;
  noise.amount = amount;
  noise.seed = seed;
  add_noise(scan, noise);
  Subject s = subject_of(scan);
  s.u = average_normals(s.mesh, vertex_normals(s.mesh, NormalWeights::Uniform), passes);
  return s;
}

/// The corners of `a` and then those of `b` around them.
std::vector<Index> join(const Faces::View& a, const Faces::View& b) {
  const auto at = [](const Faces::View& face, std::size_t i) { return face[i % face.size()]; };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (at(a, i) != at(b, j + 1) || at(a, i + 1) != at(b, j)) continue;
      std::vector<Index> corners;
      for (std::size_t k = 1; k <= a.size(); ++k) corners.push_back(at(a, i + k));
      for (std::size_t k = 2; k < b.size(); ++k) corners.push_back(at(b, j + k));
      return corners;
    }
  }
  throw Error{ErrorCode::InvalidArgument, "two faces share no edge: give faces that follow their neighbours"};
}

}  // namespace

Subject torus(int n) {
  return subject_of(torus_scan(n));
}

Subject noisy_torus(int n, double amount, int passes, std::uint64_t seed) {
  return with_mesh_noise(torus_scan(n), amount, passes, seed);
}

Subject goursat(double h) {
  GoursatOptions options;
  options.step = h;
  return subject_of(kappa::goursat(options));
}

Subject goursat_nets(double h) {
  GoursatOptions options;
  options.step = h;
  options.extraction = Extraction::SurfaceNets;
  return subject_of(kappa::goursat(options));
}

Subject torus_of_quads(int n) {
  TorusOptions options;
  options.slices = options.sides = n;
  options.faces = GridFaces::Quads;
  return subject_of(torus(options));
}

Subject joined(Subject s) {
  Faces faces;
  for (std::size_t f = 0; f + 1 < s.mesh.faces.size(); f += 2) faces.add(join(s.mesh.faces[f], s.mesh.faces[f + 1]));
  s.mesh.faces = faces;
  return s;
}

Subject trimmed(Subject s) {
  Faces faces;
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const Faces::View face = s.mesh.faces[f];
    std::vector<Index> rest(face.begin(), face.end());
    rest.erase(rest.begin() + 1);
    faces.add(rest);
    faces.add(face[0], face[1], face[2]);
  }
  s.mesh.faces = faces;
  return s;
}

Subject noisy_goursat(double h, double amount, int passes, std::uint64_t seed) {
  GoursatOptions options;
  options.step = h;
  return with_mesh_noise(kappa::goursat(options), amount, passes, seed);
}

Subject cloud(const std::string& name, double noise) {
  KnownScan known = published_scan(name);
  Scan& scan = known.scan;
  Subject s;
  s.truth = std::move(known.truth);
  if (noise > 0) {
    const Normals exact = scan.normals;
    add_noise(scan, {NoiseKind::Normal, noise, 1, NoisyNormals::Keep, {}});
    SurfaceOptions options;
    options.normals = NormalsKind::Quadric;
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
    if (std::isnan(truth[i].mean)) continue;
    const Curvatures& k = field.samples[i].k;
    if (k.status != PointStatus::Valid) {
      ++e.missing;
      continue;
    }
    ++n;
    const auto add = [](double& sum_sq, double& max, double error) {
      sum_sq += error * error;
      max = std::max(max, std::abs(error));
    };
    add(e.mean, e.max_mean, k.mean - truth[i].mean);
    add(e.gaussian, e.max_gaussian, k.gaussian - truth[i].gaussian);
    add(e.k_min, e.max_k_min, k.k_min - truth[i].k_min);
    add(e.k_max, e.max_k_max, k.k_max - truth[i].k_max);
  }
  for (double* sum : {&e.mean, &e.gaussian, &e.k_min, &e.k_max}) *sum = std::sqrt(*sum / static_cast<double>(n));
  return e;
}

}  // namespace kappa::experiments
