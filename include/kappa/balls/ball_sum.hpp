// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "kappa/balls/triangles.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"
#include "kappa/core/names.hpp"

namespace kappa {

/// What a face that the sphere cuts adds to its ball.
enum class BallDefinition {
  ExactDensity,  ///< integral of the density over the part inside: subdividing a face changes nothing
  AreaFraction   ///< measures of the face times the share of its area inside (Property 2 of the paper)
};
const std::vector<Named<BallDefinition>>& names_of(BallDefinition);

/// Measures of a ball, with the number of triangles (parts of polygons count singly) it meets.
struct BallMeasures {
  MeasureSum sum;
  Index face_count = 0;
};

/// Measures of triangle `t`'s part in the closed ball; adds nothing and returns false if they do not meet. `whole` are
/// the measures of the whole triangle, times its weight.
bool add_triangle_in_ball(const Triangles& triangles, std::size_t t, const MeasureSum& whole, const Vec3& centre,
                          double radius, BallDefinition ball, BallMeasures& to);

/// The radii of the balls around each centre, equally many for all; length.
class BallRadii {
 public:
  /// The same for every centre.
  BallRadii(std::vector<double> common) : radii_(std::move(common)), count_(radii_.size()) {}
  BallRadii(std::initializer_list<double> common) : BallRadii(std::vector<double>(common)) {}
  /// Of every centre its own: `count` for the first centre, then as many for the second, and so on. A radius of 0
  /// stands for no ball.
  static BallRadii of_each(std::vector<double> radii, std::size_t count);

  std::size_t count() const { return count_; }
  bool are_common() const { return common_; }
  /// The `count()` radii of a centre.
  const double* of(std::size_t centre) const { return radii_.data() + (common_ ? 0 : centre * count_); }

  /// @throws Error InvalidArgument if a radius is not finite and positive (of own radii: negative or not finite), or if
  /// there are own radii of another number of centres.
  void check(std::size_t centres) const;

 private:
  std::vector<double> radii_;
  std::size_t count_ = 0;
  bool common_ = true;
};

/// Sums the measures of triangles in balls. Engines differ in speed alone: their sums agree to
/// 1e-11 of the sum of absolute values.
class BallSum {
 public:
  virtual ~BallSum() = default;

  /// Receives the measures of the balls around centre `query`, one a radius in the order given.
  /// Called from any thread, once a query.
  using Sink = std::function<void(std::size_t query, const BallMeasures* per_radius)>;

  /// Measures of the closed balls of every radius around every centre (in the local coordinates of
  /// the triangles). A centre that is not finite gets empty balls, as does a radius of 0.
  /// @throws Error InvalidArgument as BallRadii::check does; Cancelled.
  void sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
           const Sink& sink) const;

  /// In the order of the engine.
  virtual const Triangles& triangles() const = 0;
  /// Measures of a whole triangle, times its weight.
  virtual MeasureSum measures_of(std::size_t triangle) const = 0;

 private:
  virtual void do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball,
                      const Execution& run, const Sink& sink) const = 0;
};

/// Every triangle for every ball: the slow reference that the tests compare with.
class BruteForceBallSum final : public BallSum {
 public:
  explicit BruteForceBallSum(Triangles triangles, const Execution& run = {});
  const Triangles& triangles() const override { return triangles_; }
  MeasureSum measures_of(std::size_t triangle) const override { return measures_[triangle]; }

 private:
  void do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
              const Sink& sink) const override;
  Triangles triangles_;
  std::vector<MeasureSum> measures_;
};

}  // namespace kappa
