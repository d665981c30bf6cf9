// SPDX-License-Identifier: BSD-3-Clause
#include "points.hpp"

namespace kappa::kernels {

const PointTable& avx2_point_table() {
  return kPointTable;
}

}  // namespace kappa::kernels
