// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

namespace kappa::kernels {

const PointTable& best_point_table() {
#if defined(KAPPA_AVX2_KERNELS)
  if (__builtin_cpu_supports("avx2")) return avx2_point_table();
#endif
  return baseline_point_table();
}

}  // namespace kappa::kernels
