// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"
#include "kappa/pcl/greedy.hpp"
#include "scan_command.hpp"

namespace kappa::app {
namespace {

void declare_kind(CLI::App& command, SurfaceOptions& s) {
  add_choice(command, "--surface", s.surface, "What is measured");
  command
      .add_option("--neighbours", s.neighbours,
                  "Points in each star of an umbrella surface (16), or among which random triangles are chosen (20)")
      ->check(CLI::Range(3, 255));
  command.add_option("--triangles", s.triangles, "Triangles of each point for uniform and independent")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void declare_cuts(CLI::App& command, SurfaceOptions& s) {
  command
      .add_option("--max-edge", s.delaunay.max_edge, "Longest edge of a delaunay face in plan, in units of the spacing")
      ->check(positive())
      ->capture_default_str();
  add_choice(command, "--plan-duplicates", s.delaunay.duplicates,
             "Of points above each other, which delaunay goes through", "WHICH");
  const auto add = [&](const char* name, double GridOptions::*member, const std::string& help) {
    return command.add_option_function<double>(
        name,
        [&s, member](double value) {
          s.grid.*member = value;
          s.spinning.*member = value;
        },
        help);
  };
  const auto defaults = [&](double GridOptions::*member) {
    return " (" + CLI::detail::to_string(s.grid.*member) + ", spinning " + CLI::detail::to_string(s.spinning.*member) +
           ")";
  };
  add("--max-depth-jump", &GridOptions::max_depth_jump,
      "Grid and spinning: corners whose distances from the scanner differ by more than this part of the smaller make "
      "no face" +
          defaults(&GridOptions::max_depth_jump))
      ->check(positive());
  add("--max-incidence", &GridOptions::max_incidence,
      "Grid and spinning: faces seen at more than this angle to their normal are cut, degrees" +
          defaults(&GridOptions::max_incidence))
      ->check(CLI::Range(1.0, 90.0));
}

/// "up", "viewpoint 1,2,3", "mst" ...
void take_orientation(const std::vector<std::string>& words, SurfaceOptions& s) {
  const std::string how = words.front() == "outward" ? name(Orientation::Consistent) : words.front();
  bool known = false;
  for (const Named<Orientation>& named : names_of(Orientation{})) {
    if (how != named.name || named.value == Orientation::AsFaces) continue;
    s.orientation = named.value;
    known = true;
  }
  if (!known)
    throw CLI::ValidationError("--orient", "'" + how + "' is not one of auto, up, viewpoint, mst, outward, input");
  if (words.size() == 1) return;
  if (s.orientation != Orientation::Viewpoint)
    throw CLI::ValidationError("--orient", "only viewpoint takes coordinates");
  const std::vector<double> v = parse_numbers("--orient", words[1], 3);
  s.viewpoint = Vec3(v[0], v[1], v[2]);
}

void declare_normals(CLI::App& command, ScanOptions& options) {
  SurfaceOptions& s = options.surface;
  add_choice(command, "--normals", s.normals, "Where the corrected normals come from");
  command
      .add_option("--normal-neighbours", s.normal_neighbours,
                  "Points that pca, quadric and robust fit to (24, and more where the points are noisy)")
      ->check(CLI::Range(3, 100000));
  command
      .add_option(
          "--normal-radius", s.normal_radius,
          "Radius within which they fit, where it holds enough points (where noise and bias of the normals are equal)")
      ->check(positive());
  command.add_option("--smooth", s.averaging_passes, "Averaging passes over the normals")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      .add_option_function<std::vector<std::string>>(
          "--orient", [&s](const std::vector<std::string>& words) { take_orientation(words, s); },
          "auto, up, viewpoint [X,Y,Z], mst (or outward) or input: sign of the normals")
      ->expected(1, 2)
      ->option_text("HOW=auto");
  command.add_flag("--flip", options.flip, "Turn all normals round");
}

}  // namespace

void declare_surface(CLI::App& command, ScanOptions& options) {
  options.surface.greedy = [](const Vec3& origin, const std::vector<Vec3>& points, const Normals& u) {
    return greedy_surface(origin, points, u);
  };
  declare_kind(command, options.surface);
  declare_cuts(command, options.surface);
  declare_normals(command, options);
}

}  // namespace kappa::app
