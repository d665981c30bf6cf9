// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/accuracy.md as Markdown: accuracy_experiment [TABLE...], all of them without an argument.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <utility>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/curvature/own_scale.hpp"
#include "kappa/curvature/refine.hpp"
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

/// How a surface is split before it is measured.
struct Splitting {
  int levels;
  bool pn = false;  ///< on PN triangles
};

MeasuredTriangles split(const Subject& s, const Splitting& how) {
  if (how.levels == 0) return measure_triangles(s.mesh, s.u);
  if (!how.pn) return measure_refined(s.mesh, s.u, how.levels);
  return measure_refined(s.mesh, s.u, ShapeOperators(s.u.size(), Mat3::Constant(kNaN)), how.levels);
}

constexpr Splitting kSplittings[] = {{0}, {2, true}, {1}, {2}, {3}};

std::string name_of(const Splitting& how) {
  if (how.levels == 0) return "plain";
  return (how.pn ? "PN triangles, split " : "refined ") + std::to_string(how.levels) +
         (how.levels > 1 ? " times" : " time");
}

CurvatureOptions at(double radius, int order) {
  CurvatureOptions options;
  options.radii = {radius};
  options.order = order;
  return options;
}

void print_refined(const std::string& name, const Subject& s, double radius, int order) {
  for (const Splitting& how : kSplittings) {
    const MeasureTree balls(split(s, how));
    print_row(label(name, radius, order) + ", " + name_of(how),
              errors(estimate_curvatures(balls, s.u, at(radius, order), all_threads())[0], s.truth));
  }
}

void print_roughness(const char* name, const Subject& s) {
  std::printf("%s %.3f, ", name, normal_roughness(s.mesh, s.u));
}

void refine_table() {
  std::printf("\n## Curved refinement\n\n");
  print_head("surface, exact normals");
  print_refined("torus 100 x 100", torus(100), 0.5, 3);
  print_refined("torus_010000", cloud("torus_010000"), 1.6, 3);
  const Subject cloudy = cloud("goursat_010000");
  print_refined("goursat_010000", cloudy, 1.0, 2);
  print_refined("goursat_010000", cloudy, 0.9, 3);
  const Subject lidar = cloud("torus-lidar");
  print_refined("torus-lidar", lidar, 0.6, 2);
  print_refined("torus-lidar", lidar, 0.6, 3);
  const Subject mesh = goursat(0.25);
  print_refined("Goursat h = 0.25", mesh, 0.5, 2);
  print_refined("Goursat h = 0.25", mesh, 1.0, 3);
  const Subject noisy = noisy_torus(150, 0.3, 10);
  print_refined("torus 150 x 150, noise 0.3, 10 averagings", noisy, 1.5, 2);
  std::printf("\nroughness of the normals: ");
  print_roughness("Goursat h = 0.5", goursat(0.5));
  print_roughness("Goursat h = 0.25", mesh);
  print_roughness("torus_010000", cloud("torus_010000"));
  print_roughness("torus-lidar", lidar);
  print_roughness("noisy torus", noisy);
  std::printf("\n");
}

void polygons_table() {
  std::printf("\n## Curved refinement of polygons\n\n");
  print_head("surface, exact normals");
  const Subject nets = goursat_nets(0.5), quads = torus_of_quads(60), hexagons = joined(quads);
  print_refined("Goursat h = 0.5, surface nets, triangles", nets, 1, 3);
  print_refined("Goursat h = 0.5, surface nets, quads", joined(nets), 1, 3);
  print_refined("torus 60 x 60, triangles", torus(60), 0.5, 3);
  print_refined("torus 60 x 60, quads", quads, 0.5, 3);
  print_refined("torus 60 x 60, hexagons of two quads", hexagons, 0.5, 3);
  print_refined("torus 60 x 60, pentagons and triangles of two quads", trimmed(hexagons), 0.5, 3);
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Of one thread; bytes are those of the triangles with their tree.
struct Cost {
  double splitting, balls, bytes;
};

Cost cost(const Subject& s, const Splitting& how, double radius, int order) {
  const double start = cpu_seconds();
  MeasuredTriangles t = split(s, how);
  const double is_split = cpu_seconds();
  const double points = static_cast<double>(t.x.size() * 2 * sizeof(Vec3));
  const double parts =
      static_cast<double>(t.size() * (sizeof(t.corners[0]) + sizeof(t.measures[0]) + sizeof(t.faces[0])) +
                          t.weights.size() * sizeof(double));
  const MeasureTree balls(std::move(t));
  estimate_curvatures(balls, s.u, at(radius, order));
  return {is_split - start, cpu_seconds() - is_split, points + parts + static_cast<double>(balls.bytes())};
}

void print_cost(const std::string& name, const Subject& s, double radius, int order) {
  double plain = 0;
  for (const Splitting& how : kSplittings) {
    std::vector<double> splitting, balls;
    Cost c{};
    for (int run = 0; run < 5; ++run) {
      c = cost(s, how, radius, order);
      splitting.push_back(c.splitting);
      balls.push_back(c.balls);
    }
    const double to_split = percentile(splitting, 50), to_sum = percentile(balls, 50);
    if (how.levels == 0) plain = to_split + to_sum;
    std::printf("| %s, %s | %.1f | %.1f | %.1f | %.0f |\n", label(name, radius, order).c_str(), name_of(how).c_str(),
                to_split / plain, to_sum / plain, (to_split + to_sum) / plain,
                c.bytes / static_cast<double>(s.mesh.faces.size()));
    std::fflush(stdout);
  }
}

void cost_table() {
  std::printf("\n## Cost of refinement, in CPU times of the plain run\n\n");
  std::printf("| surface | splitting | tree and balls | all | bytes a face |\n|---|---|---|---|---|\n");
  print_cost("torus_010000", cloud("torus_010000"), 1.6, 3);
  print_cost("goursat_010000", cloud("goursat_010000"), 0.9, 3);
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
                       {"polygons", polygons_table},
                       {"cost", cost_table},
                       {"scale", scale_table}});
}
