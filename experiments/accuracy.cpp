// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/accuracy.md as Markdown: accuracy_experiment [TABLE...], all of them without an argument.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/mesh/measure_tree.hpp"
#include "kappa/mesh/refine.hpp"
#include "kappa/mesh/scale.hpp"
#include "kappa/mesh/statistics.hpp"
#include "subjects.hpp"
#include "tables.hpp"

namespace kappa::experiments {
namespace {

void print_head(const char* first) {
  std::printf("| %s | mean | gaussian | k_min | k_max | max of mean | no answer |\n", first);
  std::printf("|---|---|---|---|---|---|---|\n");
}

void print_row(const std::string& name, const Errors& e) {
  std::printf("| %s | %.1e | %.1e | %.1e | %.1e | %.1e | %zu |\n", name.c_str(), e.mean, e.gaussian, e.k_min, e.k_max,
              e.max_mean, e.missing);
  std::fflush(stdout);
}

std::string label(const std::string& name, double radius, int order) {
  char text[200];
  std::snprintf(text, sizeof(text), "%s, radius %g, order %d", name.c_str(), radius, order);
  return text;
}

Execution all_threads() {
  Execution run;
  run.threads = 0;
  return run;
}

/// One row a radius and order.
void print_orders(const std::string& name, const Subject& s, const std::vector<double>& radii) {
  const MeasureTree balls(measure_triangles(s.mesh, s.u));
  CurvatureOptions options;
  options.radii = radii;
  for (options.order = 1; options.order <= 3; ++options.order) {
    const auto fields = estimate_curvatures(balls, s.u, options, all_threads());
    for (const CurvatureField& f : fields) print_row(label(name, f.radius, options.order), errors(f, s.truth));
  }
}

void orders_table() {
  std::printf("\n## Orders on meshes\n\n");
  print_head("mesh, true normals");
  print_orders("torus 100 x 100", torus(100), {0.5, 1.0});
  print_orders("torus 150 x 150, noise 0.3, 10 averagings", noisy_torus(150, 0.3, 10), {1.0, 1.5});
}

void clouds_table() {
  std::printf("\n## Orders on clouds\n\n");
  print_head("cloud, umbrella surface, exact normals");
  print_orders("torus_010000", cloud("torus_010000"), {0.4, 0.8, 1.6, 2.4});
  print_orders("goursat_010000", cloud("goursat_010000"), {0.5, 1.0, 2.0});
  print_orders("torus-lidar", cloud("torus-lidar"), {0.6, 1.2});
}

void print_refined(const std::string& name, const Subject& s, double radius, int order) {
  for (const int levels : {0, 1, 2, 3}) {
    CurvatureOptions options;
    options.radii = {radius};
    options.order = order;
    options.refine = levels;
    char text[40];
    std::snprintf(text, sizeof(text), ", refined %d times", levels);
    print_row(label(name, radius, order) + text,
              errors(estimate_curvatures(s.mesh, s.u, options, all_threads())[0], s.truth));
  }
}

void refine_table() {
  std::printf("\n## Curved refinement\n\n");
  print_head("surface, exact normals");
  print_refined("torus 100 x 100", torus(100), 0.5, 3);
  print_refined("torus_010000", cloud("torus_010000"), 1.6, 3);
  const Subject cloudy = cloud("goursat_010000");
  print_refined("goursat_010000", cloudy, 1.0, 2);
  print_refined("goursat_010000", cloudy, 1.0, 3);
  print_refined("torus-lidar", cloud("torus-lidar"), 0.6, 2);
  const Subject mesh = goursat(0.25);
  print_refined("Goursat h = 0.25", mesh, 0.5, 2);
  print_refined("Goursat h = 0.25", mesh, 1.0, 3);
  print_refined("torus 150 x 150, noise 0.3, 10 averagings", noisy_torus(150, 0.3, 10), 1.5, 2);
  for (const double h : {0.5, 0.25})
    std::printf("\nroughness of the normals: Goursat h = %g %.3f", h, normal_roughness(goursat(h).mesh, goursat(h).u));
  const Subject noisy = noisy_torus(150, 0.3, 10);
  std::printf(", torus_010000 %.3f, noisy torus, 10 averagings %.3f\n",
              normal_roughness(cloud("torus_010000").mesh, cloud("torus_010000").u),
              normal_roughness(noisy.mesh, noisy.u));
}

/// What was chosen, its error, and the error that it was said to have over the true one.
void print_own_scale(const std::string& name, const Subject& s) {
  const MeasureTree balls(measure_triangles(s.mesh, s.u));
  const CurvatureField f = estimate_at_own_scale(balls, s.u, BallDefinition::ExactDensity, all_threads());
  std::vector<double> radii;
  double told = 0, truly = 0;
  for (std::size_t i = 0; i < f.samples.size(); ++i) {
    const CurvatureSample& sample = f.samples[i];
    if (!(sample.std_error >= 0)) continue;
    radii.push_back(sample.radius);
    told += sample.std_error * sample.std_error;
    truly += (std::pow(sample.k.mean - s.truth[i].mean, 2) + 0.5 * std::pow(sample.k.k_min - s.truth[i].k_min, 2) +
              0.5 * std::pow(sample.k.k_max - s.truth[i].k_max, 2)) /
             2;
  }
  char text[200];
  std::snprintf(text, sizeof(text), "%s: radius %.2g to %.2g, median %.2g; std_error / error %.2f", name.c_str(),
                percentile(radii, 5), percentile(radii, 95), percentile(radii, 50), std::sqrt(told / truly));
  print_row(text, errors(f, s.truth));
}

void scale_table() {
  std::printf("\n## Radius and order chosen for every point\n\n");
  print_head("surface: 5 to 95 % of the radii");
  print_own_scale("torus 100 x 100, true normals", torus(100));
  print_own_scale("Goursat h = 0.25, true normals", goursat(0.25));
  for (const double noise : {0.1, 0.3, 0.5})
    print_own_scale("torus 200 x 200, noise " + std::to_string(noise).substr(0, 3) + ", 4 averagings",
                    noisy_torus(200, noise, 4, 7));
  for (const std::uint64_t seed : {21, 22, 23, 24})
    print_own_scale("torus 200 x 200, noise 0.3, 4 averagings, seed " + std::to_string(seed),
                    noisy_torus(200, 0.3, 4, seed));
  print_own_scale("Goursat h = 0.25, noise 0.3, 4 averagings", noisy_goursat(0.25, 0.3, 4, 21));
  for (const char* name : {"torus_010000", "goursat_010000", "torus-lidar"}) {
    print_own_scale(name, cloud(name));
    // Extents are 16, 19.3 and 13.9.
    for (const double per_cent : {0.5, 1.0, 2.0}) {
      const double extent = name[0] == 'g' ? 19.3 : 16;
      print_own_scale(std::string(name) + ", noise " + std::to_string(per_cent).substr(0, 3) + " %, fitted normals",
                      cloud(name, per_cent / 100 * extent));
    }
  }
}

void plain_table() {
  std::printf("\n## Order 1\n\n");
  print_head("mesh");
  const Subject t = torus(200);
  CurvatureOptions options;
  print_row("torus 200 x 200, true normals, star",
            errors(estimate_curvatures(t.mesh, t.u, options, all_threads())[0], t.truth));
  const Subject g = goursat(0.125);
  options.radii = {std::sqrt(0.125)};
  print_row("Goursat h = 0.125, true normals, radius sqrt(h)",
            errors(estimate_curvatures(g.mesh, g.u, options, all_threads())[0], g.truth));
}

}  // namespace
}  // namespace kappa::experiments

int main(int argc, char** argv) {
  using namespace kappa::experiments;
  return print_tables(argc, argv,
                      {{"plain", plain_table},
                       {"orders", orders_table},
                       {"clouds", clouds_table},
                       {"refine", refine_table},
                       {"scale", scale_table}});
}
