// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// values[from[0]], values[from[1]], ...; nothing if there are no values, as of an attribute that a cloud lacks. Every
/// index must be below their number otherwise.
template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<Index>& from) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(from.size());
  for (const Index i : from) result.push_back(values[i]);
  return result;
}

}  // namespace kappa
