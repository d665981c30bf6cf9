// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>

namespace kappa::detail {

/// Where a function changes from one sign at `low` to the other at `high`: Newton's method inside the
/// bracket, halving it where Newton's step leaves it or it shrinks too slowly. `f(t)` returns the value and the
/// derivative. Ends at a step below `tolerance` or at a zero; at a jump across 0, beside it.
template <class Function>
double bracketed_root(const Function& f, double low, double high, double tolerance) {
  const bool rising = f(low).first < 0;
  double t = 0.5 * (low + high);
  double previous_width = 2 * (high - low);
  for (int step = 0; step < 200; ++step) {
    const std::pair<double, double> here = f(t);
    if (here.first == 0) return t;
    ((here.first < 0) == rising ? low : high) = t;
    const double newton = t - here.first / here.second;
    const bool slow = step % 3 == 2 && high - low > 0.5 * previous_width;
    if (step % 3 == 2) previous_width = high - low;
    const double next = newton > low && newton < high && !slow ? newton : 0.5 * (low + high);
    if (std::abs(next - t) <= tolerance) return next;
    t = next;
  }
  return t;
}

}  // namespace kappa::detail
