// SPDX-License-Identifier: BSD-3-Clause
#include "whole_measures.hpp"

#include <algorithm>

#include "core/large_array.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 2048;
constexpr std::size_t kAtHand = 256;  ///< measures that stay in the nearest cache

/// Calls `grow(begin, end)` for what fits in the nearest cache after the other: arrays that are cleared as they grow,
/// and then written, are passed over once.
template <class Grow>
void grow_at_hand(std::size_t count, const Grow& grow) {
  for (std::size_t begin = 0; begin < count; begin += kAtHand) grow(begin, std::min(begin + kAtHand, count));
}

void add_what_is_beside(const Triangles& t, std::vector<MeasureSum>& measures) {
  for (std::size_t i = 0; i < t.beside.size(); ++i) measures[i] += t.beside[i];
}

}  // namespace

kernels::TriangleView view_of(const Triangles& t, const std::vector<MeasureSum>& measures) {
  if (t.size() == 0) return {};
  const bool weighted = std::any_of(t.weights.begin(), t.weights.end(), [](double w) { return w != 1; });
  return {t.size(),
          measures.empty() ? nullptr : &measures[0].area,
          t.corners[0].data(),
          t.x[0].data(),
          t.u[0].data(),
          weighted ? t.weights.data() : nullptr,
          t.beside.empty() ? nullptr : &t.beside[0].area};
}

std::vector<MeasureSum> measure_triangles(const Triangles& t, const kernels::Table& table, const Execution& run) {
  std::vector<MeasureSum> measures;
  if (t.size() == 0) return measures;
  const kernels::TriangleView view = view_of(t, measures);
  const auto measure = [&](std::size_t begin, std::size_t end) { table.measure(view, begin, end, &measures[0].area); };
  if (thread_count(run) > 1) {
    measures = large_vector(t.size(), MeasureSum(), run);
    parallel_for(t.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) { measure(begin, end); });
  } else {
    reserve_large(measures, t.size());
    grow_at_hand(t.size(), [&](std::size_t begin, std::size_t end) {
      check_cancelled(run);
      measures.resize(end);
      measure(begin, end);
    });
  }
  add_what_is_beside(t, measures);
  return measures;
}

std::vector<MeasureSum> measure_triangles(const Triangles& triangles, const Execution& run) {
  return measure_triangles(triangles, kernels::best_table(), run);
}

}  // namespace kappa
