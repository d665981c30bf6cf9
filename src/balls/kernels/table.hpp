// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "chosen.hpp"
#include "tree_query.hpp"

// The kernels of the instruction set that a file is compiled for. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// `measure` is of another file where sums are fused here.
constexpr Table table_of(const char* name, decltype(Table::measure) measure) {
  return {name, approach, run_query<double>, run_query<float>, add_chosen, finish_chosen, measure};
}

}  // namespace
}  // namespace kappa::kernels
