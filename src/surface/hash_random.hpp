// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace kappa {

/// A random sequence of its own for every (seed, item): a counter run through the finaliser of splitmix64. What one
/// item draws does not depend on what others drew, nor on threads.
class HashRandom {
 public:
  HashRandom(std::uint64_t seed, std::uint64_t item) : state_(mix(mix(seed + kStep) ^ (item + 1) * kStep)) {}

  std::uint64_t next() { return mix(state_ += kStep); }

  /// Uniform in [0, count) up to count / 2^32; 0 < count < 2^32.
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((next() >> 32) * count >> 32); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15ULL;

  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
    return z ^ z >> 31;
  }

  std::uint64_t state_;
};

}  // namespace kappa
