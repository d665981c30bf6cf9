// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/search/neighbours.hpp"
#include "on_positions.hpp"
#include "surface_choice.hpp"

namespace kappa {
namespace {

NormalWeights weights_of(NormalsKind kind) {
  switch (kind) {
    case NormalsKind::Area:
      return NormalWeights::Area;
    case NormalsKind::Angle:
      return NormalWeights::Angle;
    case NormalsKind::Max:
      return NormalWeights::Max;
    default:
      return NormalWeights::Uniform;
  }
}

/// Orientation of normals fitted to a cloud that no scanner is known of.
Orientation choose_by_slope(const Normals& u) {
  constexpr double kFlat = 0.7;
  std::size_t flat = 0, all = 0;
  for (const Vec3& v : u) {
    flat += std::abs(v.z()) > kFlat;
    all += !v.isZero(0);
  }
  return 2 * flat >= all ? Orientation::Up : Orientation::Consistent;
}

/// Turns normals that were fitted to the points to the side from which the faces turn counter-clockwise.
void orient_as_faces(const Mesh& mesh, Normals& u, const Execution& run) {
  const Normals of_faces = vertex_normals(mesh, NormalWeights::Area, run);
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (u[i].dot(of_faces[i]) < 0) u[i] = -u[i];
  }
}

void orient(const Scan& scan, const SurfaceChoice& choice, Surface& s) {
  if (s.orientation == Orientation::Auto) s.orientation = choose_by_slope(s.u);
  if (s.orientation == Orientation::Up) orient_along(Vec3::UnitZ(), s.u);
  if (s.orientation == Orientation::Viewpoint) orient_towards(scan.points, *choice.viewpoint, s.u);
  if (s.orientation == Orientation::Consistent) s.agreement = orient_consistently(scan.points, s.u).agreement;
}

/// Radii of fits in spacings: at most, and on a noisy mesh at least.
constexpr double kLargestNormalRadius = 21, kMeshNormalRadius = 3.5;

/// Error of the mean curvature in a ball of five spacings, with normals that are averages within `normal_radius`.
double expected_error(const CloudScale& scale, double normal_radius) {
  const double radius = kAutomaticRadius * scale.spacing;
  return std::hypot(curvature_noise(scale, radius, normal_radius), curvature_bias(scale, radius, normal_radius));
}

double radius_of_neighbours(const CloudScale& scale) {
  return std::sqrt(NormalFitOptions{}.neighbours / kPi) * scale.spacing;
}

/// The ball of the fits where the noise of their normals equals the bias, 0 where the nearest neighbours fill it.
double automatic_normal_radius(const CloudScale& scale, const std::optional<double>& measured_radius) {
  const double least = radius_of_neighbours(scale), most = kLargestNormalRadius * scale.spacing;
  const double balanced = balanced_normal_radius(scale, least, most), radius = balanced > least ? balanced : 0;
  return std::min(radius, measured_radius.value_or(radius));
}

NormalFit fit_of(NormalsKind kind) {
  if (kind == NormalsKind::Pca) return NormalFit::Plane;
  return kind == NormalsKind::Robust ? NormalFit::Robust : NormalFit::Quadric;
}

/// Of the scale of the points, `s.scale`. Fits within `radius` unless the options or noise ask for another.
Normals normals_at_scale(const Positions& positions, const SurfaceOptions& options, double radius, Surface& s,
                         const Execution& run) {
  NormalFitOptions fit;
  fit.fit = fit_of(s.normals);
  fit.neighbours = options.normal_neighbours.value_or(fit.neighbours);
  if (options.normal_radius) {
    fit.radius = *options.normal_radius;
  } else if (!options.normal_neighbours) {
    fit.radius = std::max(automatic_normal_radius(s.scale, options.measured_radius), radius);
    if (s.scale.noise > 0) fit.noise = s.scale.noise;  // too few points have no scale
  }
  s.normal_neighbours = fit.neighbours;
  s.normal_radius = fit.radius;
  return fitted_normals(positions, fit, run);
}

Normals fitted_normals(const Positions& positions, const SurfaceOptions& options, Surface& s, const Execution& run) {
  s.scale = measure_scale(positions, stage(run, 0.0, 0.2));
  return normals_at_scale(positions, options, 0, s, stage(run, 0.2, 1.0));
}

/// Normals of the points, where they do not come from faces.
Normals point_normals(const Scan& scan, const SurfaceOptions& options, Surface& s, const Execution& run) {
  if (s.normals == NormalsKind::Input) return normalised(scan.normals);
  return fitted_normals(Positions(scan.points), options, s, run);
}

/// Whether normals of so many neighbours are better than those of faces, which are averages over one spacing.
bool is_too_noisy_for_faces(const CloudScale& scale) {
  return expected_error(scale, radius_of_neighbours(scale)) < expected_error(scale, scale.spacing);
}

/// Normals of the faces, or where nothing but the data decides and the vertices are noisy, of quadrics of these.
Normals mesh_normals(const Scan& scan, const SurfaceOptions& options, Surface& s, const Execution& run) {
  if (s.kind == SurfaceKind::Faces && options.normals == NormalsKind::Auto) {
    const Positions positions(scan.points);
    const CloudScale scale = measure_scale(positions, stage(run, 0.0, 0.2));
    if (is_too_noisy_for_faces(scale)) {
      s.normals = NormalsKind::Quadric;
      s.scale = scale;
      const double radius = std::min(kMeshNormalRadius * scale.spacing,
                                     options.measured_radius.value_or(std::numeric_limits<double>::infinity()));
      return normals_at_scale(positions, options, radius, s, stage(run, 0.2, 1.0));
    }
  }
  return vertex_normals(s.mesh, weights_of(s.normals), run);
}

/// Compares the normals at the ends of every side of the faces.
NormalAgreement agreement_on_faces(const Mesh& mesh, const Normals& u) {
  NormalAgreement agreement;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 &a = u[corners[i]], &b = u[corners[i + 1 < corners.size() ? i + 1 : 0]];
      agreement.pairs += !a.isZero(0) && !b.isZero(0);
      agreement.opposed += a.dot(b) < -0.5;
    }
  }
  return agreement;
}

void take(CloudSurface cloud, Surface& s) {
  s.mesh = std::move(cloud.mesh);
  s.twins = std::move(cloud.representative);
  s.duplicate_points = cloud.duplicate_points;
  s.starless_points = cloud.starless_points;
}

std::size_t total(const GridCuts& cuts) {
  return cuts.depth_jumps + cuts.grazing + cuts.degenerate;
}

void make_grid(const Scan& scan, const SurfaceOptions& options, const Vec3& viewpoint, Surface& s,
               const Execution& run) {
  GridSurface grid = grid_surface(scan.origin, scan.points, scan.width, scan.height, viewpoint, options.grid, run);
  s.cut_faces = total(grid.cuts);
  take(std::move(grid.surface), s);
}

void make_spinning(const Scan& scan, const SurfaceOptions& options, const Vec3& viewpoint, Surface& s,
                   const Execution& run) {
  const Field* ring = scan.field("ring");
  SpinningSurface spinning = spinning_surface(scan.origin, scan.points, viewpoint,
                                              ring ? ring->values : std::vector<double>{}, options.spinning, run);
  s.cut_faces = total(spinning.grid.cuts);
  s.at_sensor = spinning.sweep.at_sensor;
  take(std::move(spinning.grid.surface), s);
}

void make_delaunay(const Scan& scan, const SurfaceOptions& options, Surface& s, const Execution& run) {
  PlanSurface plan = delaunay_surface(scan.origin, scan.points, options.delaunay, run);
  s.cut_faces = plan.cut_faces;
  take(std::move(plan.surface), s);
}

/// Faces that depend on positions and viewpoint alone; normals of them, or of the points.
void use_turned_faces(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& choice, Surface& s,
                      const Execution& run) {
  const Execution first = stage(run, 0.0, 0.6), second = stage(run, 0.6, 1.0);
  if (s.kind == SurfaceKind::Faces) s.mesh = mesh_of(scan);
  if (s.kind == SurfaceKind::Delaunay) make_delaunay(scan, options, s, first);
  if (s.kind == SurfaceKind::Grid) make_grid(scan, options, *choice.viewpoint, s, first);
  if (s.kind == SurfaceKind::Spinning) make_spinning(scan, options, *choice.viewpoint, s, first);
  s.u = from_faces(s.normals) ? mesh_normals(scan, options, s, second) : point_normals(scan, options, s, second);
  if (s.orientation == Orientation::AsFaces && !from_faces(s.normals)) orient_as_faces(s.mesh, s.u, second);
  orient(scan, choice, s);
}

/// Faces in the tangent planes; normals from faces then take the place of those that the planes were made of.
void use_planned_faces(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& choice, Surface& s,
                       const Execution& run) {
  const Execution first = stage(run, 0.0, 0.5), second = stage(run, 0.5, 1.0);
  const Positions positions(scan.points, first);
  s.u = s.normals == NormalsKind::Input ? normalised(scan.normals) : fitted_normals(positions, options, s, first);
  orient(scan, choice, s);
  if (s.kind == SurfaceKind::Greedy) {
    take(options.greedy(scan.origin, scan.points, s.u), s);
  } else {
    const int neighbours = options.neighbours.value_or(UmbrellaOptions{}.neighbours);
    take(umbrella_surface(scan.origin, scan.points, positions, s.u, {neighbours}, second), s);
  }
  if (from_faces(s.normals)) s.u = vertex_normals(s.mesh, weights_of(s.normals));
}

/// No faces: the triangles are made when the curvatures are.
void use_points(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& choice, Surface& s,
                const Execution& run) {
  s.u = point_normals(scan, options, s, run);
  orient(scan, choice, s);
  s.mesh.origin = scan.origin;
  s.mesh.vertices = scan.points;
}

void use(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& choice, Surface& s,
         const Execution& run) {
  if (has_turned_faces(s.kind)) return use_turned_faces(scan, options, choice, s, run);
  if (s.kind == SurfaceKind::Umbrella || s.kind == SurfaceKind::Greedy)
    return use_planned_faces(scan, options, choice, s, run);
  use_points(scan, options, choice, s, run);
}

/// Points that no face touches have the normals of the point that stands for them.
void copy_to_twins(Surface& s) {
  for (std::size_t i = 0; i < s.twins.size(); ++i) {
    if (s.twins[i] != kNoIndex && s.twins[i] != i) s.u[i] = s.u[s.twins[i]];
  }
}

void count_points(const Scan& scan, Surface& s) {
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const bool finite = is_finite(scan.points[i]);
    s.invalid_points += !finite;
    s.normalless_points += finite && s.u[i].isZero(0);
  }
}

}  // namespace

Surface make_surface(const Scan& scan, const SurfaceOptions& options, const Execution& run) {
  if (std::none_of(scan.points.begin(), scan.points.end(), is_finite))
    throw Error(ErrorCode::InvalidData,
                "none of the " + std::to_string(scan.points.size()) + " points is finite: there is nothing to measure");
  const SurfaceChoice choice = choose_surface(scan, options);
  const bool alone = triangle_scheme(choice.kind).has_value();
  Surface s;
  s.kind = choice.kind;
  s.reason = choice.reason;
  s.normals = choice.normals;
  s.orientation = choice.orientation;
  use(scan, options, choice, s, stage(run, 0.0, 0.9));
  if (s.mesh.faces.empty() && !alone)
    throw Error(ErrorCode::InvalidData, "no face can be made of the " + std::to_string(scan.points.size()) +
                                            " points: they are too few, or they lie on a line");
  s.u = average_normals(s.mesh, s.u, options.averaging_passes);
  s.averaging_passes = options.averaging_passes;
  if (options.averaging_passes > 0 || from_faces(s.normals)) copy_to_twins(s);
  count_points(scan, s);
  const bool needs_agreement = !scan.is_mesh() && s.agreement.pairs == 0;
  if (alone) {
    s.spacing = median_spacing(scan.points);
    if (needs_agreement) s.agreement = normal_agreement(scan.points, s.u, {}, stage(run, 0.9, 1.0));
    return s;
  }
  const auto look_at_faces = [&](std::size_t task) {
    if (task == 0) s.spacing = median_edge_length(s.mesh);
    if (task == 1 && needs_agreement) s.agreement = agreement_on_faces(s.mesh, s.u);
  };
  parallel_for(2, 1, stage(run, 0.9, 1.0), [&](std::size_t task, std::size_t, int) { look_at_faces(task); });
  return s;
}

namespace {

/// Radius of the disc over which the normals are averages: that of the planes, and of the passes over the edges, each
/// of which adds about half a spacing squared to the second moment along an axis, a sixth of the radius squared.
double effective_normal_radius(const Surface& s) {
  const double of_neighbours = std::sqrt(s.normal_neighbours / kPi) * s.scale.spacing;
  const double of_planes = std::max(s.normal_radius, of_neighbours);
  return std::sqrt(of_planes * of_planes + 3 * s.averaging_passes * s.scale.spacing * s.scale.spacing);
}

double radius_for_noise(const Surface& s) {
  const double least = kAutomaticRadius * s.spacing;
  if (!(s.scale.noise >= 0)) return least;
  return balanced_radius(s.scale, effective_normal_radius(s), least, kLargestRadius * s.spacing);
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

std::string automatic_radius_reason(const Surface& s) {
  std::string edges = "5 median edges of " + short_number(s.spacing);
  if (!(s.scale.noise >= 0)) return edges;
  if (!(radius_for_noise(s) > kAutomaticRadius * s.spacing))
    return edges + ", noise " + short_number(s.scale.noise) + " asks for no more";
  return "more than " + edges + ", for noise " + short_number(s.scale.noise) + ": error of mean curvature about " +
         short_number(std::hypot(curvature_noise(s.scale, radius_for_noise(s), effective_normal_radius(s)),
                                 curvature_bias(s.scale, radius_for_noise(s), effective_normal_radius(s))));
}

double automatic_radius(const Surface& surface) {
  const double radius = radius_for_noise(surface);
  if (!(radius > 0 && std::isfinite(radius))) return kNaN;
  const double unit = std::pow(10.0, std::floor(std::log10(radius)) - 1);
  // Division by a power of ten gives the double nearest to the decimal, multiplication might not.
  return unit < 1 ? std::round(radius / unit) / std::round(1 / unit) : std::round(radius / unit) * unit;
}

RandomTriangleOptions random_triangle_options(TriangleScheme scheme, const SurfaceOptions& options) {
  RandomTriangleOptions triangles;
  triangles.scheme = scheme;
  triangles.neighbours = options.neighbours.value_or(triangles.neighbours);
  triangles.triangles = options.triangles;
  triangles.seed = options.seed;
  return triangles;
}

}  // namespace kappa
