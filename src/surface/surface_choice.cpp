// SPDX-License-Identifier: BSD-3-Clause
#include "surface_choice.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::InvalidArgument, message);
}

std::optional<Vec3> local_viewpoint(const Scan& scan, const SurfaceOptions& options) {
  if (options.viewpoint && !is_finite(*options.viewpoint))
    refuse("the viewpoint is not finite; give three finite coordinates");
  const std::optional<Vec3>& viewpoint = options.viewpoint ? options.viewpoint : scan.viewpoint;
  if (!viewpoint) return std::nullopt;
  return Vec3(*viewpoint - scan.origin);
}

/// Distance from the box of the points, in units of its diagonal.
double distance_from(const Bounds& b, const Vec3& viewpoint) {
  const Vec3 nearest = viewpoint.cwiseMax(b.min).cwiseMin(b.max);
  return (viewpoint - nearest).norm() / b.diagonal();
}

/// Whether all points lie within 45 degrees of the z axis from `viewpoint`, as in the frame of a depth camera.
bool in_camera_frame(const std::vector<Vec3>& points, const Vec3& viewpoint) {
  return std::all_of(points.begin(), points.end(), [&](const Vec3& x) {
    const Vec3 d = x - viewpoint;
    return !is_finite(x) || (std::abs(d.x()) <= d.z() && std::abs(d.y()) <= d.z());
  });
}

/// Whether points lie steeply above and steeply below `viewpoint`, as ceiling and floor do for a scanner in a room, and
/// no terrain does for any place.
bool is_indoors(const std::vector<Vec3>& points, const Vec3& viewpoint) {
  constexpr double kShare = 0.001;
  std::size_t above = 0, below = 0;
  for (const Vec3& x : points) {
    const Vec3 d = x - viewpoint;
    const double across = std::hypot(d.x(), d.y());
    above += d.z() > across;
    below += -d.z() > across;
  }
  return static_cast<double>(std::min(above, below)) > kShare * static_cast<double>(points.size());
}

/// Whether the points are low for their extent in plan, and mostly above `viewpoint`.
bool is_terrain_above(const std::vector<Vec3>& points, const Bounds& b, const Vec3& viewpoint) {
  constexpr double kLow = 0.35;
  const Vec3 extent = b.max - b.min;
  if (extent.z() > kLow * std::sqrt(extent.x() * extent.y())) return false;
  const auto above = std::count_if(points.begin(), points.end(), [&](const Vec3& x) { return x.z() > viewpoint.z(); });
  return 2 * static_cast<std::size_t>(above) > points.size();
}

/// Whether a scanner may have stood at the viewpoint of the file. Files that know none say (0, 0, 0), which for
/// georeferenced data is far away and for a tile moved to the origin lies under the ground.
bool is_credible(const Scan& scan, const Vec3& viewpoint) {
  constexpr double kFar = 10;
  const Bounds b = bounds(scan.points);
  const double distance = distance_from(b, viewpoint);
  const bool stated = !scan.viewpoint->isZero(0) || scan.is_organised() || in_camera_frame(scan.points, viewpoint);
  if (stated) return distance <= kFar;
  return distance <= 1 && (is_indoors(scan.points, viewpoint) || !is_terrain_above(scan.points, b, viewpoint));
}

/// Whether a cloud is an unorganised sweep of a spinning scanner: such files have points at the scanner itself, or
/// without a position, where there was no return, and the others lie on the rings of at most 128 lasers.
bool is_sweep(const Scan& scan, const Vec3& viewpoint) {
  constexpr double kAtScanner = 0.001, kExtraReturns = 0.2;
  constexpr std::size_t kLasers = 128;
  const double points = static_cast<double>(scan.points.size());
  const auto missing = std::count_if(scan.points.begin(), scan.points.end(),
                                     [&](const Vec3& x) { return !is_finite(x) || x == viewpoint; });
  if (static_cast<double>(missing) < kAtScanner * points) return false;
  try {
    const SpinningSweep sweep = organise_sweep(scan.points, viewpoint);
    return sweep.rings <= kLasers && static_cast<double>(sweep.extra_returns) < kExtraReturns * points;
  } catch (const Error&) {
    return false;  // no rings
  }
}

void choose_kind(const Scan& scan, const SurfaceOptions& options, bool seen, SurfaceChoice& c) {
  const auto take = [&](SurfaceKind kind, const char* reason) {
    c.kind = kind;
    c.reason = reason;
  };
  if (options.surface != SurfaceKind::Auto) {
    take(options.surface, "as asked");
  } else if (scan.is_mesh()) {
    take(SurfaceKind::Faces, "the file has faces");
  } else if (seen && scan.is_organised() && scan.width > 1) {
    take(SurfaceKind::Grid, "organised in rows, seen from a known place");
  } else if (seen && scan.field("ring")) {
    take(SurfaceKind::Spinning, "the points have ring numbers, seen from a known place");
  } else if (seen && is_sweep(scan, *c.viewpoint)) {
    take(SurfaceKind::Spinning, "pulses without a return, and rings about the scanner");
  } else {
    take(SurfaceKind::Umbrella, "a cloud without faces");
  }
}

/// The nearest neighbours of a point of a sweep lie on its own ring, a line that nothing can be fitted to.
NormalsKind made_normals(SurfaceKind kind) {
  if (kind == SurfaceKind::Faces) return NormalsKind::Max;
  return kind == SurfaceKind::Spinning ? NormalsKind::Area : NormalsKind::Quadric;
}

void choose_normals(const Scan& scan, const SurfaceOptions& options, SurfaceChoice& c) {
  c.normals = options.normals;
  if (c.normals == NormalsKind::Auto) {
    c.normals = scan.normals.empty() ? made_normals(c.kind) : NormalsKind::Input;
  }
}

void choose_orientation(const SurfaceOptions& options, bool seen, SurfaceChoice& c) {
  if (options.orientation != Orientation::Auto) {
    c.orientation = options.orientation;
  } else if (c.normals == NormalsKind::Input) {
    c.orientation = Orientation::Input;
  } else if (c.kind == SurfaceKind::Faces || (from_faces(c.normals) && has_turned_faces(c.kind))) {
    c.orientation = Orientation::AsFaces;
  } else if (c.kind == SurfaceKind::Delaunay) {
    c.orientation = Orientation::Up;
  } else {
    c.orientation = seen ? Orientation::Viewpoint : Orientation::Auto;
  }
}

void check_kind(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& c) {
  if (c.kind == SurfaceKind::Faces && !scan.is_mesh())
    refuse("surface = faces, but the data has no faces; use umbrella for a cloud");
  if (c.kind == SurfaceKind::Grid && !scan.is_organised())
    refuse("surface = grid, but the data is not organised in rows; use umbrella, or spinning for a sweep");
  if (c.kind == SurfaceKind::Greedy && !options.greedy)
    refuse(
        "surface = greedy needs a function that makes the faces (options.greedy); give greedy_surface of kappa's pcl "
        "layer, or use umbrella");
  const bool seen = c.kind == SurfaceKind::Grid || c.kind == SurfaceKind::Spinning;
  if (seen && !c.viewpoint)
    refuse(std::string("surface = ") + name(c.kind) +
           " needs the place of the scanner; give its coordinates as viewpoint");
}

void check_normals(const Scan& scan, const SurfaceOptions& options, const SurfaceChoice& c) {
  if (from_faces(c.normals) && triangle_scheme(c.kind))
    refuse(std::string("surface = ") + name(c.kind) + " has no faces to take normals from; use quadric or input");
  if (options.averaging_passes > 0 && triangle_scheme(c.kind))
    refuse(std::string("surface = ") + name(c.kind) +
           " has no edges to average normals over; leave the averaging out, or use umbrella");
  if (c.normals != NormalsKind::Input) return;
  if (scan.normals.empty())
    refuse("normals = input, but the data has no normals; use " + std::string(scan.is_mesh() ? "max" : "quadric"));
  if (scan.normals.size() != scan.points.size())
    refuse(std::to_string(scan.normals.size()) + " normals for " + std::to_string(scan.points.size()) +
           " points: give one a point");
}

void check_orientation(const SurfaceChoice& c) {
  if (c.orientation == Orientation::Input && c.normals != NormalsKind::Input)
    refuse("orientation = input needs normals = input; use up, viewpoint or mst");
  if (c.orientation == Orientation::AsFaces && !has_turned_faces(c.kind))
    refuse("orientation by faces needs the faces of a mesh; use up, viewpoint or mst");
  if (c.orientation == Orientation::Viewpoint && !c.viewpoint)
    refuse("orientation = viewpoint, but none is known; give its coordinates");
}

}  // namespace

SurfaceChoice choose_surface(const Scan& scan, const SurfaceOptions& options) {
  SurfaceChoice c;
  c.viewpoint = local_viewpoint(scan, options);
  const bool seen = options.viewpoint || (c.viewpoint && is_credible(scan, *c.viewpoint));
  choose_kind(scan, options, seen, c);
  choose_normals(scan, options, c);
  choose_orientation(options, seen, c);
  check_kind(scan, options, c);
  check_normals(scan, options, c);
  check_orientation(c);
  return c;
}

}  // namespace kappa
