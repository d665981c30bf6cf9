// SPDX-License-Identifier: BSD-3-Clause
#include "measure_tree_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/large_array.hpp"
#include "core/parallel_bounds.hpp"
#include "kappa/core/bounds.hpp"

namespace kappa {
namespace {

constexpr std::size_t kLeaf = 8, kBlock = 16384;
constexpr std::size_t kParts = 256, kSmall = 4096;  ///< parts that threads share, unless they are that small

/// Centroid of a triangle in the unit cube around all of them; floats, for they only order.
struct Centroid {
  float x[3];
  Index triangle;
};

Vec3 centroid(const Triangles& t, std::size_t i) {
  const auto& c = t.corners[i];
  return t.x[c[0]] / 3 + t.x[c[1]] / 3 + t.x[c[2]] / 3;
}

std::vector<Centroid> unit_centroids(const Triangles& t, const Execution& run) {
  const Bounds bounds = parallel_bounds(t.size(), run, [&](std::size_t i, Bounds& b) {
    const Vec3 x = centroid(t, i);
    b.min = b.min.cwiseMin(x);
    b.max = b.max.cwiseMax(x);
  });
  const double extent = t.size() == 0 ? 0.0 : (bounds.max - bounds.min).maxCoeff();
  const double scale = extent > 0 && std::isfinite(1 / extent) ? 1 / extent : 0.0;
  auto unit = large_vector(t.size(), Centroid(), run);
  parallel_for(t.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 x = centroid(t, i);
      for (int axis = 0; axis < 3; ++axis) unit[i].x[axis] = static_cast<float>((x[axis] - bounds.min[axis]) * scale);
      unit[i].triangle = static_cast<Index>(i);
    }
  });
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

/// Some of the centroids, with a power of two that is not below their count.
struct Part {
  Centroid *begin, *end;
  std::size_t capacity;

  std::size_t count() const { return static_cast<std::size_t>(end - begin); }
  bool is_leaf() const { return count() <= kLeaf; }
};

/// Puts the lower ones before the others, of a part that is no leaf.
std::pair<Part, Part> halves(const Part& part) {
  std::size_t half = part.capacity / 2;
  while (half >= part.count()) half /= 2;
  const int axis = longest_axis(part.begin, part.end);
  Centroid* const middle = part.begin + half;
  std::nth_element(part.begin, middle, part.end, [axis](const Centroid& a, const Centroid& b) {
    return a.x[axis] < b.x[axis] || (a.x[axis] == b.x[axis] && a.triangle < b.triangle);
  });
  return {{part.begin, middle, half}, {middle, part.end, half}};
}

void split(const Part& part) {
  if (part.is_leaf()) return;
  const auto [lower, upper] = halves(part);
  split(lower);
  split(upper);
}

/// The same level by level, until there are enough parts for all threads.
void split(const Part& whole, const Execution& run) {
  std::vector<Part> parts = {whole};
  for (std::size_t capacity = whole.capacity; parts.size() < kParts && capacity > kSmall; capacity /= 2) {
    std::vector<Part> below(2 * parts.size(), {whole.end, whole.end, 0});
    parallel_for(parts.size(), 1, run, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        below[2 * i] = parts[i];
        if (!parts[i].is_leaf()) std::tie(below[2 * i], below[2 * i + 1]) = halves(parts[i]);
      }
    });
    parts.swap(below);
  }
  parallel_for(parts.size(), 1, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) split(parts[i]);
  });
}

}  // namespace

std::vector<Index> tree_order(const Triangles& triangles, const Execution& run) {
  std::vector<Centroid> centroids = unit_centroids(triangles, run);
  std::size_t capacity = 1;
  while (capacity < centroids.size()) capacity *= 2;
  split({centroids.data(), centroids.data() + centroids.size(), capacity}, run);
  std::vector<Index> order(centroids.size());
  std::transform(centroids.begin(), centroids.end(), order.begin(), [](const Centroid& c) { return c.triangle; });
  return order;
}

}  // namespace kappa
