// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kappa/mesh/mesh.hpp"
#include "search/kernels/views.hpp"

namespace kappa {

/// A block that holds no point.
kernels::PointBlock empty_block();

/// Finite points that lie along a space-filling curve, 8 side by side, under a hierarchy of boxes with 8 children each:
/// made in one pass, for searches around many points that lie next to each other. Thread-safe queries. Of equally far
/// points that of the lower index is the nearer one.
///
/// Normals and stars want all points around all points, which neighbours share. Searched one by one in FLANN's tree
/// they took a tenth of the time of the whole program; other searches are FLANN's (kd_tree.hpp).
class PointBlocks {
 public:
  explicit PointBlocks(const std::vector<Vec3>& points);

  std::size_t size() const { return size_; }
  const kernels::PointBlock* blocks() const { return blocks_.data(); }
  Vec3 point(std::size_t i) const {
    const auto& x = blocks_[i / kernels::kBlockPoints].x;
    const std::size_t at = i % kernels::kBlockPoints;
    return {x[0][at], x[1][at], x[2][at]};
  }

  /// The (up to) `k` nearest points, by increasing distance, with the squared distances.
  void nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices, std::vector<double>& distances_sq) const;

  /// What the searches in balls need; one thread's worth.
  struct Work {
    std::vector<std::uint32_t> blocks, opened, of_ball;
    std::vector<kernels::NamedBoxes> boxes;
    std::vector<double> points, distances_sq;
  };

  /// The same, faster where most of the points within `guess` are among them.
  void nearest(const Vec3& query, std::size_t k, double guess, std::vector<Index>& indices,
               std::vector<double>& distances_sq, Work& work) const;

  /// All points within `radius` (closed ball), by increasing index.
  void within(const Vec3& query, double radius, std::vector<Index>& indices, std::vector<double>& distances_sq,
              Work& work) const;

  /// Sets `work.blocks` to all whose boxes come within `distance` of that from `low` to `high`, increasing.
  void near_box(const Vec3& low, const Vec3& high, double distance, Work& work) const;

  /// The same, and sets `work.boxes` to the boxes of those blocks.
  void near_run(const Vec3& low, const Vec3& high, double distance, Work& work) const;

  /// After near_run: those of its blocks whose boxes come within `radius` of a place, increasing; held in
  /// `work.of_ball`.
  kernels::ChosenBlocks near_ball(const Vec3& centre, double radius, Work& work) const;

  /// Sets the first `work.points`, as doubles, and their `work.distances_sq` to those of `work.blocks` in a closed
  /// ball; how many they are.
  std::size_t measure(const Vec3& centre, double radius, Work& work) const;

 private:
  class Nearest;

  std::size_t size_;
  std::vector<kernels::PointBlock> blocks_;
  std::vector<std::vector<kernels::PointBoxes>> levels_;  ///< of the blocks first, the last has one entry
};

/// Finds the k nearest of points that lie next to each other, themselves among them; one thread's worth of memory.
class NearestInRuns {
 public:
  NearestInRuns(const PointBlocks& blocks, std::size_t k) : blocks_(blocks), k_(k) {}

  /// Calls `use(i, indices, distances_sq)` for each point in [begin, end), in order; as PointBlocks::nearest finds
  /// them.
  template <class Use>
  void for_each(std::size_t begin, std::size_t end, const Use& use) {
    reach_ = first_guess(begin, end);
    while (begin < end) {
      const std::size_t run_end = choose_run(begin, end);
      double sum = 0;
      for (std::size_t i = begin; i < run_end; ++i) {
        find(i);
        sum += distances_sq_.back();
        use(i, indices_, distances_sq_);
      }
      reach_ = next_guess(sum / static_cast<double>(run_end - begin));
      begin = run_end;
    }
  }

 private:
  double first_guess(std::size_t begin, std::size_t end) const;
  double next_guess(double distance_sq) const;
  std::size_t choose_run(std::size_t begin, std::size_t end);
  void find(std::size_t i);
  bool find_in_reach(const Vec3& centre, double reach, PointBlocks::Work& work);

  const PointBlocks& blocks_;
  const std::size_t k_;
  double reach_ = 0;  ///< within which the neighbours are looked for first
  PointBlocks::Work of_run_, of_point_;
  std::vector<std::uint32_t> ranks_, order_;  ///< of what lies in reach: places by distance, and what is at each
  std::vector<Index> indices_;
  std::vector<double> distances_sq_;
};

/// Takes points one after the other into a run until their box would be larger than `extent` along an axis or they
/// would be more than `most`; where the run ends, and its box.
struct PointRun {
  std::size_t end;
  Vec3 low, high;
  PointRun(const PointBlocks& blocks, std::size_t begin, std::size_t most, double extent);
};

}  // namespace kappa
