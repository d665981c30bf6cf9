// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/surfaces.md as Markdown: clouds_experiment [clean | cells | noise | rotations | border]...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "kappa/core/error.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/shapes/random.hpp"
#include "rows.hpp"
#include "tables.hpp"

namespace kappa::experiments {
namespace {

const std::vector<int> kNeighbours = {10, 20, 40, 80}, kNeighboursUnderNoise = {20, 80, 250};

/// A published cloud and the radii that its tables have.
struct Case {
  std::string name;
  std::vector<double> radii, refined_radii, radii_under_noise;
  double wide_fit;  ///< radius of quadrics under noise, about five spacings
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"torus_010000", {0.4, 0.8, 1.6, 2.0, 2.4}, {0.8, 1.6, 2.0}, {0.8, 1.6, 2.4, 3.6}, 1.2},
      {"goursat_010000", {0.5, 0.75, 1.0, 1.5, 2.0}, {0.9, 1.0, 1.5}, {1.5, 2.5, 3.5, 5.0}, 2.0},
      {"torus-lidar", {0.3, 0.4, 0.6, 0.8, 1.2}, {0.6, 0.8, 1.2}, {0.8, 1.6, 2.4, 3.6}, 1.6}};
  return all;
}

CurvatureOptions at(double radius, int order, int refine = 0) {
  CurvatureOptions options;
  options.radii = {radius};
  options.order = order;
  options.refine = refine;
  return options;
}

double error_of_mean(const Row& row) {
  return row.errors.mean;
}

/// Of the mean and, half each, of the principal curvatures.
double error_of_all(const Row& row) {
  return std::hypot(row.errors.mean, std::sqrt(0.5) * row.errors.k_min, std::sqrt(0.5) * row.errors.k_max);
}

/// The row of least error among those that `wanted` picks, null if there is none.
const Row* best(const std::vector<Row>& rows, double (*error)(const Row&),
                const std::function<bool(const Row&)>& wanted) {
  const Row* found = nullptr;
  for (const Row& row : rows) {
    if (wanted(row) && (!found || error(row) < error(*found))) found = &row;
  }
  return found;
}

void add_all_schemes(const Oriented& cloud, const std::vector<int>& neighbours, std::vector<Row>& rows) {
  for (const TriangleScheme scheme : {TriangleScheme::Uniform, TriangleScheme::Independent, TriangleScheme::Hexagram,
                                      TriangleScheme::AveragedHexagram}) {
    for (const int k : neighbours) rows.push_back(scheme_row(cloud, scheme, k));
  }
}

void add_all_balls(const Oriented& cloud, const std::vector<double>& radii, std::vector<Row>& rows) {
  for (const double radius : radii) {
    for (const int order : {1, 2, 3}) rows.push_back(umbrella_row(cloud, at(radius, order)));
  }
  rows.push_back(umbrella_row(cloud, at(cloud.automatic_radius, 1)));
  rows.back().setting = "automatic: " + rows.back().setting;
  CurvatureOptions own;
  own.scale = ScaleChoice::PerPoint;
  rows.push_back(umbrella_row(cloud, own));
}

std::vector<Row> clean_rows(const Case& c, const Oriented& cloud) {
  std::vector<Row> rows;
  add_all_schemes(cloud, kNeighbours, rows);
  rows.push_back(umbrella_row(cloud, at(0, 1)));
  add_all_balls(cloud, c.radii, rows);
  for (const double radius : c.refined_radii) {
    for (const int order : {2, 3}) {
      for (const int levels : {1, 2}) rows.push_back(umbrella_row(cloud, at(radius, order, levels)));
    }
  }
  return rows;
}

/// What was published of others, measured on the same file with exact normals and K = 20.
struct Published {
  const char* cloud;
  const char* figures;
};
constexpr Published kPublished[] = {
    {"torus_010000", "published averaged hexagram | 1.7e-3 | 2.7e-3 | 1.7e-3 | 170,000"},
    {"torus_010000", "published hexagram | 2.2e-3 | | | 150,000 to 170,000"},
    {"torus_010000", "published uniform, 100 triangles | 1.7e-3 | | | 65,000"},
    {"torus_010000", "jets of degree 2 | 4.4e-3 | | 7.1e-3 | 35,000"},
    {"torus_010000", "jets of degree 4 | 1.2e-4 | 1.6e-4 | 1.8e-4 | 9,000"},
    {"torus_010000", "PCL PrincipalCurvatures | 8e-2 | | | "},
    {"goursat_010000", "published averaged hexagram | 3.3e-3 | 2.8e-3 | 5.9e-3 | 170,000"},
    {"goursat_010000", "published hexagram | 3.7e-3 | | | 150,000 to 170,000"},
    {"goursat_010000", "published uniform, 100 triangles | 4.1e-3 | | | 65,000"},
    {"goursat_010000", "jets of degree 2 | 4.0e-3 | | 6.0e-3 | 35,000"},
    {"goursat_010000", "jets of degree 4 | 1.2e-4 | 1.4e-4 | 1.9e-4 | 9,000"},
    {"torus-lidar", "published averaged hexagram | 4.1e-3 | | | 170,000"},
    {"torus-lidar", "published hexagram | 2.2e-3 | 3.4e-3 | 3.8e-3 | 150,000 to 170,000"},
    {"torus-lidar", "published uniform, 100 triangles | 3.7e-3 | | | 65,000"},
    {"torus-lidar", "jets of degree 2 | 8.3e-3 | | 1.5e-2 | 35,000"},
    {"torus-lidar", "jets of degree 4 | 6.0 | 10.6 | 5.8 | 9,000"}};

void print_best(const char* method, const Row* row) {
  if (!row) return;
  std::printf("| %s: %s | %.1e | %.1e | %.1e | %s |\n", method, row->setting.c_str(), row->errors.mean,
              row->errors.k_min, row->errors.k_max, speed(*row).c_str());
}

/// The best of each beside the published figures.
void print_summary(const Case& c, const std::vector<Row>& rows) {
  std::printf("\n### %s, exact normals: the best of each\n\n", c.name.c_str());
  std::printf("| method | mean | k_min | k_max | points per second |\n|---|---|---|---|---|\n");
  for (const Published& p : kPublished) {
    if (c.name == p.cloud) std::printf("| %s |\n", p.figures);
  }
  for (const char* scheme : {"avg-hexagram", "hexagram", "uniform", "independent"})
    print_best(scheme,
               best(rows, error_of_mean, [&](const Row& r) { return r.surface == scheme && r.setting == "K = 20"; }));
  const auto umbrella = [&](int order, bool refined) {
    return best(rows, error_of_mean,
                [&](const Row& r) { return r.surface == "umbrella" && r.order == order && (r.refine > 0) == refined; });
  };
  for (const int order : {1, 2, 3}) print_best("umbrella", umbrella(order, false));
  for (const int order : {2, 3}) print_best("umbrella", umbrella(order, true));
  print_best("umbrella", umbrella(0, false));
}

void clean_tables() {
  std::string full;
  for (const Case& c : cases()) {
    const KnownScan known = published_scan(c.name);
    for (const bool exact : {true, false}) {
      const Oriented cloud = exact ? with_exact_normals(known) : with_fitted_normals(known);
      const std::vector<Row> rows = clean_rows(c, cloud);
      if (exact) print_summary(c, rows);
      full += table("### " + c.name + ", " + cloud.normals, rows);
    }
  }
  std::printf("\n## Every setting, clean positions\n%s", full.c_str());
}

/// Surfaces that need more than points: the grid of a depth image, the rings of a sweep, a view from above.
void cell_tables() {
  const KnownScan points = published_scan("torus-lidar"), grid = organised_torus(points);
  std::vector<Row> rows;
  for (const auto& [radius, order] : {std::pair(0.4, 1), {0.6, 2}, {1.2, 3}}) {
    for (const NormalsKind normals : {NormalsKind::Input, NormalsKind::Max}) {
      rows.push_back(surface_row(grid, SurfaceKind::Grid, normals, at(radius, order)));
      rows.push_back(surface_row(points, SurfaceKind::Delaunay, normals, at(radius, order)));
    }
    rows.push_back(surface_row(points, SurfaceKind::Umbrella, NormalsKind::Input, at(radius, order)));
  }
  std::printf("%s", table("## torus-lidar as depth image (80 x 40) and seen from above", rows).c_str());
  const KnownScan sweep = goursat_sweep(48, 256);
  rows.clear();
  for (const auto& [radius, order] : {std::pair(0.5, 1), {1.0, 2}, {2.0, 3}}) {
    for (const SurfaceKind kind : {SurfaceKind::Spinning, SurfaceKind::Grid}) {
      for (const NormalsKind normals : {NormalsKind::Input, NormalsKind::Area})
        rows.push_back(surface_row(sweep, kind, normals, at(radius, order)));
    }
    rows.push_back(surface_row(sweep, SurfaceKind::Umbrella, NormalsKind::Input, at(radius, order)));
  }
  std::printf("%s", table("## Goursat's surface swept from its middle (48 rings x 256 columns)", rows).c_str());
}

std::string cell(const Row* row) {
  if (!row) return "";
  return text("%.1e %.1e %.1e, %s", row->errors.mean, row->errors.k_min, row->errors.k_max, row->setting.c_str());
}

bool is_own(const Row& row) {
  return row.setting.rfind("own scale", 0) == 0;
}

std::string noise_summary(const std::string& title, const std::vector<Row>& rows) {
  const auto of = [&](const char* surface) {
    return cell(best(rows, error_of_all, [&](const Row& r) { return r.surface == surface && !is_own(r); }));
  };
  const auto automatic = [&](int order) {
    return cell(best(rows, error_of_all,
                     [&](const Row& r) { return r.order == order && r.setting.rfind("automatic", 0) == 0; }));
  };
  return "| " + title + " | " + of("uniform") + " | " + of("avg-hexagram") + " | " + of("umbrella") + " | " +
         automatic(1) + " | " + automatic(2) + " | " + cell(best(rows, error_of_all, is_own)) + " |\n";
}

/// Normals that the program fits to a noisy cloud, and others beside them.
std::vector<Oriented> noisy_normals(const KnownScan& noisy, double wide_fit) {
  SurfaceOptions narrow, wide;
  narrow.normal_neighbours = NormalFitOptions{}.neighbours;
  wide.normal_radius = wide_fit;
  std::vector<Oriented> all = {with_exact_normals(noisy), with_fitted_normals(noisy, narrow),
                               with_fitted_normals(noisy, wide), with_fitted_normals(noisy)};
  all.back().normals = "chosen: " + all.back().normals;
  return all;
}

void noise_tables() {
  std::printf("\n## Every setting under noise\n");
  std::string summary;
  for (const Case& c : cases()) {
    const KnownScan known = published_scan(c.name);
    for (const double per_cent : {0.5, 1.0, 2.0}) {
      const KnownScan noisy = with_noise(known, per_cent);
      for (Oriented& cloud : noisy_normals(noisy, c.wide_fit)) {
        cloud.runs = 1;
        std::vector<Row> rows;
        add_all_schemes(cloud, kNeighboursUnderNoise, rows);
        add_all_balls(cloud, c.radii_under_noise, rows);
        rows.push_back(umbrella_row(cloud, at(cloud.automatic_radius, 2)));
        rows.back().setting = "automatic " + rows.back().setting;
        const std::string title = c.name + text(", %g %%, ", per_cent) + cloud.normals;
        std::printf("%s", table("### " + title, rows).c_str());
        std::fflush(stdout);
        summary += noise_summary(title, rows);
      }
    }
  }
  std::printf("\n## Noise: the best setting of each (rms of mean, k_min, k_max)\n\n");
  std::printf(
      "| cloud, noise, normals | uniform | avg-hexagram | umbrella | automatic radius | at order 2 | own scales ");
  std::printf("|\n|---|---|---|---|---|---|---|\n%s", summary.c_str());
}

/// Hexagrams depend on how the axes lie: how much, over ten random rotations of the cloud.
void rotation_table() {
  std::printf("\n## Hexagrams of the cloud in ten random positions: least and greatest rms, K = 20\n\n");
  std::printf("| cloud | scheme | mean | k_min | k_max |\n|---|---|---|---|---|\n");
  for (const Case& c : cases()) {
    for (const TriangleScheme scheme : {TriangleScheme::Hexagram, TriangleScheme::AveragedHexagram}) {
      Errors least, most;
      least.mean = least.k_min = least.k_max = std::numeric_limits<double>::infinity();
      Random random(1);
      for (int turn = 0; turn < 10; ++turn) {
        const Mat3 rotation = Eigen::AngleAxisd(random.uniform(0, 2 * kPi), random.direction()).matrix();
        const Errors e = scheme_row(with_exact_normals(rotated(published_scan(c.name), rotation)), scheme, 20).errors;
        for (double Errors::*m : {&Errors::mean, &Errors::k_min, &Errors::k_max}) {
          least.*m = std::min(least.*m, e.*m);
          most.*m = std::max(most.*m, e.*m);
        }
      }
      std::printf("| %s | %s | %.1e to %.1e | %.1e to %.1e | %.1e to %.1e |\n", c.name.c_str(), name(scheme),
                  least.mean, most.mean, least.k_min, most.k_min, least.k_max, most.k_max);
    }
  }
}

/// One line: errors in the ball and at the centre, of all points and of those whose ball meets the border.
void print_border_row(const Oriented& cloud, double noise, double radius, int order) {
  const Mesh mesh = umbrella_surface(Vec3::Zero(), cloud.known.scan.points, cloud.u, {}).mesh;
  CurvatureOptions options = at(radius, order);
  const CurvatureField in_ball = estimate_curvatures(mesh, cloud.u, options)[0];
  options.border = BorderEstimate::AtCentre;
  const CurvatureField at_centre = estimate_curvatures(mesh, cloud.u, options)[0];
  std::vector<TrueCurvature> at_border = cloud.known.truth;
  std::size_t count = 0;
  for (std::size_t i = 0; i < at_border.size(); ++i) {
    const bool changed = at_centre.samples[i].k.mean != in_ball.samples[i].k.mean;
    count += changed;
    if (!changed) at_border[i].mean = kNaN;
  }
  std::printf("| %s, noise %g %%, radius %g, order %d |", cloud.known.name.c_str(), noise, radius, order);
  for (const bool border : {false, true}) {
    if (border) std::printf(" %zu |", count);
    for (const CurvatureField* field : {&in_ball, &at_centre}) {
      const Errors e = errors(*field, border ? at_border : cloud.known.truth);
      std::printf(" %.1e %.1e %.1e |", e.mean, e.k_min, e.k_max);
    }
  }
  std::printf("\n");
}

void border_table() {
  std::printf("\n## Balls over a border: curvatures in the ball and at its centre (rms of mean, k_min, k_max)\n\n");
  std::printf("| cloud | all: in the ball | at the centre | at the border | in the ball | at the centre |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const double noise : {0.0, 0.5}) {
    for (const Case& c : cases()) {
      const KnownScan whole = published_scan(c.name), open = c.name == "torus-lidar" ? whole : cut(whole);
      const Oriented cloud = with_exact_normals(noise > 0 ? with_noise(open, noise) : open);
      for (const auto& [at_radius, order] : {std::pair(1, 1), {2, 1}, {2, 2}, {4, 2}, {4, 3}})
        print_border_row(cloud, noise, c.radii.front() * at_radius, order);
    }
  }
}

}  // namespace
}  // namespace kappa::experiments

int main(int argc, char** argv) {
  using namespace kappa::experiments;
  return print_tables(argc, argv,
                      {{"clean", clean_tables},
                       {"rotations", rotation_table},
                       {"cells", cell_tables},
                       {"noise", noise_tables},
                       {"border", border_table}});
}
