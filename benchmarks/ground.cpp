// SPDX-License-Identifier: BSD-3-Clause
// Errors of the ground filters on the ISPRS filter-test samples: ground_table FOLDER [cell slope window threshold
// scaling]
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "kappa/io/read.hpp"
#include "kappa/pcl/ground.hpp"
#include "kappa/scan/ground.hpp"
#include "kappa/scan/scan.hpp"

namespace {

using kappa::Scan;
using kappa::Vec3;

using Place = std::array<double, 3>;

struct Sample {
  std::string name;
  std::vector<Vec3> points;
  std::vector<char> ground;  ///< of the reference
};

Place place(const Scan& scan, std::size_t i) {
  const Vec3 p = scan.origin + scan.points[i];
  return {p.x(), p.y(), p.z()};
}

/// The reference has the ground points alone; those at one place may be some ground and some not, of which the first
/// count as ground.
Sample read_sample(const std::string& folder, const std::string& name) {
  const Scan all = kappa::read_scan(folder + "/" + name + "-utm.pcd");
  const Scan ground = kappa::read_scan(folder + "/" + name + "-utm-ground.pcd");
  std::map<Place, int> left;
  for (std::size_t i = 0; i < ground.points.size(); ++i) ++left[place(ground, i)];
  Sample sample{name, all.points, std::vector<char>(all.points.size(), 0)};
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const auto found = left.find(place(all, i));
    if (found != left.end() && found->second-- > 0) sample.ground[i] = 1;
  }
  return sample;
}

struct Errors {
  double ground = 0, objects = 0, lost = 0, taken = 0;  ///< points
  double seconds = 0;

  double type1() const { return 100 * lost / ground; }
  double type2() const { return 100 * taken / objects; }
  double total() const { return 100 * (lost + taken) / (ground + objects); }
};

using Filter = std::function<std::vector<char>(const std::vector<Vec3>&)>;

Errors errors_of(const Sample& sample, const Filter& filter) {
  const std::clock_t start = std::clock();
  const std::vector<char> found = filter(sample.points);
  Errors e;
  e.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  for (std::size_t i = 0; i < found.size(); ++i) {
    ++(sample.ground[i] ? e.ground : e.objects);
    e.lost += sample.ground[i] && !found[i];
    e.taken += !sample.ground[i] && found[i];
  }
  return e;
}

void print(const std::string& name, const char* filter, std::size_t points, const Errors& e) {
  std::printf("| %s | %zu | %s | %.2f | %.2f | %.2f | %.2f |\n", name.c_str(), points, filter, e.type1(), e.type2(),
              e.total(), e.seconds);
}

std::vector<std::string> samples_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const std::size_t end = file.find("-utm-ground.pcd");
    if (end != std::string::npos) names.push_back(file.substr(0, end));
  }
  std::sort(names.begin(), names.end());
  return names;
}

kappa::GroundOptions options_of(int argc, char** argv) {
  kappa::GroundOptions options;
  double* const values[] = {&options.cell, &options.slope, &options.window, &options.threshold, &options.scaling};
  for (int i = 2; i < std::min(argc, 7); ++i) *values[i - 2] = std::atof(argv[i]);
  return options;
}

void run(int argc, char** argv) {
  const kappa::GroundOptions options = options_of(argc, argv);
  const std::vector<std::pair<const char*, Filter>> filters = {
      {"smrf", [&](const std::vector<Vec3>& points) { return kappa::find_ground(points, options); }},
      {"pmf", [](const std::vector<Vec3>& points) { return kappa::find_ground_progressively(points, {}); }}};
  std::printf(
      "| sample | points | filter | type I %% | type II %% | total %% | CPU s |\n|---|---|---|---|---|---|---|\n");
  std::vector<double> sums(filters.size(), 0), seconds(filters.size(), 0);
  const std::vector<std::string> names = samples_in(argv[1]);
  for (const std::string& name : names) {
    const Sample sample = read_sample(argv[1], name);
    for (std::size_t f = 0; f < filters.size(); ++f) {
      if (argc > 2 && f > 0) continue;  // the parameters are those of the first
      const Errors e = errors_of(sample, filters[f].second);
      print(name, filters[f].first, sample.points.size(), e);
      sums[f] += e.total();
      seconds[f] += e.seconds;
    }
  }
  for (std::size_t f = 0; f < filters.size(); ++f)
    std::printf("| mean | | %s | | | %.2f | %.2f |\n", filters[f].first, sums[f] / static_cast<double>(names.size()),
                seconds[f] / static_cast<double>(names.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "ground_table FOLDER [cell slope window threshold scaling]\n");
    return 2;
  }
  try {
    run(argc, argv);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
