// SPDX-License-Identifier: BSD-3-Clause
// Errors of the ground filter on the ISPRS samples, as docs/ground.md has them.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>

#include "kappa/io/read.hpp"
#include "kappa/scan/ground.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

using Place = std::array<double, 3>;

Place place(const Scan& scan, std::size_t i) {
  const Vec3 p = scan.origin + scan.points[i];
  return {p.x(), p.y(), p.z()};
}

/// Per cent of the points that the filter puts on the wrong side.
double total_error(const Scan& all, const Scan& reference) {
  std::map<Place, int> left;
  for (std::size_t i = 0; i < reference.points.size(); ++i) ++left[place(reference, i)];
  const std::vector<char> found = find_ground(all.points, {});
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto at = left.find(place(all, i));
    const bool is_ground = at != left.end() && at->second-- > 0;
    wrong += is_ground != (found[i] != 0);
  }
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(found.size());
}

TEST(GroundSamples, TotalErrorsAreThoseOfTheTable) {
  const std::string folder = std::string(KAPPA_SHARED_DATA) + "/lidar/airborne-pcd/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const std::map<std::string, double> expected = {{"samp11", 8.65}, {"samp21", 1.48}, {"samp23", 5.87},
                                                  {"samp31", 1.85}, {"samp42", 3.18}, {"samp51", 2.94},
                                                  {"samp53", 8.09}};
  for (const auto& [name, percent] : expected) {
    const double error =
        total_error(read_scan(folder + name + "-utm.pcd"), read_scan(folder + name + "-utm-ground.pcd"));
    EXPECT_NEAR(error, percent, 0.006) << name;
  }
}

}  // namespace
}  // namespace kappa
