// SPDX-License-Identifier: BSD-3-Clause
#include "points.hpp"

namespace kappa::kernels {

const PointTable& baseline_point_table() {
  return kPointTable;
}

}  // namespace kappa::kernels
