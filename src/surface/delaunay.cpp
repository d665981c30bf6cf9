// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/delaunay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include <boost/polygon/voronoi.hpp>

#include "cell_grid.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"

namespace kappa {
namespace {

using Triangle = std::array<Index, 3>;
using Site = boost::polygon::point_data<std::int32_t>;

/// Points at distinct positions in plan, on a grid of integers.
struct Sites {
  std::vector<Site> positions;
  std::vector<Index> points;
};

/// Maps plan positions to integers of at most 2^29 in size, so that their cross products fit in 64 bits. The scale is
/// a power of two: positions on a grid stay on a grid.
class PlanGrid {
 public:
  explicit PlanGrid(const Bounds& b) : centre_(0.5 * (b.min + b.max)) {
    const double half = 0.5 * std::max(b.max.x() - b.min.x(), b.max.y() - b.min.y());
    if (half > 0) scale_ = std::ldexp(1.0, 28 - std::ilogb(half));
  }
  Site operator()(const Vec3& p) const {
    return {static_cast<std::int32_t>(std::lround((p.x() - centre_.x()) * scale_)),
            static_cast<std::int32_t>(std::lround((p.y() - centre_.y()) * scale_))};
  }

 private:
  const Vec3 centre_;
  double scale_ = 1;
};

/// One site a position in plan; notes in `surface` which point stands for which.
Sites select_sites(const std::vector<Vec3>& points, PlanDuplicates duplicates, CloudSurface& surface) {
  struct Entry {
    std::int32_t x, y;
    double height;  ///< the lowest comes first
    Index point;
  };
  const PlanGrid grid(bounds(points));
  std::vector<Entry> entries;
  for (Index i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) continue;
    const Site s = grid(points[i]);
    entries.push_back({s.x(), s.y(), duplicates == PlanDuplicates::Highest ? -points[i].z() : points[i].z(), i});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.x, a.y, a.height, a.point) < std::tie(b.x, b.y, b.height, b.point);
  });
  surface.invalid_points = points.size() - entries.size();
  surface.representative.assign(points.size(), kNoIndex);
  Sites sites;
  for (const Entry& e : entries) {
    const Site site(e.x, e.y);
    if (sites.positions.empty() || !(sites.positions.back() == site)) {
      sites.positions.push_back(site);
      sites.points.push_back(e.point);
    } else {
      ++surface.duplicate_points;
    }
    surface.representative[e.point] = sites.points.back();
  }
  return sites;
}

/// True if the triangle turns counter-clockwise and is higher than what rounding to integers makes of a line.
bool counter_clockwise(const Site& a, const Site& b, const Site& c) {
  constexpr double kRounding = 2;
  const auto edge = [](const Site& from, const Site& to) {
    return std::array<std::int64_t, 2>{std::int64_t{to.x()} - from.x(), std::int64_t{to.y()} - from.y()};
  };
  const auto length = [](const std::array<std::int64_t, 2>& e) {
    return std::hypot(static_cast<double>(e[0]), static_cast<double>(e[1]));
  };
  const auto ab = edge(a, b), ac = edge(a, c), bc = edge(b, c);
  const double twice_area = static_cast<double>(ab[0] * ac[1] - ac[0] * ab[1]);
  return twice_area > kRounding * std::max({length(ab), length(ac), length(bc)});
}

/// Cuts a polygon with its corners on a circle in triangles, a quadrangle along the shorter diagonal in space.
void split_polygon(std::vector<std::size_t>& polygon, const Sites& sites, const std::vector<Vec3>& points,
                   std::vector<Triangle>& triangles) {
  const auto length_sq = [&](std::size_t a, std::size_t b) {
    return (points[sites.points[polygon[a]]] - points[sites.points[polygon[b]]]).squaredNorm();
  };
  if (polygon.size() == 4 && length_sq(1, 3) < length_sq(0, 2))
    std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const std::size_t a = polygon[0], b = polygon[i - 1], c = polygon[i];
    if (counter_clockwise(sites.positions[a], sites.positions[b], sites.positions[c]))
      triangles.push_back({sites.points[a], sites.points[b], sites.points[c]});
  }
}

/// The triangles that are dual to the vertices of the Voronoi diagram.
std::vector<Triangle> triangulate(const Sites& sites, const std::vector<Vec3>& points, const Execution& run) {
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(sites.positions.begin(), sites.positions.end(), &diagram);
  check_cancelled(run);
  std::vector<Triangle> triangles;
  triangles.reserve(2 * sites.points.size());
  std::vector<std::size_t> polygon;
  for (const auto& vertex : diagram.vertices()) {
    polygon.clear();
    const auto* edge = vertex.incident_edge();
    do {
      polygon.push_back(edge->cell()->source_index());
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    split_polygon(polygon, sites, points, triangles);
  }
  return triangles;
}

double plan_length(const Vec3& a, const Vec3& b) {
  return (a - b).head<2>().norm();
}

double median_plan_edge(const std::vector<Triangle>& triangles, const std::vector<Vec3>& points) {
  if (triangles.empty()) return kNaN;
  std::vector<double> lengths;
  lengths.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) lengths.push_back(plan_length(points[t[i]], points[t[(i + 1) % 3]]));
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

bool has_edge_above(const Triangle& t, const std::vector<Vec3>& x, double limit) {
  return plan_length(x[t[0]], x[t[1]]) > limit || plan_length(x[t[1]], x[t[2]]) > limit ||
         plan_length(x[t[2]], x[t[0]]) > limit;
}

}  // namespace

const std::vector<Named<PlanDuplicates>>& names_of(PlanDuplicates) {
  static const std::vector<Named<PlanDuplicates>> names = {
      {PlanDuplicates::Highest, "highest", "the surface seen from above"},
      {PlanDuplicates::Lowest, "lowest", "nearer to the ground"}};
  return names;
}

PlanSurface delaunay_surface(const Vec3& origin, const std::vector<Vec3>& points, const DelaunayOptions& options,
                             const Execution& run) {
  if (!(options.max_edge > 0))
    throw Error(ErrorCode::InvalidArgument,
                "max_edge = " + std::to_string(options.max_edge) + ": give a positive number of spacings");
  PlanSurface result;
  Mesh& mesh = result.surface.mesh;
  mesh.origin = origin;
  mesh.vertices = points;
  const Sites sites = select_sites(points, options.duplicates, result.surface);
  check_cancelled(run);
  const std::vector<Triangle> triangles = triangulate(sites, points, run);
  result.spacing = median_plan_edge(triangles, points);
  const double limit = options.max_edge * result.spacing;
  for (const Triangle& t : triangles) {
    if (has_edge_above(t, points, limit)) {
      ++result.cut_faces;
    } else {
      mesh.faces.add(t[0], t[1], t[2]);
    }
  }
  result.surface.starless_points = count_faceless(mesh) - result.surface.duplicate_points;
  return result;
}

}  // namespace kappa
