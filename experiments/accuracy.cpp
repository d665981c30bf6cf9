// SPDX-License-Identifier: BSD-3-Clause
// Prints a table of errors on surfaces of known curvature as CSV: accuracy_experiment TABLE. README.md lists the
// tables.
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
#include "kappa/curvature/shape_operators.hpp"
#include "subjects.hpp"
#include "tables.hpp"

namespace kappa::experiments {
namespace {

constexpr const char* kErrorColumns = "mean,gaussian,k_min,k_max,max_mean,missing";

/// The last cells of a row.
void print_errors(const Errors& e) {
  std::printf("%.1e,%.1e,%.1e,%.1e,%.1e,%zu\n", e.mean, e.gaussian, e.k_min, e.k_max, e.max_mean, e.missing);
  std::fflush(stdout);
}

/// The first cells of a row, and their names.
constexpr const char* kSettingColumns = "surface,radius,order,splitting";
void print_setting(const std::string& surface, double radius, int order, const std::string& splitting) {
  std::printf("%s,%g,%d,%s,", quoted(surface).c_str(), radius, order, quoted(splitting).c_str());
}

void print_head() {
  std::printf("%s,%s\n", kSettingColumns, kErrorColumns);
}

Execution all_threads() {
  Execution run;
  run.threads = 0;
  return run;
}

constexpr const char* kNoisyTorus = "torus 150 x 150, noise 0.3, 10 averagings";
Subject rough_torus() {
  return noisy_torus(150, 0.3, 10);
}

/// One row a radius and order.
void print_orders(const std::string& name, const Subject& s, const std::vector<double>& radii) {
  const MeasureTree balls(triangles_of(s.mesh, s.u));
  CurvatureOptions options;
  options.radii = radii;
  for (const int order : {1, 2, 3}) {
    options.order = order;
    const auto fields = estimate_curvatures(balls, s.u, options, all_threads());
    for (const CurvatureField& f : fields) {
      print_setting(name, f.radius, order, "plain");
      print_errors(errors(f, s.truth));
    }
  }
}

void print_plain() {
  const Subject t = torus(200);
  print_setting("torus 200 x 200, star", 0, 1, "plain");
  print_errors(errors(estimate_curvatures(t.mesh, t.u, {}, all_threads())[0], t.truth));
  const Subject g = goursat(0.125);
  CurvatureOptions options;
  options.radii = {std::sqrt(0.125)};
  print_setting("Goursat h = 0.125", options.radii[0], 1, "plain");
  print_errors(errors(estimate_curvatures(g.mesh, g.u, options, all_threads())[0], g.truth));
}

void orders_table() {
  print_head();
  print_plain();
  print_orders("torus 100 x 100", torus(100), {0.5, 1.0});
  print_orders(kNoisyTorus, rough_torus(), {1.0, 1.5});
  print_orders("torus_010000", cloud("torus_010000"), {0.4, 0.8, 1.6, 2.4});
  print_orders("goursat_010000", cloud("goursat_010000"), {0.5, 1.0, 2.0});
  print_orders("torus-lidar", cloud("torus-lidar"), {0.6, 1.2});
}

/// How a surface is split before it is measured.
struct Splitting {
  int levels;
  bool pn = false;  ///< on PN triangles
};

Triangles split(const Subject& s, const Splitting& how) {
  if (how.levels == 0) return triangles_of(s.mesh, s.u);
  if (!how.pn) return refined_triangles(s.mesh, s.u, how.levels);
  return refined_triangles(s.mesh, s.u, ShapeOperators(s.u.size(), Mat3::Constant(kNaN)), how.levels);
}

constexpr Splitting kSplittings[] = {{0}, {2, true}, {1}, {2}, {3}};

std::string name_of(const Splitting& how) {
  if (how.levels == 0) return "plain";
  constexpr const char* kTimes[] = {"", "once", "twice", "three times"};
  return std::string(how.pn ? "PN triangles, split " : "refined ") + kTimes[how.levels];
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
    print_setting(name, radius, order, name_of(how));
    print_errors(errors(estimate_curvatures(balls, s.u, at(radius, order), all_threads())[0], s.truth));
  }
}

void print_roughness(const char* name, const Subject& s) {
  std::printf("%s,%.3f\n", quoted(name).c_str(), normal_roughness(s.mesh, s.u));
}

void refine_table() {
  print_head();
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
  print_refined(kNoisyTorus, rough_torus(), 1.5, 2);
}

void roughness_table() {
  std::printf("surface,roughness\n");
  print_roughness("Goursat h = 0.5", goursat(0.5));
  print_roughness("Goursat h = 0.25", goursat(0.25));
  print_roughness("torus_010000", cloud("torus_010000"));
  print_roughness("torus-lidar", cloud("torus-lidar"));
  print_roughness(kNoisyTorus, rough_torus());
}

void polygons_table() {
  print_head();
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

/// Of one thread; the bytes of the triangles and of their tree, which has the measures.
struct Cost {
  double splitting, balls, bytes;
};

Cost cost(const Subject& s, const Splitting& how, double radius, int order) {
  const double start = cpu_seconds();
  Triangles t = split(s, how);
  const double is_split = cpu_seconds();
  const double points = static_cast<double>(t.x.size() * 2 * sizeof(Vec3));
  const double parts =
      static_cast<double>(t.size() * (sizeof(t.corners[0]) + sizeof(t.faces[0])) + t.weights.size() * sizeof(double));
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
    print_setting(name, radius, order, name_of(how));
    std::printf("%.1f,%.1f,%.1f,%.0f\n", to_split / plain, to_sum / plain, (to_split + to_sum) / plain,
                c.bytes / static_cast<double>(s.mesh.faces.size()));
    std::fflush(stdout);
  }
}

/// Times over that of the plain run.
void cost_table() {
  std::printf("%s,to_split,to_sum,all,bytes_per_face\n", kSettingColumns);
  print_cost("torus_010000", cloud("torus_010000"), 1.6, 3);
  print_cost("goursat_010000", cloud("goursat_010000"), 0.9, 3);
}

/// What was chosen, its error, and the error that it was said to have over the true one.
void print_own_scale(const std::string& name, const Subject& s) {
  const MeasureTree balls(triangles_of(s.mesh, s.u));
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
  std::printf("%s,%.2g,%.2g,%.2g,%.2f,", quoted(name).c_str(), percentile(radii, 5), percentile(radii, 95),
              percentile(radii, 50), std::sqrt(told / truly));
  print_errors(errors(f, s.truth));
}

void scale_table() {
  std::printf("surface,radius_p5,radius_p95,radius_median,told_over_true_error,%s\n", kErrorColumns);
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

}  // namespace
}  // namespace kappa::experiments

int main(int argc, char** argv) {
  using namespace kappa::experiments;
  return print_table(argc, argv,
                     {{"orders", orders_table},
                      {"refine", refine_table},
                      {"polygons", polygons_table},
                      {"roughness", roughness_table},
                      {"cost", cost_table},
                      {"own-scale", scale_table}});
}
