// SPDX-License-Identifier: BSD-3-Clause
#include "border_correction.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "curvature_sample.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/orders.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/core/spatial_order.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;
/// Points that gradients are fitted to lie within so many radii of the smallest ball, or within up to `kWiden` times
/// that where they are fewer than `kWanted`; fewer than `kLeast` give none.
constexpr double kWindow = 1.5, kWiden = 2;
constexpr std::size_t kWanted = 12, kLeast = 6;
/// Estimates around a point are alike: from more than so many points in a window on, every second point would do.
constexpr std::size_t kMany = 64;
/// Square of the error of a fit over what independent residuals would make it: balls that overlap share their noise.
constexpr double kShared = 2;
/// Cosine between the normals of points on one sheet.
constexpr double kSameSheet = 0.5;
/// Least spread of the points across their row, over that along it, squared.
constexpr double kThin = 1e-3;

using Values = Eigen::Matrix<double, 5, 1>;
using Gradient = Eigen::Matrix<double, 2, 5>;

double quadratic(const std::array<double, 3>& form, const Vec2& a, const Vec2& b) {
  return form[0] * a.x() * b.x() + form[1] * (a.x() * b.y() + a.y() * b.x()) + form[2] * a.y() * b.y();
}

/// Of the second form, as `std_error` is measured.
double square(const Values& v) {
  return 0.5 * (v[2] * v[2] + v[4] * v[4]) + v[3] * v[3];
}

/// Inverse; 0 across a thin row of points, where they tell nothing.
Mat2 inverse_along(const Mat2& spread) {
  Eigen::SelfAdjointEigenSolver<Mat2> solver;
  solver.computeDirect(spread);
  const auto& values = solver.eigenvalues();
  Mat2 inverse = Mat2::Zero();
  for (int i = 0; i < 2; ++i) {
    const Vec2 axis = solver.eigenvectors().col(i);
    if (values[i] > kThin * values[1]) inverse += axis * axis.transpose() / values[i];
  }
  return inverse;
}

/// Weighted sums of a linear fit.
struct Sums {
  double weight = 0;
  Vec2 p = Vec2::Zero();
  Mat2 pp = Mat2::Zero();
  Values v = Values::Zero();
  Gradient pv = Gradient::Zero();
  double vv = 0;
  std::size_t count = 0;

  void add(double w, const Vec2& at, const Values& values) {
    weight += w;
    p += w * at;
    pp += w * at * at.transpose();
    v += w * values;
    pv += w * at * values.transpose();
    vv += w * square(values);
    ++count;
  }
};

}  // namespace

struct BorderCorrection::Fit {
  Gradient gradient = Gradient::Zero();
  Mat2 inverse_spread = Mat2::Zero();
  double residual_sq = 0;

  Fit() = default;
  explicit Fit(const Sums& sums) {
    const Vec2 middle = sums.p / sums.weight;
    const Values mean = sums.v / sums.weight;
    inverse_spread = inverse_along(sums.pp / sums.weight - middle * middle.transpose());
    const Gradient common = sums.pv / sums.weight - middle * mean.transpose();
    gradient = inverse_spread * common;
    const Values explained = common.cwiseProduct(gradient).colwise().sum().transpose();
    const double form_explained = 0.5 * (explained[2] + explained[4]) + explained[3];
    residual_sq = std::max(0.0, sums.vv / sums.weight - square(mean) - form_explained);
  }

  Values change(const Vec2& step) const { return gradient.transpose() * step; }
  double error_sq(const Vec2& step) const { return kShared * residual_sq * step.dot(inverse_spread * step); }
};

BorderCorrection::Tangent::Tangent(const Vec3& normal) : u(normal / normal.norm()) {
  tangent_basis(u, t1, t2);
}

BorderCorrection::Values BorderCorrection::values_at(const CurvatureRatios& ratios, const Tangent& there,
                                                     const Tangent& here) {
  const Vec2 a = here.turned(here.t1, there), b = here.turned(here.t2, there);
  Values v;
  v << ratios.mean, ratios.gaussian, quadratic(ratios.form, a, a), quadratic(ratios.form, a, b),
      quadratic(ratios.form, b, b);
  return v;
}

BorderCorrection::BorderCorrection(const Triangles& triangles, const std::vector<Vec3>& centres, const Normals& u,
                                   const std::vector<double>& radii, int order, const Execution& run)
    : centres_(centres), u_(u), order_(order), border_(triangles, stage(run, 0.0, 0.5)) {
  if (!border_.exists()) return;
  for (const double radius : radii) radii_.push_back(order_radii(radius, order));
  const std::vector<double>& largest = *std::max_element(radii_.begin(), radii_.end());
  find_near(largest.front() + kWiden * kWindow * largest.back(), stage(run, 0.5, 1.0));
  estimates_.assign(radii.size(), std::vector<Estimate>(near_.size()));
}

void BorderCorrection::find_near(double reach, const Execution& run) {
  std::vector<char> is_near(centres_.size());
  parallel_for(centres_.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i)
      is_near[i] = usable(centres_[i], u_[i]) && border_.is_near(centres_[i], reach);
  });
  place_.assign(centres_.size(), kNoIndex);
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < centres_.size(); ++i) {
    if (!is_near[i]) continue;
    place_[i] = static_cast<Index>(near_.size());
    near_.push_back(static_cast<Index>(i));
    tangents_.emplace_back(u_[i]);
    boxes.push_back({centres_[i], centres_[i]});
  }
  const BoxTree all(boxes);
  for (const std::vector<double>& balls : radii_) nodes_.push_back(nodes_for(kWindow * balls.back(), all, run));
}

BorderCorrection::Nodes BorderCorrection::nodes_for(double window, const BoxTree& all, const Execution& run) const {
  constexpr std::size_t kProbes = 100;
  std::vector<double> counts;
  for (std::size_t i = 0; i < near_.size(); i += 1 + near_.size() / kProbes) {
    counts.push_back(0);
    all.find(centres_[near_[i]], window, [&](Index) { return ++counts.back() < 0; });
  }
  const std::size_t apart = std::max(std::size_t{1}, static_cast<std::size_t>(percentile(counts, 50)) / kMany);
  std::vector<Vec3> x;
  for (const Index i : near_) x.push_back(centres_[i]);
  const std::vector<Index> order = spatial_order(x, stage(run, 1.0, 1.0));
  Nodes nodes;
  std::vector<Bounds> boxes;
  for (std::size_t i = 0; i < order.size(); i += apart) {
    nodes.places.push_back(order[i]);
    boxes.push_back({x[order[i]], x[order[i]]});
  }
  nodes.tree = BoxTree(boxes);
  return nodes;
}

void BorderCorrection::record(std::size_t r, std::size_t q, const BallMeasures* const* balls) {
  if (place_[q] == kNoIndex) return;
  Estimate& e = estimates_[r][place_[q]];
  std::array<CurvatureRatios, kMaxOrder> ratios;
  Vec3 below = Vec3::Zero();
  for (std::size_t b = 0; b < radii_[r].size(); ++b) {
    ratios[b] = ratios_of(*balls[b], u_[q]);
    const Vec3 centroid = border_.centroid(centres_[q], radii_[r][b], balls[b]->sum.area);
    e.centroid += order_weights(order_)[b] * centroid;
    if (order_ > 1) below += order_weights(order_ - 1)[b] * centroid;
  }
  e.ratios = extrapolate(ratios.data(), order_).ratios;
  if (order_ == 1 || e.ratios.status != PointStatus::Valid) return;
  const CurvatureRatios ratios_below = extrapolate(ratios.data(), order_ - 1).ratios;
  for (std::size_t i = 0; i < 3; ++i) e.difference[i] = e.ratios.form[i] - ratios_below.form[i];
  e.centroid_difference = e.centroid - below;
}

double BorderCorrection::window_around(std::size_t r, std::size_t place) const {
  const double least = kWindow * radii_[r].back();
  std::size_t within = 0, within_next = 0;
  nodes_[r].tree.find(centres_[near_[place]], std::sqrt(kWiden) * least, [&](Index node) {
    const Index other = near_[nodes_[r].places[node]];
    within += (centres_[other] - centres_[near_[place]]).squaredNorm() < least * least;
    return ++within_next >= kWanted && within >= kWanted;
  });
  if (within >= kWanted) return least;
  return (within_next >= kWanted ? std::sqrt(kWiden) : kWiden) * least;
}

BorderCorrection::Fit BorderCorrection::fit(std::size_t r, std::size_t place) const {
  const Vec3& centre = centres_[near_[place]];
  const double window = window_around(r, place);
  const Tangent& here = tangents_[place];
  const Values own = values_at(estimates_[r][place].ratios, here, here);
  Sums sums;
  nodes_[r].tree.find(centre, window, [&](Index node) {
    const Index other = nodes_[r].places[node];
    const Estimate& e = estimates_[r][other];
    const Tangent& there = tangents_[other];
    if (e.ratios.status != PointStatus::Valid || here.u.dot(there.u) < kSameSheet) return false;
    const Vec3 d = centres_[near_[other]] - centre;
    const double weight = 1 - d.squaredNorm() / (window * window);
    if (weight > 0) sums.add(weight, here.of(d + e.centroid), values_at(e.ratios, there, here) - own);
    return false;
  });
  return sums.count < kLeast ? Fit() : Fit(sums);
}

void BorderCorrection::correct(std::size_t r, std::size_t place, CurvatureSample& sample) const {
  const Estimate& e = estimates_[r][place];
  if (e.ratios.status != PointStatus::Valid || e.centroid.isZero(0)) return;
  const Fit f = fit(r, place);
  const Tangent& here = tangents_[place];
  const Values change = f.change(here.of(e.centroid));
  const double change_sq = square(change), error_sq = f.error_sq(here.of(e.centroid));
  if (!(change_sq > 0)) return;
  const double share = change_sq / (change_sq + error_sq);
  CurvatureRatios ratios = e.ratios;
  ratios.mean -= share * change[0];
  ratios.gaussian -= share * change[1];
  Values difference = -share * f.change(here.of(e.centroid_difference));
  for (int i = 0; i < 3; ++i) {
    ratios.form[static_cast<std::size_t>(i)] -= share * change[i + 2];
    difference[i + 2] += e.difference[static_cast<std::size_t>(i)];
  }
  sample.k = curvatures(ratios, here.u);
  if (order_ > 1) sample.std_error = std::sqrt(square(difference) + share * error_sq);
}

void BorderCorrection::apply(std::vector<CurvatureField>& fields, const Execution& run) const {
  parallel_for(near_.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t r = 0; r < fields.size(); ++r) correct(r, i, fields[r].samples[near_[i]]);
    }
  });
}

}  // namespace kappa
