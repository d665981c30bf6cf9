// SPDX-License-Identifier: BSD-3-Clause
#include "faces.hpp"

namespace kappa::kernels {

void measure_avx512(const TriangleView& triangles, std::size_t begin, std::size_t end, double* out) {
  measure(triangles, begin, end, out);
}

}  // namespace kappa::kernels
