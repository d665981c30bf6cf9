// SPDX-License-Identifier: BSD-3-Clause
#include "measure_tree_order.hpp"

#include <algorithm>

namespace kappa {
namespace {

constexpr std::size_t kLeaf = 8;

/// Centroid of a triangle in the unit cube around all of them; floats, for they only order.
struct Centroid {
  float x[3];
  Index triangle;
};

std::vector<Centroid> unit_centroids(const MeasuredTriangles& t) {
  std::vector<Vec3> centroids(t.size());
  Bounds bounds;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto& c = t.corners[i];
    centroids[i] = t.x[c[0]] / 3 + t.x[c[1]] / 3 + t.x[c[2]] / 3;
    bounds.min = bounds.min.cwiseMin(centroids[i]);
    bounds.max = bounds.max.cwiseMax(centroids[i]);
  }
  const double extent = t.size() == 0 ? 0.0 : (bounds.max - bounds.min).maxCoeff();
  const double scale = extent > 0 && std::isfinite(1 / extent) ? 1 / extent : 0.0;
  std::vector<Centroid> unit(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      unit[i].x[axis] = static_cast<float>((centroids[i][axis] - bounds.min[axis]) * scale);
    unit[i].triangle = static_cast<Index>(i);
  }
  return unit;
}

int longest_axis(const Centroid* begin, const Centroid* end) {
  float lo[3], hi[3];
  std::copy_n(begin->x, 3, lo);
  std::copy_n(begin->x, 3, hi);
  for (const Centroid* c = begin; c != end; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], c->x[axis]);
      hi[axis] = std::max(hi[axis], c->x[axis]);
    }
  }
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (hi[axis] - lo[axis] > hi[longest] - lo[longest]) longest = axis;
  }
  return longest;
}

/// `capacity`: a power of two, not below the count.
void split(Centroid* begin, Centroid* end, std::size_t capacity) {
  const auto count = static_cast<std::size_t>(end - begin);
  if (count <= kLeaf) return;
  std::size_t half = capacity / 2;
  while (half >= count) half /= 2;
  const int axis = longest_axis(begin, end);
  Centroid* const middle = begin + half;
  std::nth_element(begin, middle, end, [axis](const Centroid& a, const Centroid& b) {
    return a.x[axis] < b.x[axis] || (a.x[axis] == b.x[axis] && a.triangle < b.triangle);
  });
  split(begin, middle, half);
  split(middle, end, half);
}

}  // namespace

std::vector<Index> tree_order(const MeasuredTriangles& triangles) {
  std::vector<Centroid> centroids = unit_centroids(triangles);
  std::size_t capacity = 1;
  while (capacity < centroids.size()) capacity *= 2;
  split(centroids.data(), centroids.data() + centroids.size(), capacity);
  std::vector<Index> order(centroids.size());
  std::transform(centroids.begin(), centroids.end(), order.begin(), [](const Centroid& c) { return c.triangle; });
  return order;
}

}  // namespace kappa
