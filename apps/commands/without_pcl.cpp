// SPDX-License-Identifier: BSD-3-Clause
// What the program says in place of the functions that need PCL where it was built without.
#include "kappa/core/error.hpp"
#include "kappa/pcl/greedy.hpp"
#include "kappa/pcl/ground.hpp"

namespace kappa {

std::vector<char> find_ground_progressively(const std::vector<Vec3>&, const ProgressiveGroundOptions&) {
  throw Error(ErrorCode::Unavailable, "this program was built without PCL, so it has no --ground=pmf: give --ground");
}

std::vector<char> progressive_ground(const std::vector<Vec3>& points, const GroundFilter&, double) {
  return find_ground_progressively(points, {});
}

CloudSurface greedy_surface(const Vec3&, const std::vector<Vec3>&, const Normals&, const GreedyOptions&) {
  throw Error(ErrorCode::Unavailable,
              "this program was built without PCL, so it has no --surface greedy: give --surface umbrella");
}

}  // namespace kappa
