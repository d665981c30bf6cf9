// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/random_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "hash_random.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kappa/search/neighbours.hpp"
#include "search/distinct_points.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;
constexpr int kSectors = 6;

/// A point and its neighbours, positions relative to the point. The point itself comes first.
struct Neighbourhood {
  std::vector<Vec3> x;
  Normals u;
};

/// Corner of a triangle.
struct Corner {
  Vec3 x, u;
};

/// Adds a triangle, turned so that its corrected area is positive: turning it changes the sign of every measure.
void add_triangle(const Corner& a, const Corner& b, const Corner& c, BallMeasures& to) {
  MeasureSum m = triangle_density_sum(b.x - a.x, c.x - a.x, b.u - a.u, c.u - a.u, (a.u + b.u + c.u) / 3);
  if (!(std::abs(m.mu0) > kDegenerateArea * m.area)) return;
  if (m.mu0 < 0) {
    m *= -1;
    m.area = -m.area;
  }
  to.sum += m;
  ++to.face_count;
}

void add_uniform(const Neighbourhood& near, int triangles, HashRandom random, BallMeasures& to) {
  const auto count = static_cast<std::uint32_t>(near.x.size());
  for (int t = 0; t < triangles; ++t) {
    const std::uint32_t a = random.below(count), b = random.below(count), c = random.below(count);
    if (a == b || b == c || c == a) continue;
    add_triangle({near.x[a], near.u[a]}, {near.x[b], near.u[b]}, {near.x[c], near.u[c]}, to);
  }
}

void add_independent(const Neighbourhood& near, int triangles, HashRandom random, BallMeasures& to) {
  const auto count = static_cast<std::uint32_t>(near.x.size());
  const std::uint32_t corners = 3 * std::min(static_cast<std::uint32_t>(triangles), count / 3);
  std::array<std::uint32_t, 255> order;
  std::iota(order.begin(), order.begin() + count, 0U);
  for (std::uint32_t i = 0; i < corners; ++i) std::swap(order[i], order[i + random.below(count - i)]);
  for (std::uint32_t i = 0; i < corners; i += 3) {
    const auto corner = [&](std::uint32_t k) { return Corner{near.x[order[k]], near.u[order[k]]}; };
    add_triangle(corner(i), corner(i + 1), corner(i + 2), to);
  }
}

/// The six corners of the two triangles around a point: directions at 60 degrees in the plane orthogonal to the mean
/// of its normal and the average one of its neighbours, at their mean distance.
class Hexagram {
 public:
  explicit Hexagram(const Neighbourhood& near) {
    Vec3 u_sum = Vec3::Zero();
    double distance_sum = 0;
    for (std::size_t j = 0; j < near.x.size(); ++j) {
      u_sum += near.u[j];
      distance_sum += near.x[j].norm();
    }
    const double distance = distance_sum / static_cast<double>(near.x.size());
    const Vec3 axis = near.u.front() + u_sum.normalized();
    Vec3 t1, t2;
    tangent_basis(axis.norm() > 0 ? Vec3(axis.normalized()) : near.u.front(), t1, t2);
    const double half = 0.5 * distance, high = std::sqrt(0.75) * distance;
    targets_ = {distance * t1,  half * t1 + high * t2,  -half * t1 + high * t2,
                -distance * t1, -half * t1 - high * t2, half * t1 - high * t2};
  }

  /// Twice the scalar products with the six targets: with |x|^2 taken off, it grows as x comes nearer to the target,
  /// and is positive if x is nearer to it than the point is.
  std::array<double, kSectors> nearness(const Vec3& x) const {
    std::array<double, kSectors> values;
    std::transform(targets_.begin(), targets_.end(), values.begin(), [&](const Vec3& t) { return 2 * t.dot(x); });
    return values;
  }

 private:
  std::array<Vec3, kSectors> targets_;
};

void add_hexagram(const std::array<Corner, kSectors>& c, BallMeasures& to) {
  add_triangle(c[0], c[2], c[4], to);
  add_triangle(c[1], c[3], c[5], to);
}

/// Each corner is the neighbour nearest to its target, or the point itself if no other is nearer.
void add_nearest_hexagram(const Neighbourhood& near, BallMeasures& to) {
  const Hexagram hexagram(near);
  std::array<double, kSectors> best{};
  std::array<std::size_t, kSectors> chosen{};
  for (std::size_t j = 1; j < near.x.size(); ++j) {
    const std::array<double, kSectors> nearness = hexagram.nearness(near.x[j]);
    const double distance_sq = near.x[j].squaredNorm();
    for (std::size_t k = 0; k < kSectors; ++k) {
      if (nearness[k] - distance_sq <= best[k]) continue;
      best[k] = nearness[k] - distance_sq;
      chosen[k] = j;
    }
  }
  std::array<Corner, kSectors> corners;
  for (std::size_t k = 0; k < kSectors; ++k) corners[k] = {near.x[chosen[k]], near.u[chosen[k]]};
  add_hexagram(corners, to);
}

/// Each corner is the average of the neighbours that are nearest to its target; the point itself if there is none.
void add_averaged_hexagram(const Neighbourhood& near, BallMeasures& to) {
  const Hexagram hexagram(near);
  std::array<Corner, kSectors> corners;
  corners.fill({Vec3::Zero(), Vec3::Zero()});
  std::array<int, kSectors> counts{};
  for (std::size_t j = 0; j < near.x.size(); ++j) {
    const std::array<double, kSectors> nearness = hexagram.nearness(near.x[j]);
    const auto k = static_cast<std::size_t>(std::max_element(nearness.begin(), nearness.end()) - nearness.begin());
    corners[k].x += near.x[j];
    corners[k].u += near.u[j];
    ++counts[k];
  }
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (counts[k] > 0 && corners[k].u.norm() > 0) {
      corners[k] = {corners[k].x / counts[k], corners[k].u.normalized()};
    } else {
      corners[k] = {near.x.front(), near.u.front()};
    }
  }
  add_hexagram(corners, to);
}

BallMeasures measure(const Neighbourhood& near, const RandomTriangleOptions& options, const HashRandom& random) {
  BallMeasures sum;
  switch (options.scheme) {
    case TriangleScheme::Uniform:
      add_uniform(near, options.triangles, random, sum);
      break;
    case TriangleScheme::Independent:
      add_independent(near, options.triangles, random, sum);
      break;
    case TriangleScheme::Hexagram:
      add_nearest_hexagram(near, sum);
      break;
    case TriangleScheme::AveragedHexagram:
      add_averaged_hexagram(near, sum);
      break;
  }
  return sum;
}

CurvatureSample make_sample(const BallMeasures& m, const Vec3& u) {
  CurvatureSample s;
  s.face_count = m.face_count;
  s.area = m.sum.area;
  s.mu0 = m.sum.mu0;
  s.mu1 = m.sum.mu1();
  s.mu2 = m.sum.mu2;
  if (m.face_count > 0) {
    s.k = curvatures(m.sum, u);
  } else {
    s.k.status = PointStatus::Empty;
  }
  return s;
}

/// Gathers neighbourhoods, one thread's worth of memory.
class Gatherer {
 public:
  Gatherer(const DistinctPoints& cloud, const NeighbourSearch& search, int neighbours)
      : cloud_(cloud), search_(search), k_(static_cast<std::size_t>(neighbours)) {}

  const Neighbourhood& around(std::size_t i) {
    search_.nearest(cloud_.x[i], k_, found_, distances_sq_);
    near_.x.clear();
    near_.u.clear();
    for (const Index j : found_) {
      near_.x.emplace_back(cloud_.x[j] - cloud_.x[i]);
      near_.u.push_back(cloud_.u[j]);
    }
    return near_;
  }

 private:
  const DistinctPoints& cloud_;
  const NeighbourSearch& search_;
  const std::size_t k_;
  std::vector<Index> found_;
  std::vector<double> distances_sq_;
  Neighbourhood near_;
};

void check(const RandomTriangleOptions& options) {
  check_range("neighbours", options.neighbours, 3, 255, "random triangles");
  check_range("triangles", options.triangles, 1, 1000000, "random triangles");
}

}  // namespace

CurvatureField random_triangle_curvatures(const std::vector<Vec3>& points, const Normals& normals,
                                          const RandomTriangleOptions& options, const Execution& run) {
  check(options);
  const DistinctPoints cloud = distinct_points(points, normals);
  if (cloud.x.empty())
    throw Error(ErrorCode::InvalidData, "none of the " + std::to_string(points.size()) +
                                            " points is finite and has a normal: no triangle can be made of them");
  const NeighbourSearch search(cloud.x);
  const std::vector<Index> order = spatial_order(cloud.x);
  CurvatureField field;
  field.samples.resize(points.size());
  parallel_for(order.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    Gatherer gatherer(cloud, search, options.neighbours);
    for (std::size_t n = begin; n < end; ++n) {
      const Index i = order[n], original = cloud.original[i];
      const BallMeasures m = measure(gatherer.around(i), options, HashRandom(options.seed, original));
      field.samples[original] = make_sample(m, cloud.u[i]);
    }
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cloud.representative[i] != kNoIndex) field.samples[i] = field.samples[cloud.representative[i]];
  }
  return field;
}

const std::vector<Named<TriangleScheme>>& names_of(TriangleScheme) {
  static const std::vector<Named<TriangleScheme>> names = {
      {TriangleScheme::Uniform, "uniform", "three different neighbours, drawn anew for each triangle"},
      {TriangleScheme::Independent, "independent", "neighbours in random order, three by three"},
      {TriangleScheme::Hexagram, "hexagram", "two triangles of the neighbours nearest to a hexagram"},
      {TriangleScheme::AveragedHexagram, "avg-hexagram",
       "two triangles of the averages of the neighbours in six sectors"},
  };
  return names;
}

}  // namespace kappa
