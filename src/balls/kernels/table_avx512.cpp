// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

namespace kappa::kernels {

const Table& avx512_table() {
  static constexpr Table kTable = table_of("AVX-512", measure_avx512);
  return kTable;
}

}  // namespace kappa::kernels
