// SPDX-License-Identifier: BSD-3-Clause
#include "surface_options.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/core/orders.hpp"
#include "kappa/curvature/refine.hpp"
#include "kappa/pcl/greedy.hpp"

namespace kappa::app {
namespace {

double parse_number(const std::string& option, const std::string& text) {
  double value = kNaN;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    throw CLI::ValidationError(option, "'" + text + "' is not a finite number");
  return value;
}

template <class Enum>
CLI::CheckedTransformer one_of(const std::vector<std::pair<std::string, Enum>>& names) {
  return CLI::CheckedTransformer(names);
}

}  // namespace

void declare(CLI::App& command, RunOptions& options) {
  command.add_option("--threads", options.threads, "Threads, 0 for all; the result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of whatever draws random numbers")->capture_default_str();
  command.add_flag("--quiet", options.quiet, "No progress bar and no summary");
  command.add_flag("--json", options.json, "Summary as one JSON object on standard output");
}

namespace {

void declare_kind(CLI::App& command, SurfaceOptions& s) {
  command
      .add_option(
          "--surface", s.surface,
          "Faces: auto, faces (of the file), umbrella, grid (organised cloud), delaunay (in plan), spinning (sweep), "
          "greedy (PCL's, for comparison); "
          "or triangles of each point alone: uniform, independent, hexagram, avg-hexagram")
      ->transform(one_of<SurfaceKind>({{"auto", SurfaceKind::Auto},
                                       {"faces", SurfaceKind::Faces},
                                       {"umbrella", SurfaceKind::Umbrella},
                                       {"grid", SurfaceKind::Grid},
                                       {"delaunay", SurfaceKind::Delaunay},
                                       {"spinning", SurfaceKind::Spinning},
                                       {"greedy", SurfaceKind::Greedy},
                                       {"uniform", SurfaceKind::Uniform},
                                       {"independent", SurfaceKind::Independent},
                                       {"hexagram", SurfaceKind::Hexagram},
                                       {"avg-hexagram", SurfaceKind::AveragedHexagram}}))
      ->option_text("KIND=auto");
  command
      .add_option("--neighbours", s.neighbours,
                  "Points in each star of an umbrella surface (16), or among which random triangles are chosen (20)")
      ->check(CLI::Range(3, 255));
  command.add_option("--triangles", s.triangles, "Triangles of each point for uniform and independent")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void declare_cuts(CLI::App& command, SurfaceArguments& options) {
  SurfaceOptions& s = options.surface;
  command
      .add_option("--max-edge", s.delaunay.max_edge, "Longest edge of a delaunay face in plan, in units of the spacing")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--plan-duplicates", s.delaunay.duplicates,
                  "Of points above each other, which delaunay goes through: highest, lowest")
      ->transform(one_of<PlanDuplicates>({{"highest", PlanDuplicates::Highest}, {"lowest", PlanDuplicates::Lowest}}))
      ->option_text("WHICH=highest");
  command
      .add_option("--max-depth-jump", options.max_depth_jump,
                  "Grid and spinning: corners whose distances from the scanner differ by more than this part of the "
                  "smaller make no face (0.05, spinning 0.25)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--max-incidence", options.max_incidence,
                  "Grid and spinning: faces seen at more than this angle to their normal are cut, degrees (80, "
                  "spinning 84)")
      ->check(CLI::Range(1.0, 90.0));
}

void declare_normals(CLI::App& command, SurfaceArguments& options) {
  SurfaceOptions& s = options.surface;
  command
      .add_option("--normals", s.normals,
                  "auto, input, geometric, area, angle, max (from faces), pca, quadric, robust "
                  "(planes, quadrics fitted to the points; resisting edges and outliers)")
      ->transform(one_of<NormalsKind>({{"auto", NormalsKind::Auto},
                                       {"input", NormalsKind::Input},
                                       {"geometric", NormalsKind::Geometric},
                                       {"area", NormalsKind::Area},
                                       {"angle", NormalsKind::Angle},
                                       {"max", NormalsKind::Max},
                                       {"pca", NormalsKind::Pca},
                                       {"quadric", NormalsKind::Quadric},
                                       {"robust", NormalsKind::Robust}}))
      ->option_text("KIND=auto");
  command
      .add_option("--normal-neighbours", s.normal_neighbours,
                  "Points that pca, quadric and robust fit to (24, and more where the points are noisy)")
      ->check(CLI::Range(3, 100000));
  command
      .add_option(
          "--normal-radius", s.normal_radius,
          "Radius within which they fit, where it holds enough points (where noise and bias of the normals are equal)")
      ->check(CLI::PositiveNumber);
  command.add_option("--smooth", s.averaging_passes, "Averaging passes over the normals")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      .add_option("--orient", options.orient,
                  "auto, up, viewpoint [X,Y,Z], mst (or outward) or input: sign of the normals")
      ->expected(1, 2)
      ->option_text("HOW=auto");
  command.add_flag("--flip", options.flip, "Turn all normals round");
}

}  // namespace

void declare(CLI::App& command, SurfaceArguments& options) {
  declare_kind(command, options.surface);
  declare_cuts(command, options);
  declare_normals(command, options);
}

SurfaceOptions surface_options(const SurfaceArguments& arguments) {
  SurfaceOptions options = arguments.surface;
  options.greedy = [](const Vec3& origin, const std::vector<Vec3>& points, const Normals& u) {
    return greedy_surface(origin, points, u);
  };
  for (GridOptions* cuts : {&options.grid, &options.spinning}) {
    cuts->max_depth_jump = arguments.max_depth_jump.value_or(cuts->max_depth_jump);
    cuts->max_incidence = arguments.max_incidence.value_or(cuts->max_incidence);
  }
  if (arguments.orient.empty()) return options;
  const std::string& how = arguments.orient.front();
  if (how == "up") {
    options.orientation = Orientation::Up;
  } else if (how == "input") {
    options.orientation = Orientation::Input;
  } else if (how == "viewpoint") {
    options.orientation = Orientation::Viewpoint;
  } else if (how == "mst" || how == "outward") {
    options.orientation = Orientation::Consistent;
  } else if (how != "auto") {
    throw CLI::ValidationError("--orient", "'" + how + "' is not one of auto, up, viewpoint, mst, outward, input");
  }
  if (arguments.orient.size() == 1) return options;
  if (how != "viewpoint") throw CLI::ValidationError("--orient", "only viewpoint takes coordinates");
  const std::vector<double> v = parse_numbers("--orient", arguments.orient[1], 3);
  options.viewpoint = Vec3(v[0], v[1], v[2]);
  return options;
}

void declare(CLI::App& command, MeasureArguments& options) {
  command
      .add_option("--radius", options.radii,
                  "Radius of the ball in input units, several by commas, auto, or auto-per-point: radius "
                  "and order are chosen from the data for every point")
      ->delimiter(',')
      ->option_text("R[,R...]=auto");
  command
      .add_option("--order", options.order,
                  "Order of the bias that smaller balls cancel: 1 none, 2 and 3 for smooth surfaces and wide balls")
      ->check(CLI::Range(1, kMaxOrder))
      ->option_text("N=1");
  command
      .add_option("--refine", options.refine,
                  "Split every face in four N times on a curved patch before it is measured; for good normals")
      ->check(CLI::Range(0, kMostRefinements))
      ->capture_default_str();
  command
      .add_option("--min-coverage", options.min_coverage,
                  "No curvature where faces cover less of the ball than this share of it, as at borders and holes: 0 "
                  "keeps all, 0.5 is a straight border")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--ball", options.ball, "Cut faces by exact density or by area fraction: exact, fraction")
      ->transform(
          one_of<BallDefinition>({{"exact", BallDefinition::ExactDensity}, {"fraction", BallDefinition::AreaFraction}}))
      ->option_text("KIND=exact");
  command
      .add_option("--border", options.border,
                  "Where balls reach over a border: curvatures of what is in the ball, or at its centre, for smooth "
                  "surfaces (not with --refine, radius 0 or auto-per-point): ball, centre")
      ->transform(one_of<BorderEstimate>({{"ball", BorderEstimate::InBall}, {"centre", BorderEstimate::AtCentre}}))
      ->option_text("KIND=ball");
  command.add_option("--quads", options.quads, "Quads as four triangles or as bilinear patches: split, bilinear")
      ->transform(one_of<QuadMeasures>({{"split", QuadMeasures::Split}, {"bilinear", QuadMeasures::Bilinear}}))
      ->option_text("KIND=split");
  command.add_option("--vertex-limit", options.limit, "At radius 0: whole faces around or limit of balls: star, limit")
      ->transform(one_of<VertexLimit>({{"star", VertexLimit::Star}, {"limit", VertexLimit::Limit}}))
      ->option_text("KIND=star");
  command.add_option("--engine", options.engine, "How balls are summed: tree, or flann (slower, for comparison)")
      ->check(CLI::IsMember({"tree", "flann"}))
      ->capture_default_str();
  command.add_option("--precision", options.precision, "Of the tree: double, or fast (1e-6 of the measures)")
      ->transform(one_of<Precision>({{"double", Precision::Double}, {"fast", Precision::Fast}}))
      ->option_text("KIND=double");
}

std::vector<double> parse_radii(const std::vector<std::string>& radii) {
  if (radii.empty()) return {};
  if (radii.size() == 1 && (radii.front() == "auto" || radii.front() == kAutoPerPoint)) return {};
  std::vector<double> values;
  for (const std::string& text : radii) {
    values.push_back(parse_number("--radius", text));
    if (values.back() < 0) throw CLI::ValidationError("--radius", "'" + text + "' is negative");
  }
  return values;
}

namespace {

/// Estimates at the centre are for balls at the points themselves.
void check_border(const MeasureArguments& arguments, bool at_zero) {
  if (arguments.border == BorderEstimate::InBall) return;
  const auto refuse = [](const std::string& why) { throw CLI::ValidationError("--border", "centre " + why); };
  if (arguments.refine > 0)
    refuse("is not for faces refined by --refine " + std::to_string(arguments.refine) + "; leave one of them out");
  if (arguments.own_scales()) refuse("is not for --radius auto-per-point; give a radius, or leave --border out");
  if (at_zero) refuse("needs balls, and --radius 0 has none; give a positive radius, or leave --border out");
}

}  // namespace

void check_measure(const MeasureArguments& arguments) {
  const std::vector<double> radii = parse_radii(arguments.radii);
  if (arguments.refine > 0 && arguments.quads == QuadMeasures::Bilinear)
    throw CLI::ValidationError("--refine", "splits triangles; leave --quads bilinear out");
  const bool at_zero = std::find(radii.begin(), radii.end(), 0.0) != radii.end();
  if (arguments.min_coverage > 0 && at_zero)
    throw CLI::ValidationError("--min-coverage", "needs balls: it has no meaning at radius 0");
  check_border(arguments, at_zero);
  if (!arguments.order) return;
  if (arguments.own_scales())
    throw CLI::ValidationError("--order", "is chosen for every point with --radius auto-per-point; leave it out");
  if (*arguments.order > 1 && at_zero)
    throw CLI::ValidationError("--order", "needs balls: above 1 it has no meaning at radius 0");
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (const std::string& part : CLI::detail::split(text, ',')) values.push_back(parse_number(option, part));
  if (values.size() != count)
    throw CLI::ValidationError(option, "'" + text + "' is not " + std::to_string(count) + " numbers with commas");
  return values;
}

}  // namespace kappa::app
