// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

namespace kappa::kernels {

const Table& best_table() {
#if defined(KAPPA_AVX2_KERNELS)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2_table();
#endif
  return baseline_table();
}

}  // namespace kappa::kernels
