// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <numeric>

#include "balls/kernels/views.hpp"
#include "kappa/balls/ball_sum.hpp"

namespace kappa {

/// Radii in increasing order, and where each stood.
struct SortedRadii {
  std::vector<std::size_t> given;
  std::vector<double> radii, radii_sq;

  explicit SortedRadii(const std::vector<double>& unsorted) : SortedRadii(unsorted.data(), unsorted.size()) {}
  SortedRadii(const double* unsorted, std::size_t count) : given(count) {
    std::iota(given.begin(), given.end(), std::size_t{0});
    std::stable_sort(given.begin(), given.end(),
                     [&](std::size_t a, std::size_t b) { return unsorted[a] < unsorted[b]; });
    for (const std::size_t i : given) {
      radii.push_back(unsorted[i]);
      radii_sq.push_back(unsorted[i] * unsorted[i]);
    }
  }
};

/// What one thread gathers the balls around one centre after the other in, with kernels of one precision.
template <class Real>
class BallWorkspace {
 public:
  /// `measures` are those of the triangles, or empty if they are not kept; both are kept by reference.
  BallWorkspace(const Triangles& triangles, const std::vector<MeasureSum>& measures, BallDefinition ball)
      : triangles_(triangles), measures_(measures), ball_(ball) {}

  /// The radii of the balls from now on, kept by reference.
  void use(const SortedRadii& radii) {
    radii_ = &radii;
    balls_.resize(radii.radii.size());
    direct_.resize(radii.radii.size());
    sums_.resize(radii.radii.size());
  }

  /// The measures of the balls in the order in which the radii were given; `gather(query)` sees to all triangles.
  template <class Gather>
  const BallMeasures* measure(const Vec3& centre, const Gather& gather) {
    start(centre, false);
    if (is_finite(centre)) gather(query_);
    if (uncertain()) {
      start(centre, true);
      gather(query_);
    }
    for (std::size_t r = 0; r < balls_.size(); ++r) sums_[radii_->given[r]] = total(r);
    return sums_.data();
  }

  /// Adds triangles inside of the ball number `radius` by size, with their sum.
  void add_whole(std::size_t radius, const MeasureSum& sum, Index faces) {
    direct_[radius].sum += sum;
    direct_[radius].face_count += faces;
  }

 private:
  void start(const Vec3& centre, bool all_careful) {
    centre_ = centre;
    for (std::size_t r = 0; r < balls_.size(); ++r) {
      kernels::Gathering<Real>& b = balls_[r];
      std::fill(std::begin(b.sum), std::end(b.sum), 0.0);
      std::fill_n(&b.lanes[0][0], sizeof(b.lanes) / sizeof(double), 0.0);
      std::fill(std::begin(b.longest_sq), std::end(b.longest_sq), 0.0);
      b.faces = b.measured = 0;
      b.unit = 1;
      b.radius = radii_->radii[r];
      b.radius_sq = radii_->radii_sq[r];
      b.whole_count = b.waiting.count = b.irregular.count = 0;
    }
    std::fill(direct_.begin(), direct_.end(), BallMeasures{});
    query_ = {{centre[0], centre[1], centre[2]},
              radii_->radii.data(),
              radii_->radii_sq.data(),
              static_cast<int>(radii_->radii.size()),
              ball_ == BallDefinition::ExactDensity,
              all_careful,
              balls_.data(),
              add_careful,
              this};
  }

  /// Whether a ball holds so little that rounding may show: the area of a part is off by a few roundings of radius *
  /// longest edge, and the sum of n edges is at most sqrt(n * sum of squares).
  bool uncertain() const {
    constexpr double kLittle = 4e-3;
    for (std::size_t r = 0; r < balls_.size(); ++r) {
      const kernels::Gathering<Real>& b = balls_[r];
      if (b.measured == 0) continue;
      const double edges_sq = std::accumulate(std::begin(b.longest_sq), std::end(b.longest_sq), 0.0);
      const double of_lanes = std::accumulate(std::begin(b.lanes[0]), std::end(b.lanes[0]), 0.0);
      const double little = kLittle * radii_->radii[r] * b.unit;
      const double area = (b.sum[0] + direct_[r].sum.area) * b.unit * b.unit + of_lanes;
      if (area * area < little * little * edges_sq * static_cast<double>(b.measured)) return true;
    }
    return false;
  }

  static void add_careful(void* workspace, std::uint32_t triangle, int radius) {
    auto& w = *static_cast<BallWorkspace*>(workspace);
    const auto r = static_cast<std::size_t>(radius);
    const MeasureSum whole = w.measures_.empty() ? measures_of(w.triangles_, triangle) : w.measures_[triangle];
    add_triangle_in_ball(w.triangles_, triangle, whole, w.centre_, w.radii_->radii[r], w.ball_, w.direct_[r]);
  }

  BallMeasures total(std::size_t r) const {
    const kernels::Gathering<Real>& b = balls_[r];
    const double length = 1 / b.unit, area = length * length;
    const double scale[kernels::kSums] = {area, area, 1, length, length, length, length, length, length};
    double sum[kernels::kSums];
    for (int i = 0; i < kernels::kSums; ++i)
      sum[i] = b.sum[i] + scale[i] * ((b.lanes[i][0] + b.lanes[i][1]) + (b.lanes[i][2] + b.lanes[i][3]));
    BallMeasures m = direct_[r];
    m.sum += {sum[0], sum[1], sum[2], {sum[3], sum[4], sum[5], sum[6], sum[7], sum[8]}};
    m.face_count += static_cast<Index>(b.faces);
    return m;
  }

  const Triangles& triangles_;
  const std::vector<MeasureSum>& measures_;
  const SortedRadii* radii_ = nullptr;
  BallDefinition ball_;
  Vec3 centre_ = Vec3::Zero();
  kernels::BallQuery<Real> query_{};
  std::vector<kernels::Gathering<Real>> balls_;  ///< by increasing radius
  std::vector<BallMeasures> direct_;             ///< likewise: what comes from no kernel
  std::vector<BallMeasures> sums_;               ///< in the order given
};

}  // namespace kappa
