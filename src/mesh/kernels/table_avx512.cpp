// SPDX-License-Identifier: BSD-3-Clause
#include "chosen.hpp"
#include "tree_query.hpp"

namespace kappa::kernels {

const Table& avx512_table() {
  static constexpr Table kTable = {"AVX-512",  approach,      run_query<double>, run_query<float>,
                                   add_chosen, finish_chosen, measure_avx512};
  return kTable;
}

}  // namespace kappa::kernels
