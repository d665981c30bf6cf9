// SPDX-License-Identifier: BSD-3-Clause
#include "distinct_points.hpp"

#include "kappa/core/error.hpp"
#include "kappa/search/fitted_normals.hpp"

namespace kappa {

DistinctPoints distinct_points(const std::vector<Vec3>& points, const Normals& normals) {
  if (normals.size() != points.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(normals.size()) + " normals for " +
                                                std::to_string(points.size()) + " points: give one a point");
  DistinctPoints distinct;
  distinct.representative = find_duplicates(points);
  for (Index i = 0; i < points.size(); ++i) {
    if (distinct.representative[i] != i || !is_finite(normals[i]) || normals[i].isZero(0)) continue;
    distinct.x.push_back(points[i]);
    distinct.u.push_back(normals[i].stableNormalized());
    distinct.original.push_back(i);
  }
  return distinct;
}

void check_range(const std::string& name, long value, long from, long to, const std::string& what) {
  if (value >= from && value <= to) return;
  throw Error(ErrorCode::InvalidArgument, name + " = " + std::to_string(value) + ": give " + std::to_string(from) +
                                              " to " + std::to_string(to) + " for " + what);
}

}  // namespace kappa
