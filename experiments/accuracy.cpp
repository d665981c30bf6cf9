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
#include "subjects.hpp"

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

const std::vector<std::pair<std::string, std::function<void()>>>& tables() {
  static const std::vector<std::pair<std::string, std::function<void()>>> all = {
      {"plain", plain_table}, {"orders", orders_table}, {"clouds", clouds_table}};
  return all;
}

}  // namespace
}  // namespace kappa::experiments

int main(int argc, char** argv) {
  using namespace kappa::experiments;
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  try {
    for (const auto& [name, print] : tables()) {
      const bool chosen = std::find(wanted.begin(), wanted.end(), name) != wanted.end();
      if (wanted.empty() || chosen) print();
    }
  } catch (const kappa::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
