// SPDX-License-Identifier: BSD-3-Clause
#include "views.hpp"

namespace kappa::kernels {

Tables usable_tables() {
  Tables tables;
  const auto add = [&](const Table& table) { tables.of[tables.count++] = &table; };
  add(baseline_table());
#if defined(KAPPA_X86_KERNELS)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  // Not asked for itself: processors that have AVX-512 without it, up to 2020, run much slower for long vectors.
  const bool recent = __builtin_cpu_supports("avx512vbmi2");
  if (avx2) add(avx2_table());
  if (avx2 && recent && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) add(avx512_table());
#endif
  return tables;
}

const Table& best_table() {
  static const Tables tables = usable_tables();
  return *tables.of[tables.count - 1];
}

}  // namespace kappa::kernels
