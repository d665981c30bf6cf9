// SPDX-License-Identifier: BSD-3-Clause
#include "distinct_points.hpp"

#include "kappa/core/checks.hpp"
#include "kappa/search/fitted_normals.hpp"

namespace kappa {

DistinctPoints distinct_points(const std::vector<Vec3>& points, const Normals& normals) {
  check_one_each(normals.size(), "normal", points.size(), "point");
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

}  // namespace kappa
