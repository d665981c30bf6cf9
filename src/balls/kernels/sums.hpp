// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "views.hpp"
#include "wide.hpp"

// Adding whole measures and parts of them to what a ball has got. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Adds the sums that wait, in their order, in registers.
template <class Real>
inline void add_waiting(Gathering<Real>& ball, const double* sums) {
  VD a = load<VD>(ball.sum), b = load<VD>(ball.sum + 4);
  double c = ball.sum[8];
  for (int i = 0; i < ball.whole_count; ++i) {
    const double* const s = sums + std::size_t{kSums} * ball.whole[i];
    a += load<VD>(s);
    b += load<VD>(s + 4);
    c += s[8];
  }
  store(ball.sum, a);
  store(ball.sum + 4, b);
  ball.sum[8] = c;
  ball.whole_count = 0;
}

/// Lets one wait whose sum is in `sums`, as those of all that wait are.
template <class Real>
inline void add_whole(Gathering<Real>& ball, const double* sums, std::uint32_t which, std::uint64_t faces) {
  ball.whole[ball.whole_count++] = which;
  ball.faces += faces;
  if (ball.whole_count >= kWaiting) add_waiting(ball, sums);
}

/// Lets those in the lanes of `mask` wait, as add_whole() does.
template <class Real>
inline unsigned let_whole_wait(Gathering<Real>& ball, const double* sums, VF which, unsigned mask) {
  store(ball.whole + ball.whole_count, Compression<VF>(mask)(which));
  const auto count = static_cast<unsigned>(__builtin_popcount(mask));
  ball.whole_count += static_cast<int>(count);
  if (ball.whole_count >= kWaiting) add_waiting(ball, sums);
  return count;
}

}  // namespace
}  // namespace kappa::kernels
