// SPDX-License-Identifier: BSD-3-Clause
#include "ball_normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "plane_fit.hpp"
#include "point_blocks.hpp"
#include "quadric_fit.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::size_t kMostInRun = 32;  // points that share their candidates
constexpr double kRunExtent = 0.8;      // of the radius, at most

/// Points in a ball, relative to its centre.
struct Ball {
  std::vector<kernels::FourPoints> points;
  std::size_t fours = 0;
  Moments moments;
};

/// The points that may lie in the balls of a run of points; one thread's worth of memory.
class Candidates {
 public:
  explicit Candidates(const PointBlocks& points) : points_(points) {}

  void gather(const PointRun& run, double radius) {
    points_.near_run(run.low, run.high, radius, near_);
    thinned_.clear();
    if (places() > kMostInBall) thin_out();
  }

  /// Those in the ball, which must lie in one of the balls that they were gathered for.
  void select(const Vec3& centre, double radius, Ball& ball) {
    const kernels::ChosenBlocks from = near(centre, radius);
    ball.points.resize(std::max(ball.points.size(), from.places() / 4));
    PlaneSums sums;
    const kernels::Selected selected =
        kernels::best_point_table().select(from, centre.data(), radius * radius, ball.points.data(), sums.data());
    ball.fours = selected.fours;
    ball.moments = moments_of(selected.count, sums);
  }

 private:
  std::size_t places() const { return near_.blocks.size() * kernels::kBlockPoints; }

  kernels::ChosenBlocks near(const Vec3& centre, double radius) {
    if (!thinned_.empty()) return {thinned_.data(), near_.blocks.data(), near_.blocks.size()};
    return points_.near_ball(centre, radius, near_);
  }

  /// Every m-th point alone.
  void thin_out() {
    const std::size_t step = (places() + kMostInBall - 1) / kMostInBall;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < places(); i += step, ++kept) {
      const std::size_t place = kept % kernels::kBlockPoints, from = i % kernels::kBlockPoints;
      const kernels::PointBlock& block = points_.blocks()[near_.blocks[i / kernels::kBlockPoints]];
      if (place == 0) thinned_.push_back(empty_block());
      for (int axis = 0; axis < 3; ++axis) thinned_.back().x[axis][place] = block.x[axis][from];
    }
    near_.blocks.resize(thinned_.size());
    std::iota(near_.blocks.begin(), near_.blocks.end(), std::uint32_t{0});
  }

  const PointBlocks& points_;
  PointBlocks::Work near_;
  std::vector<kernels::PointBlock> thinned_;
};

QuadricFit quadric_through(const Ball& ball, double radius, const Vec3& plane) {
  QuadricFit quadric(frame_around(plane), radius);
  quadric.take(ball.points.data(), ball.fours, ball.moments);
  return quadric;
}

/// Fits to the balls around the points of one run after the other; one thread's worth of memory.
class RunFits {
 public:
  RunFits(const PointBlocks& points, double radius, std::size_t least, NormalFit fit, double most_variance)
      : points_(points),
        radius_(radius),
        least_(least),
        fit_(fit),
        most_variance_(most_variance),
        candidates_(points) {}

  /// Fits to the points [begin, end).
  void fit(std::size_t begin, std::size_t end, Normals& normals) {
    while (begin < end) {
      const PointRun run(points_, begin, std::min(kMostInRun, end - begin), kRunExtent * radius_);
      lopsided_.clear();
      candidates_.gather(run, radius_);
      for (std::size_t i = begin; i < run.end; ++i) fit_point(i, normals);
      if (!lopsided_.empty()) grow(run, normals);
      begin = run.end;
    }
  }

 private:
  void fit_point(std::size_t point, Normals& normals) {
    candidates_.select(points_.point(point), radius_, ball_);
    if (ball_.moments.count < least_) return;
    const Plane plane = plane_of_moments(ball_.moments);
    normals[point] = plane.normal;
    if (fit_ == NormalFit::Plane || plane.normal.isZero(0)) return;
    const double growth = growth_of_ball(plane.offset / radius_, ball_.moments.count);
    const QuadricFit quadric = quadric_through(ball_, radius_, plane.normal);
    const QuadricFit::Fitted fitted = quadric.fitted();
    if (fitted.variance > most_variance_) {
      normals[point].setZero();
      return;
    }
    normals[point] = fitted.normal.isZero(0) ? plane.normal : fitted.normal;
    if (growth > 1) lopsided_.push_back({point, growth, plane.normal, quadric});
  }

  void grow(const PointRun& run, Normals& normals) {
    candidates_.gather(run, 2 * radius_);
    for (const Lopsided& l : lopsided_) {
      candidates_.select(points_.point(l.point), l.growth * radius_, ball_);
      const QuadricFit grown = quadric_through(ball_, l.growth * radius_, l.plane);
      normals[l.point] = better_fit(l.quadric, grown).normal_or(l.plane);
    }
  }

  const PointBlocks& points_;
  double radius_;
  std::size_t least_;
  NormalFit fit_;
  double most_variance_;
  Candidates candidates_;
  Ball ball_;

  /// A point whose ball is to grow, with what was fitted to it as it was.
  struct Lopsided {
    std::size_t point;
    double growth;
    Vec3 plane;
    QuadricFit quadric;
  };
  std::vector<Lopsided> lopsided_;  ///< of the run
};

}  // namespace

double growth_of_ball(double offset, std::size_t count) {
  constexpr double kHalfDisc = 4 / (3 * kPi);
  const double even = std::max(0.1, 1 / std::sqrt(static_cast<double>(count)));
  if (offset <= even) return 1;
  return offset < kHalfDisc ? 1 + (offset - even) / (kHalfDisc - even) : 2;
}

Normals ball_normals(const PointBlocks& points, double radius, std::size_t least, NormalFit fit, double most_variance,
                     const Execution& run) {
  Normals normals(points.size(), Vec3::Zero());
  parallel_for(points.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    RunFits(points, radius, least, fit, most_variance).fit(begin, end, normals);
  });
  return normals;
}

}  // namespace kappa
