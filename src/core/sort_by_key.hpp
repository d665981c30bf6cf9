// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// A point with the number by which it is sorted.
struct Keyed {
  std::uint64_t key;
  Index index;
};

/// Sorts by key. Entries of equal keys keep their order.
/// @throws Cancelled. Cost: linear, 16 bytes an entry.
void sort_by_key(std::vector<Keyed>& keyed, const Execution& run);

}  // namespace kappa
