// SPDX-License-Identifier: BSD-3-Clause
// Prints a table of errors on clouds of known curvature as CSV: clouds_experiment TABLE. README.md lists the tables.
#include <algorithm>
#include <cstdio>
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

CurvatureOptions at(double radius, int order) {
  CurvatureOptions options;
  options.radii = {radius};
  options.order = order;
  return options;
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
      for (const int levels : {1, 2}) rows.push_back(umbrella_row(cloud, at(radius, order), levels));
    }
  }
  return rows;
}

void clean_table() {
  print_columns();
  for (const Case& c : cases()) {
    const KnownScan known = published_scan(c.name);
    for (const bool exact : {true, false})
      print_rows(c.name, 0, clean_rows(c, exact ? with_exact_normals(known) : with_fitted_normals(known)));
  }
}

/// Surfaces that need more than points: the grid of a depth image, the rings of a sweep, a view from above.
void cells_table() {
  print_columns();
  const KnownScan points = published_scan("torus-lidar"), grid = organised_torus(points);
  std::vector<Row> rows;
  for (const auto& [radius, order] : {std::pair(0.4, 1), {0.6, 2}, {1.2, 3}}) {
    for (const NormalsKind normals : {NormalsKind::Input, NormalsKind::Max}) {
      rows.push_back(surface_row(grid, SurfaceKind::Grid, normals, at(radius, order)));
      rows.push_back(surface_row(points, SurfaceKind::Delaunay, normals, at(radius, order)));
    }
    rows.push_back(surface_row(points, SurfaceKind::Umbrella, NormalsKind::Input, at(radius, order)));
  }
  print_rows("torus-lidar as depth image (80 x 40) and seen from above", 0, rows);
  const KnownScan sweep = goursat_sweep(48, 256);
  rows.clear();
  for (const auto& [radius, order] : {std::pair(0.5, 1), {1.0, 2}, {2.0, 3}}) {
    for (const SurfaceKind kind : {SurfaceKind::Spinning, SurfaceKind::Grid}) {
      for (const NormalsKind normals : {NormalsKind::Input, NormalsKind::Area})
        rows.push_back(surface_row(sweep, kind, normals, at(radius, order)));
    }
    rows.push_back(surface_row(sweep, SurfaceKind::Umbrella, NormalsKind::Input, at(radius, order)));
  }
  print_rows("Goursat's surface swept from its middle (48 rings x 256 columns)", 0, rows);
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

std::vector<Row> noisy_rows(const Case& c, const Oriented& cloud) {
  std::vector<Row> rows;
  add_all_schemes(cloud, kNeighboursUnderNoise, rows);
  add_all_balls(cloud, c.radii_under_noise, rows);
  rows.push_back(umbrella_row(cloud, at(cloud.automatic_radius, 2)));
  rows.back().setting = "automatic " + rows.back().setting;
  return rows;
}

void noise_table() {
  print_columns();
  for (const Case& c : cases()) {
    const KnownScan known = published_scan(c.name);
    for (const double per_cent : {0.5, 1.0, 2.0}) {
      for (Oriented& cloud : noisy_normals(with_noise(known, per_cent), c.wide_fit)) {
        cloud.runs = 1;
        print_rows(c.name, per_cent, noisy_rows(c, cloud));
      }
    }
  }
}

/// Hexagrams of 20 neighbours depend on how the axes lie: the least and the greatest error over ten random rotations.
void rotation_table() {
  std::printf("cloud,scheme,least_mean,greatest_mean,least_k_min,greatest_k_min,least_k_max,greatest_k_max\n");
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
      std::printf("%s,%s,%.1e,%.1e,%.1e,%.1e,%.1e,%.1e\n", c.name.c_str(), name(scheme), least.mean, most.mean,
                  least.k_min, most.k_min, least.k_max, most.k_max);
    }
  }
}

/// One row: errors in the ball and at the centre, of all points and of those whose ball meets the border.
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
  std::printf("%s,%g,%g,%d", cloud.known.name.c_str(), noise, radius, order);
  for (const bool border : {false, true}) {
    if (border) std::printf(",%zu", count);
    for (const CurvatureField* field : {&in_ball, &at_centre}) {
      const Errors e = errors(*field, border ? at_border : cloud.known.truth);
      std::printf(",%.1e,%.1e,%.1e", e.mean, e.k_min, e.k_max);
    }
  }
  std::printf("\n");
}

/// Curvatures in balls that reach over a border, and at their centres.
void border_table() {
  std::printf("cloud,noise_percent,radius,order,all_in_ball_mean,all_in_ball_k_min,all_in_ball_k_max,");
  std::printf("all_at_centre_mean,all_at_centre_k_min,all_at_centre_k_max,points_at_border,border_in_ball_mean,");
  std::printf("border_in_ball_k_min,border_in_ball_k_max,border_at_centre_mean,border_at_centre_k_min,");
  std::printf("border_at_centre_k_max\n");
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
  return print_table(argc, argv,
                     {{"clean", clean_table},
                      {"rotations", rotation_table},
                      {"cells", cells_table},
                      {"noise", noise_table},
                      {"border", border_table}});
}
