// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/surface.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/search/cloud_normals.hpp"

namespace kappa {
namespace {

bool from_faces(NormalsKind kind) {
  return kind == NormalsKind::Geometric || kind == NormalsKind::Area || kind == NormalsKind::Angle ||
         kind == NormalsKind::Max;
}

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

void choose_sources(const Scan& scan, const SurfaceOptions& options, Surface& s) {
  s.kind = options.surface;
  if (s.kind == SurfaceKind::Auto) s.kind = scan.is_mesh() ? SurfaceKind::Faces : SurfaceKind::Umbrella;
  if (s.kind == SurfaceKind::Faces && !scan.is_mesh())
    throw Error(ErrorCode::InvalidArgument, "surface = faces, but the data has no faces; use umbrella for a cloud");
  s.normals = options.normals;
  if (s.normals == NormalsKind::Auto) {
    const NormalsKind made = s.kind == SurfaceKind::Faces ? NormalsKind::Max : NormalsKind::Pca;
    s.normals = scan.normals.empty() ? made : NormalsKind::Input;
  }
  if (s.normals == NormalsKind::Input && scan.normals.empty())
    throw Error(ErrorCode::InvalidArgument,
                "normals = input, but the data has no normals; use " + std::string(scan.is_mesh() ? "max" : "pca"));
  if (s.normals == NormalsKind::Input && scan.normals.size() != scan.points.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(scan.normals.size()) + " normals for " +
                                                std::to_string(scan.points.size()) + " points: give one a point");
}

std::optional<Vec3> local_viewpoint(const Scan& scan, const SurfaceOptions& options) {
  const std::optional<Vec3>& viewpoint = options.viewpoint ? options.viewpoint : scan.viewpoint;
  if (!viewpoint) return std::nullopt;
  return Vec3(*viewpoint - scan.origin);
}

/// Whether a scanner may have stood there: files without a known viewpoint say (0, 0, 0), which for georeferenced
/// data is far away.
bool near_points(const Vec3& viewpoint, const Bounds& b) {
  const Vec3 nearest = viewpoint.cwiseMax(b.min).cwiseMin(b.max);
  return (viewpoint - nearest).norm() <= b.diagonal();
}

Orientation choose_orientation(const Scan& scan, const SurfaceOptions& options, const Surface& s) {
  if (options.orientation != Orientation::Auto) return options.orientation;
  if (s.normals == NormalsKind::Input) return Orientation::Input;
  if (from_faces(s.normals) && s.kind == SurfaceKind::Faces) return Orientation::AsFaces;
  const std::optional<Vec3> viewpoint = local_viewpoint(scan, options);
  if (options.viewpoint || (viewpoint && near_points(*viewpoint, bounds(scan.points)))) return Orientation::Viewpoint;
  return Orientation::Up;
}

void check_orientation(const Scan& scan, const SurfaceOptions& options, const Surface& s) {
  if (s.orientation == Orientation::Input && s.normals != NormalsKind::Input)
    throw Error(ErrorCode::InvalidArgument, "orientation = input needs normals = input; use up or viewpoint");
  if (s.orientation == Orientation::AsFaces && s.kind != SurfaceKind::Faces)
    throw Error(ErrorCode::InvalidArgument, "orientation by faces needs the faces of a mesh; use up or viewpoint");
  if (s.orientation == Orientation::Viewpoint && !local_viewpoint(scan, options))
    throw Error(ErrorCode::InvalidArgument, "orientation = viewpoint, but none is known; give its coordinates");
  if (options.viewpoint && !is_finite(*options.viewpoint))
    throw Error(ErrorCode::InvalidArgument, "the viewpoint is not finite; give three finite coordinates");
}

void orient(const Scan& scan, const SurfaceOptions& options, Surface& s) {
  if (s.orientation == Orientation::Up) orient_along(Vec3::UnitZ(), s.u);
  if (s.orientation == Orientation::Viewpoint) orient_towards(scan.points, *local_viewpoint(scan, options), s.u);
}

void use_faces(const Scan& scan, const SurfaceOptions& options, Surface& s, const Execution& run) {
  s.mesh = mesh_of(scan);
  if (s.normals == NormalsKind::Input) s.u = normalised(scan.normals);
  if (s.normals == NormalsKind::Pca) s.u = pca_normals(scan.points, {options.normal_neighbours}, run);
  if (from_faces(s.normals)) s.u = vertex_normals(s.mesh, weights_of(s.normals), run);
  orient(scan, options, s);
}

void use_umbrella(const Scan& scan, const SurfaceOptions& options, Surface& s, const Execution& run) {
  s.u = s.normals == NormalsKind::Input ? normalised(scan.normals)
                                        : pca_normals(scan.points, {options.normal_neighbours}, stage(run, 0.0, 0.5));
  orient(scan, options, s);
  CloudSurface cloud = umbrella_surface(scan.origin, scan.points, s.u, {options.neighbours}, stage(run, 0.5, 1.0));
  s.mesh = std::move(cloud.mesh);
  s.twins = std::move(cloud.representative);
  s.duplicate_points = cloud.duplicate_points;
  s.starless_points = cloud.starless_points;
  if (from_faces(s.normals)) s.u = vertex_normals(s.mesh, weights_of(s.normals));
}

/// Points that no face touches have the normals of the point that stands for them.
void copy_to_twins(Surface& s) {
  for (std::size_t i = 0; i < s.twins.size(); ++i) {
    if (s.twins[i] != kNoIndex) s.u[i] = s.u[s.twins[i]];
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
  if (bounds(scan.points).empty())
    throw Error(ErrorCode::InvalidData,
                "none of the " + std::to_string(scan.points.size()) + " points is finite: there is nothing to measure");
  Surface s;
  choose_sources(scan, options, s);
  s.orientation = choose_orientation(scan, options, s);
  check_orientation(scan, options, s);
  if (s.kind == SurfaceKind::Faces) {
    use_faces(scan, options, s, run);
  } else {
    use_umbrella(scan, options, s, run);
  }
  if (s.mesh.faces.empty())
    throw Error(ErrorCode::InvalidData, "no face can be made of the " + std::to_string(scan.points.size()) +
                                            " points: they are too few, or they lie on a line");
  s.u = average_normals(s.mesh, s.u, options.averaging_passes);
  if (options.averaging_passes > 0 || from_faces(s.normals)) copy_to_twins(s);
  count_points(scan, s);
  s.spacing = median_edge_length(s.mesh);
  return s;
}

double automatic_radius(const Surface& surface) {
  const double radius = kAutomaticRadius * surface.spacing;
  if (!(radius > 0 && std::isfinite(radius))) return kNaN;
  const double unit = std::pow(10.0, std::floor(std::log10(radius)) - 1);
  // Division by a power of ten gives the double nearest to the decimal, multiplication might not.
  return unit < 1 ? std::round(radius / unit) / std::round(1 / unit) : std::round(radius / unit) * unit;
}

const char* name(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Auto:
      return "auto";
    case SurfaceKind::Faces:
      return "faces";
    case SurfaceKind::Umbrella:
      return "umbrella";
  }
  return "";
}

const char* name(NormalsKind kind) {
  switch (kind) {
    case NormalsKind::Auto:
      return "auto";
    case NormalsKind::Input:
      return "input";
    case NormalsKind::Geometric:
      return "geometric";
    case NormalsKind::Area:
      return "area";
    case NormalsKind::Angle:
      return "angle";
    case NormalsKind::Max:
      return "max";
    case NormalsKind::Pca:
      return "pca";
  }
  return "";
}

const char* name(Orientation orientation) {
  switch (orientation) {
    case Orientation::Auto:
      return "auto";
    case Orientation::Input:
      return "input";
    case Orientation::AsFaces:
      return "faces";
    case Orientation::Up:
      return "up";
    case Orientation::Viewpoint:
      return "viewpoint";
  }
  return "";
}

}  // namespace kappa
