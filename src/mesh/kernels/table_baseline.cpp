// SPDX-License-Identifier: BSD-3-Clause
#include "chosen.hpp"
#include "faces.hpp"
#include "tree_query.hpp"

namespace kappa::kernels {

const Table& baseline_table() {
  static constexpr Table kTable = {"baseline",    approach, run_query<double>, run_query<float>, add_chosen,
                                   finish_chosen, measure};
  return kTable;
}

}  // namespace kappa::kernels
