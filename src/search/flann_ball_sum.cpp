// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/flann_ball_sum.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "balls/ball_workspace.hpp"
#include "balls/whole_measures.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kd_tree.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 64;

/// Triangles whose bounding radii around their centroids lie within one octave.
struct SizeClass {
  std::vector<Index> triangles;  ///< along a space-filling curve
  std::unique_ptr<KdTree> centroids;
  double bound = 0;  ///< largest bounding radius
};

Vec3 centroid(const Triangles& t, std::size_t i) {
  const auto& c = t.corners[i];
  const Vec3& x0 = t.x[c[0]];
  return x0 + ((t.x[c[1]] - x0) + (t.x[c[2]] - x0)) / 3.0;
}

double bounding_radius(const Triangles& t, std::size_t i) {
  const Vec3 centre = centroid(t, i);
  double bound_sq = 0;
  for (const Index v : t.corners[i]) bound_sq = std::max(bound_sq, (t.x[v] - centre).squaredNorm());
  return std::sqrt(bound_sq);
}

SizeClass make_class(const Triangles& t, const std::vector<double>& bounds, std::vector<Index> members,
                     const Execution& run) {
  std::vector<Vec3> centres(members.size());
  std::transform(members.begin(), members.end(), centres.begin(), [&](Index i) { return centroid(t, i); });
  SizeClass c;
  std::vector<Vec3> sorted;
  for (const Index i : spatial_order(centres, run)) {
    c.triangles.push_back(members[i]);
    sorted.push_back(centres[i]);
    c.bound = std::max(c.bound, bounds[members[i]]);
  }
  c.centroids = std::make_unique<KdTree>(sorted);
  return c;
}

/// What one thread needs over and over.
struct Workspace {
  BallWorkspace<double> balls;
  std::vector<Index> found;
  std::vector<double> distances_sq;
  std::vector<Index> rim;  ///< triangles that the sphere may cut
};

std::vector<double> bounding_radii(const Triangles& t, const Execution& run) {
  constexpr std::size_t kMany = 4096;
  std::vector<double> bounds(t.size());
  parallel_for(t.size(), kMany, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) bounds[i] = bounding_radius(t, i);
  });
  return bounds;
}

std::vector<SizeClass> make_classes(const Triangles& t, const std::vector<double>& bounds, const Execution& run) {
  std::map<int, std::vector<Index>> octaves;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const int octave = bounds[i] > 0 ? std::ilogb(bounds[i]) : std::numeric_limits<int>::min();
    octaves[octave].push_back(static_cast<Index>(i));
  }
  std::vector<SizeClass> classes;
  for (auto& [octave, members] : octaves) {
    check_cancelled(run);
    classes.push_back(make_class(t, bounds, std::move(members), stage(run, 0.0, 0.0)));
  }
  return classes;
}

}  // namespace

struct FlannBallSum::Impl {
  Triangles triangles;
  std::vector<MeasureSum> measures;
  std::vector<double> bounds;  ///< of each triangle
  std::vector<SizeClass> classes;
  const kernels::Table& table = kernels::best_table();
  kernels::TriangleView view;

  Impl(Triangles given, const Execution& run)
      : triangles(std::move(given)),
        measures(measure_triangles(triangles, stage(run, 0.0, 0.2))),
        bounds(bounding_radii(triangles, stage(run, 0.2, 0.3))),
        classes(make_classes(triangles, bounds, stage(run, 0.3, 1.0))),
        view(view_of(triangles, measures)) {}

  /// Adds what the search found to a ball: by the distance of their centroids and their bounding radii, triangles lie
  /// inside, outside, or on the rim.
  void add_found(const SizeClass& c, int radius, const kernels::BallQuery<double>& query, Workspace& w) const {
    constexpr double kRounding = 1e-12;
    const double in = query.radii[radius] * (1 - kRounding), out = query.radii[radius] * (1 + kRounding);
    MeasureSum inside;
    Index count = 0;
    w.rim.clear();
    for (std::size_t i = 0; i < w.found.size(); ++i) {
      const Index t = c.triangles[w.found[i]];
      const double left = in - bounds[t], reach = out + bounds[t];
      if (left >= 0 && w.distances_sq[i] <= left * left) {
        inside += measures[t];
        ++count;
      } else if (w.distances_sq[i] <= reach * reach) {
        w.rim.push_back(t);
      }
    }
    w.balls.add_whole(static_cast<std::size_t>(radius), inside, count);
    table.add(view, query, radius, w.rim.data(), w.rim.size());
  }

  const BallMeasures* query(const Vec3& centre, double largest, Workspace& w) const {
    constexpr double kMargin = 1 + 1e-9;
    return w.balls.measure(centre, [&](const kernels::BallQuery<double>& query) {
      for (const SizeClass& c : classes) {
        c.centroids->within(centre, (largest + c.bound) * kMargin, w.found, w.distances_sq);
        for (int r = 0; r < query.count; ++r) {
          if (query.radii[r] > 0) add_found(c, r, query, w);
        }
      }
      for (int r = 0; r < query.count; ++r) table.finish(view, query, r);
    });
  }
};

FlannBallSum::FlannBallSum(Triangles triangles, const Execution& run)
    : impl_(std::make_unique<Impl>(std::move(triangles), run)) {}
FlannBallSum::~FlannBallSum() = default;

const Triangles& FlannBallSum::triangles() const {
  return impl_->triangles;
}

MeasureSum FlannBallSum::measures_of(std::size_t triangle) const {
  return impl_->measures[triangle];
}

void FlannBallSum::do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball,
                          const Execution& run, const Sink& sink) const {
  const std::vector<Index> order = spatial_order(centres, stage(run, 0.0, 0.0));
  const Workspace empty = {BallWorkspace<double>(impl_->triangles, impl_->measures, ball), {}, {}, {}};
  std::vector<Workspace> workspaces(static_cast<std::size_t>(thread_count(run)), empty);
  const SortedRadii common(radii.of(0), radii.are_common() ? radii.count() : 0);
  parallel_for(centres.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
    Workspace& w = workspaces[static_cast<std::size_t>(worker)];
    for (std::size_t i = begin; i < end; ++i) {
      const Index q = order[i];
      const SortedRadii own(radii.of(q), radii.are_common() ? 0 : radii.count());
      const SortedRadii& sorted = radii.are_common() ? common : own;
      w.balls.use(sorted);
      sink(q, impl_->query(centres[q], sorted.radii.back(), w));
    }
  });
}

}  // namespace kappa
