// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/own_scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "curvature_sample.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/orders.hpp"
#include "scale_ladder.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::size_t kMostRungs = 80;
/// First rung in spacings: narrower balls see one star, whose change from rung to rung shows little of the noise.
constexpr double kFinest = 1.4;
/// Rise of the error over the least one so far past which a rung is bias, not chance. On the finest rungs the normals
/// of neighbours vary together, and the change shows less of the noise than it does further up.
constexpr double kRise = 2, kFineRise = 4;
constexpr std::size_t kFineRungs = 3 * kStep;
/// Estimates so many steps apart must differ by no more than their noise, in mean squares by this factor, if the lower
/// one is not on the finest rungs: under heavy noise bias comes in without any rise.
constexpr std::size_t kNearest = 2, kFarthest = 4, kFirstCompared = 4 * kStep;
constexpr double kDisagreement = 3;
/// Mean square error over mean square change of white noise on the rims, and the factor taken: where bias and noise are
/// in balance it is 0.83, 0.27, 0.09, and what is chosen lies between.
constexpr std::array<double, kMaxOrder> kNoiseOfChange = {0.74, 0.60, 0.55};
constexpr std::array<double, kMaxOrder> kErrorOfChange = {0.9, 0.45, 0.35};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> rungs_between(double finest, double most) {
  std::vector<double> radii = {finest};
  while (radii.back() < most && radii.size() < kMostRungs)
    radii.push_back(finest * std::pow(2.0, 0.5 / kStep * static_cast<double>(radii.size())));
  return radii;
}

/// Mean square change between two estimates of one order around each point of a level.
struct Changes {
  std::size_t level = 0;
  std::vector<double> principal, mean;
};

/// Averaged as far as the ball of `radius` reaches.
Changes changes(const Ladder& ladder, int order, std::size_t lower, std::size_t upper, std::size_t level, double radius,
                const Execution& run) {
  const std::size_t n = ladder.level(level).size();
  Changes c{level, std::vector<double>(n), std::vector<double>(n)};
  parallel_for(n, kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ratios a = ladder.estimate(order, lower, level, i), b = ladder.estimate(order, upper, level, i);
      const double d11 = b[0] - a[0], d12 = b[1] - a[1], d22 = b[2] - a[2], mean = b[3] - a[3];
      c.principal[i] = 0.5 * (d11 * d11 + d22 * d22) + d12 * d12;
      c.mean[i] = mean * mean;
    }
  });
  const int passes = ladder.passes(level, radius);
  average(c.principal, ladder.level(level).neighbours, passes, run);
  average(c.mean, ladder.level(level).neighbours, passes, run);
  return c;
}

/// What was chosen for a point; order 0 if no rung has an estimate.
struct Choice {
  double error_sq = kInfinity;
  int order = 0;
  std::size_t finest = 0;  ///< rung of the smallest ball
  int mean_order = 0;      ///< the mean is an estimate of this order
  std::size_t mean_finest = 0;

  /// Rung of the largest ball.
  std::size_t rung() const { return finest + kStep * static_cast<std::size_t>(order - 1); }
};

/// Goes up the rungs with all points for one order.
class Climb {
 public:
  Climb(const Ladder& ladder, int order) : ladder_(ladder), order_(order), points_(ladder.points()) {}

  /// Takes every estimate that can be compared with the next step when `rungs` are measured.
  void go_on(std::size_t rungs, const Execution& run) {
    while (changes_.size() + kStep * static_cast<std::size_t>(order_) < rungs) {
      const std::size_t finest = changes_.size();
      const std::size_t level = ladder_.level_of(finest + kStep * static_cast<std::size_t>(order_));
      changes_.push_back(changes(ladder_, order_, finest, finest + kStep, level, radius(finest), run));
      end_where_rungs_disagree(finest, run);
      take(finest, run);
    }
  }

  bool has_ended() const {
    return std::all_of(points_.begin(), points_.end(), [](const Point& p) { return p.ended; });
  }

  /// Adds the best of this order at point `i` to the choice between orders.
  void offer(std::size_t i, Choice& best) const {
    const Point& p = points_[i];
    if (p.least < best.error_sq) best = {p.least, order_, p.finest, order_, p.finest};
  }

  /// Mean square error of the mean at point `i`; infinite where it is not known or bias has taken over.
  double error_of_mean(std::size_t i, std::size_t finest) const {
    if (finest >= changes_.size() || finest >= points_[i].mean_end) return kInfinity;
    const Changes& c = changes_[finest];
    const double error_sq = error_of_change() * c.mean[ladder_.level(c.level).cluster[i]];
    return std::isnan(error_sq) ? kInfinity : error_sq;
  }

 private:
  struct Point {
    double least = kInfinity, least_of_mean = kInfinity;
    std::uint8_t finest = 0, mean_end = 255;  ///< rungs
    bool ended = false;
  };

  /// Of the largest ball of an estimate.
  double radius(std::size_t finest) const {
    return ladder_.radius(finest + kStep * static_cast<std::size_t>(order_ - 1));
  }

  double error_of_change() const { return kErrorOfChange[static_cast<std::size_t>(order_ - 1)]; }

  void end_where_rungs_disagree(std::size_t finest, const Execution& run) {
    const double factor = kDisagreement * kNoiseOfChange[static_cast<std::size_t>(order_ - 1)];
    const Changes& upper = changes_[finest];
    for (std::size_t steps = kNearest; steps <= kFarthest; ++steps) {
      const std::size_t apart = steps * kStep;
      if (finest < kFirstCompared + apart) return;
      const Changes& lower = changes_[finest - apart];
      const Changes between = changes(ladder_, order_, finest - apart, finest, upper.level, radius(finest), run);
      const std::vector<Index>&at_lower = ladder_.level(lower.level).cluster, &at = ladder_.level(upper.level).cluster;
      for_points(run, [&](Point& p, std::size_t i) {
        const double noise = lower.principal[at_lower[i]] + upper.principal[at[i]];
        if (between.principal[at[i]] > factor * noise) p.ended = true;
      });
    }
  }

  void take(std::size_t finest, const Execution& run) {
    const double rise = finest < kFineRungs ? kFineRise : kRise;
    const Changes& c = changes_[finest];
    const std::vector<Index>& at = ladder_.level(c.level).cluster;
    for_points(run, [&](Point& p, std::size_t i) {
      const double error_sq = error_of_change() * c.principal[at[i]], of_mean = error_of_change() * c.mean[at[i]];
      if (std::isnan(error_sq)) return;
      if (p.mean_end > finest && of_mean > rise * p.least_of_mean) p.mean_end = static_cast<std::uint8_t>(finest);
      p.least_of_mean = std::min(p.least_of_mean, of_mean);
      if (error_sq > rise * p.least) p.ended = true;
      if (p.ended || error_sq >= p.least) return;
      p.least = error_sq;
      p.finest = static_cast<std::uint8_t>(finest);
    });
  }

  template <typename Body>
  void for_points(const Execution& run, const Body& body) {
    parallel_for(points_.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) body(points_[i], i);
    });
  }

  const Ladder& ladder_;
  int order_;
  std::vector<Point> points_;
  std::vector<Changes> changes_;  ///< of each rung so far to the next step
};

/// The mean may be of a lower order, made of some of the balls that are chosen.
void choose_mean(const std::vector<Climb>& climbs, std::size_t i, Choice& choice) {
  double least = kInfinity;
  for (int order = 1; order <= choice.order; ++order) {
    for (int skipped = 0; skipped <= choice.order - order; ++skipped) {
      const std::size_t finest = choice.finest + kStep * static_cast<std::size_t>(skipped);
      const double error_sq = climbs[static_cast<std::size_t>(order - 1)].error_of_mean(i, finest);
      if (error_sq >= least) continue;
      least = error_sq;
      choice.mean_order = order;
      choice.mean_finest = finest;
    }
  }
}

std::vector<Choice> choose(const BallSum& balls, Ladder& ladder, BallDefinition ball, const Execution& run) {
  std::vector<Climb> climbs;
  for (int order = 1; order <= kMaxOrder; ++order) climbs.emplace_back(ladder, order);
  const auto ended = [](const Climb& climb) { return climb.has_ended(); };
  for (std::size_t rungs = 0; rungs < ladder.size() && !std::all_of(climbs.begin(), climbs.end(), ended);) {
    const double done = static_cast<double>(rungs) / static_cast<double>(ladder.size());
    rungs = ladder.measure(balls, ball, rungs, stage(run, done, done));
    for (Climb& climb : climbs) climb.go_on(rungs, stage(run, done, done));
  }
  std::vector<Choice> best(ladder.points());
  for (std::size_t i = 0; i < best.size(); ++i) {
    for (const Climb& climb : climbs) climb.offer(i, best[i]);
    choose_mean(climbs, i, best[i]);
  }
  return best;
}

/// The sample of the balls of a choice, the widest first.
CurvatureSample sample_of(const BallMeasures* balls, const Choice& choice, double radius, const Vec3& u) {
  std::array<const BallMeasures*, kMaxOrder> all{};
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = balls + b;
  CurvatureSample s = make_sample(all.data(), choice.order, radius, u);
  s.std_error = kNaN;
  if (s.k.status != PointStatus::Valid || choice.error_sq == kInfinity) return s;
  s.std_error = std::sqrt(choice.error_sq);
  s.k.gaussian = s.k.k_min * s.k.k_max;
  if (choice.mean_order == choice.order) return s;
  const std::size_t smaller = (choice.mean_finest - choice.finest) / kStep;
  const std::size_t first = static_cast<std::size_t>(choice.order - choice.mean_order) - smaller;
  s.k.mean = make_sample(all.data() + first, choice.mean_order, radius, u).k.mean;
  return s;
}

/// Points that share order and radius.
void measure_group(const BallSum& balls, const Points& points, const std::vector<Index>& group,
                   const std::vector<Choice>& choices, double radius, BallDefinition ball, const Execution& run,
                   std::vector<CurvatureSample>& samples) {
  std::vector<Vec3> x;
  x.reserve(group.size());
  for (const Index i : group) x.push_back(points.x[i]);
  const std::vector<double> radii = order_radii(radius, choices[group.front()].order);
  balls.sum(x, radii, ball, run, [&](std::size_t q, const BallMeasures* measures) {
    const Index i = group[q];
    if (usable(x[q], points.u[i])) samples[i] = sample_of(measures, choices[i], radius, points.u[i]);
  });
}

std::vector<CurvatureSample> measure_choices(const BallSum& balls, const Points& points, std::vector<Choice> choices,
                                             const std::vector<double>& radii, BallDefinition ball,
                                             const Execution& run) {
  std::vector<CurvatureSample> samples(points.size());
  std::vector<std::vector<Index>> groups(kMaxOrder * radii.size());
  for (std::size_t i = 0; i < choices.size(); ++i) {
    Choice& c = choices[i];
    // Where nothing could be chosen the widest ball, if any, still meets a face.
    if (c.order == 0) c = {kInfinity, 1, radii.size() - 1, 1, radii.size() - 1};
    groups[static_cast<std::size_t>(c.order - 1) * radii.size() + c.rung()].push_back(static_cast<Index>(i));
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].empty()) continue;
    const double done = static_cast<double>(g) / static_cast<double>(groups.size());
    measure_group(balls, points, groups[g], choices, radii[g % radii.size()], ball, stage(run, done, done), samples);
  }
  return samples;
}

}  // namespace

CurvatureField estimate_at_own_scale(const BallSum& balls, const Normals& u, BallDefinition ball,
                                     const Execution& run) {
  const Triangles& t = balls.triangles();
  check_one_each(u.size(), "normal", t.vertices, "vertex");
  const Execution first = stage(run, 0, 0);
  Surroundings around = surroundings(balls, first);
  if (!(around.typical_spacing > 0))
    throw Error(ErrorCode::InvalidData, "no face has an area, so no scale can be chosen; give a radius");
  const Points points = points_of(t, u, around);
  const auto levels = thin(
      std::move(around.neighbours), [&](std::size_t i) { return usable(points.x[i], points.u[i]); }, first);
  Ladder ladder(rungs_between(kFinest * points.typical_spacing, bounds(points.x).diagonal() / 2), levels, points);
  const std::vector<Choice> choices = choose(balls, ladder, ball, stage(run, 0, 0.7));
  return {kNaN, measure_choices(balls, points, choices, ladder.radii(), ball, stage(run, 0.7, 1)), 0};
}

}  // namespace kappa
