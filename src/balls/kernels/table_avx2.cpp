// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

namespace kappa::kernels {

const Table& avx2_table() {
  static constexpr Table kTable = table_of("AVX2", measure_avx2);
  return kTable;
}

}  // namespace kappa::kernels
