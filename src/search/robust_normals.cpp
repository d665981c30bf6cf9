// SPDX-License-Identifier: BSD-3-Clause
#include "robust_normals.hpp"

#include <algorithm>
#include <cmath>

#include "kappa/core/percentiles.hpp"
#include "plane_fit.hpp"
#include "quadric_fit.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 256;
constexpr double kDeviation = 1.4826;  ///< standard deviation over the median of absolute values, of normal deviates
constexpr double kReach = 4.685;       ///< of Tukey's weights, in standard deviations: 95 % efficient without outliers

/// A plane that most of some points lie on.
struct Sheet {
  Vec3 normal = Vec3::Zero();  ///< zero if there is none
  double height = 0;           ///< of the plane over the point it was fitted around, along the normal
  double deviation = kNaN;     ///< standard deviation of the points on it
};

/// Fits to the neighbours of one point after the other; one thread's worth of memory.
class SheetFits {
 public:
  SheetFits(const std::vector<Vec3>& points, const PointBlocks& search, const NormalFitOptions& options)
      : points_(points), search_(search), options_(options) {}

  /// Finds the neighbours of a point, itself among them.
  const std::vector<Index>& look_around(Index point) {
    const auto least = static_cast<std::size_t>(options_.neighbours);
    centre_ = points_[point];
    found_.clear();
    if (options_.radius > 0) search_.within(centre_, options_.radius, found_, distances_sq_, work_);
    if (found_.size() < least) search_.nearest(centre_, least, found_, distances_sq_);
    radius_ = std::sqrt(*std::max_element(distances_sq_.begin(), distances_sq_.end()));
    weights_.assign(found_.size(), 1.0);
    return found_;
  }

  /// The plane of least squares, bent towards the majority: weights that outliers lose ever faster.
  Sheet majority() {
    Sheet sheet = weighted_plane();
    constexpr int kGentle = 4, kStrict = 4;
    for (int i = 0; i < kGentle && !sheet.normal.isZero(0); ++i) sheet = reweighted(sheet, deviation(sheet), cauchy);
    for (int i = 0; i < kStrict && !sheet.normal.isZero(0); ++i) sheet = reweighted(sheet, deviation(sheet), tukey);
    if (!sheet.normal.isZero(0)) sheet.deviation = deviation(sheet);
    return sheet;
  }

  /// The neighbours that lie on `sheet` or near, which it is fitted to anew with the deviation held.
  Sheet settle(Sheet sheet) {
    constexpr int kPasses = 4;
    for (int i = 0; i < kPasses && !sheet.normal.isZero(0); ++i) {
      const Sheet next = reweighted(sheet, sheet.deviation, tukey);
      if (next.normal.isZero(0)) break;
      sheet = next;
    }
    return sheet;
  }

  /// The normal there: of the quadric of the neighbours on the sheet if these are nearly all, since it alone is right
  /// on a curved surface; of the sheet if they lie to one side of an edge.
  Vec3 normal_on(const Sheet& sheet) {
    constexpr double kNearlyAll = 0.85;
    QuadricFit quadric(frame_around(sheet.normal), radius_);
    std::size_t on = 0;
    for (const Index i : found_) {
      const Vec3 d = points_[i] - centre_;
      if (std::abs(residual(sheet, d)) > kReach * sheet.deviation) continue;
      quadric.add(d);
      ++on;
    }
    const bool whole = static_cast<double>(on) >= kNearlyAll * static_cast<double>(found_.size());
    return whole ? quadric.normal_or(sheet.normal) : sheet.normal;
  }

 private:
  static double residual(const Sheet& sheet, const Vec3& d) { return sheet.normal.dot(d) - sheet.height; }
  static double cauchy(double t) { return 1 / (1 + t * t / 5.688); }  // 2.385^2: as efficient
  static double tukey(double t) {
    const double s = 1 - t * t / (kReach * kReach);
    return s > 0 ? s * s : 0;
  }

  double deviation(const Sheet& sheet) {
    sizes_.clear();
    for (const Index i : found_) sizes_.push_back(std::abs(residual(sheet, points_[i] - centre_)));
    const auto middle = sizes_.begin() + static_cast<std::ptrdiff_t>(sizes_.size() / 2);
    std::nth_element(sizes_.begin(), middle, sizes_.end());
    constexpr double kExact = 1e-9;  // rounding of points that lie on a plane
    return std::max(kDeviation * *middle, kExact * radius_);
  }

  template <class Weight>
  Sheet reweighted(const Sheet& sheet, double deviation, const Weight& weight) {
    for (std::size_t i = 0; i < found_.size(); ++i)
      weights_[i] = weight(residual(sheet, points_[found_[i]] - centre_) / deviation);
    Sheet result = weighted_plane();
    result.deviation = deviation;
    return result;
  }

  Sheet weighted_plane() const {
    double total = 0;
    Vec3 sum = Vec3::Zero();
    Mat3 products = Mat3::Zero();
    std::size_t count = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!(weights_[i] > 0)) continue;
      const Vec3 d = points_[found_[i]] - centre_;
      total += weights_[i];
      sum += weights_[i] * d;
      products += weights_[i] * d * d.transpose();
      ++count;
    }
    Sheet sheet;
    if (count < 3) return sheet;
    const double scale = static_cast<double>(count) / total;  // moments of as many points of weight 1
    sheet.normal = plane_of_moments({count, scale * sum, scale * products}).normal;
    sheet.height = sheet.normal.dot(sum / total);
    return sheet;
  }

  const std::vector<Vec3>& points_;
  const PointBlocks& search_;
  const NormalFitOptions& options_;
  Vec3 centre_ = Vec3::Zero();
  double radius_ = 0;
  std::vector<Index> found_;
  std::vector<double> distances_sq_, weights_, sizes_;
  PointBlocks::Work work_;
};

/// Calls `use(fits, point)` for every position.
template <class Use>
void for_each_point(const Positions& positions, const NormalFitOptions& options, const Execution& run, const Use& use) {
  parallel_for(positions.x.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    SheetFits fits(positions.x, positions.search, options);
    for (auto point = static_cast<Index>(begin); point < end; ++point) use(fits, point);
  });
}

/// Deviation of most sheets: none is trusted to be better by luck.
double usual_deviation(const std::vector<Sheet>& sheets) {
  std::vector<double> deviations;
  for (const Sheet& s : sheets) {
    if (!s.normal.isZero(0)) deviations.push_back(s.deviation);
  }
  return percentile(deviations, 50);
}

/// The sheet of `of` seen from `from`, and how badly it fits there: variance of its points, and of its distance.
std::pair<Sheet, double> seen_from(const Vec3& from, const Vec3& of, Sheet sheet, double least_deviation) {
  sheet.height += sheet.normal.dot(of - from);
  sheet.deviation = std::max(sheet.deviation, least_deviation);
  const double misfit = sheet.deviation * sheet.deviation + sheet.height * sheet.height;
  return {sheet, sheet.normal.isZero(0) ? std::numeric_limits<double>::infinity() : misfit};
}

/// The sheet of the point itself, unless that of a neighbour fits its own points, and the point, more than twice as
/// well: near an edge that of a neighbour farther from the edge.
Sheet best_of(const std::vector<Vec3>& points, const std::vector<Sheet>& sheets, const std::vector<Index>& neighbours,
              Index point, double least_deviation) {
  constexpr double kBetter = 4;
  const auto own = seen_from(points[point], points[point], sheets[point], least_deviation);
  auto best = own;
  for (const Index i : neighbours) {
    const auto other = seen_from(points[point], points[i], sheets[i], least_deviation);
    if (other.second < best.second) best = other;
  }
  return own.second <= kBetter * best.second ? own.first : best.first;
}

}  // namespace

Normals robust_normals(const Positions& positions, const NormalFitOptions& options, const Execution& run) {
  std::vector<Sheet> sheets(positions.x.size());
  for_each_point(positions, options, stage(run, 0.0, 0.5), [&](SheetFits& fits, Index point) {
    fits.look_around(point);
    sheets[point] = fits.majority();
  });
  const double usual = usual_deviation(sheets);
  Normals normals(positions.x.size(), Vec3::Zero());
  for_each_point(positions, options, stage(run, 0.5, 1.0), [&](SheetFits& fits, Index point) {
    const Sheet best = best_of(positions.x, sheets, fits.look_around(point), point, usual);
    if (!best.normal.isZero(0)) normals[point] = fits.normal_on(fits.settle(best));
  });
  return normals;
}

}  // namespace kappa
