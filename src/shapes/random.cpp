// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/random.hpp"

#include <cmath>

namespace kappa {
namespace {

std::uint64_t splitmix64(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::uint64_t rotate_left(std::uint64_t x, int bits) {
  return (x << bits) | (x >> (64 - bits));
}

}  // namespace

Random::Random(std::uint64_t seed) {
  for (auto& word : state_) word = splitmix64(seed);
}

std::uint64_t Random::next() {
  const std::uint64_t result = rotate_left(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = rotate_left(state_[3], 45);
  return result;
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1p-53;
}

std::uint64_t Random::below(std::uint64_t count) {
  // The first 2^64 mod count values would be drawn once too often.
  const std::uint64_t rejected = (0 - count) % count;
  std::uint64_t value = next();
  while (value < rejected) value = next();
  return value % count;
}

double Random::normal() {
  if (!std::isnan(spare_)) {
    const double result = spare_;
    spare_ = kNaN;
    return result;
  }
  const double length = std::sqrt(-2 * std::log(1 - uniform()));
  const double angle = 2 * kPi * uniform();
  spare_ = length * std::sin(angle);
  return length * std::cos(angle);
}

Vec3 Random::direction() {
  Vec3 v = in_ball();
  // Near 0 the direction would be that of few bits.
  while (v.squaredNorm() < 1e-6) v = in_ball();
  return v.normalized();
}

Vec3 Random::in_ball() {
  Vec3 v;
  do {
    for (int axis = 0; axis < 3; ++axis) v[axis] = uniform(-1, 1);
  } while (v.squaredNorm() > 1);
  return v;
}

}  // namespace kappa
