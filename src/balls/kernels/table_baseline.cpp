// SPDX-License-Identifier: BSD-3-Clause
#include "faces.hpp"
#include "table.hpp"

namespace kappa::kernels {

const Table& baseline_table() {
  static constexpr Table kTable = table_of("baseline", measure);
  return kTable;
}

}  // namespace kappa::kernels
