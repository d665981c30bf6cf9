// SPDX-License-Identifier: BSD-3-Clause
#include "positions.hpp"

#include <algorithm>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/gather.hpp"
#include "kappa/core/spatial_order.hpp"

namespace kappa {
namespace {

std::vector<Index> first_at_each(const std::vector<Vec3>& points, const std::vector<Index>& representative,
                                 const Execution& run) {
  std::vector<Index> order = spatial_order(points, stage(run, 0.0, 0.0));
  order.erase(std::remove_if(order.begin(), order.end(), [&](Index i) { return representative[i] != i; }), order.end());
  order.shrink_to_fit();
  return order;
}

template <class T>
std::vector<T> kept(const std::vector<T>& values, const std::vector<char>& keep) {
  std::vector<T> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (keep[i] != 0) result.push_back(values[i]);
  }
  return result;
}

}  // namespace

Positions::Positions(const std::vector<Vec3>& points, const Execution& run)
    : representative(find_duplicates(points)),
      original(first_at_each(points, representative, run)),
      x(gathered(points, original)),
      search(x) {}

Positions::Positions(const Positions& all, const std::vector<char>& keep)
    : representative(all.representative), original(kept(all.original, keep)), x(kept(all.x, keep)), search(x) {}

}  // namespace kappa
