// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kappa/core/types.hpp"

namespace kappa {

/// A small generator (xoshiro256**, seeded by splitmix64) whose sequence does not depend on the
/// standard library: one seed gives the same integers and uniform numbers on every platform, and the
/// same derived numbers up to the rounding of its log, sin and cos.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// 64 uniform bits.
  std::uint64_t next();
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform();
  /// Uniform in [from, to).
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  /// Uniform in [0, count); count > 0. Unbiased.
  std::uint64_t below(std::uint64_t count);
  /// Normal deviate of mean 0 and variance 1 (Box-Muller).
  double normal();
  /// Uniform on the unit sphere.
  Vec3 direction();
  /// Uniform in the unit ball.
  Vec3 in_ball();

 private:
  std::uint64_t state_[4];
  double spare_ = kNaN;  ///< second deviate of the last pair, NaN if there is none
};

}  // namespace kappa
