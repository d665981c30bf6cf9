// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.hpp"

// Vectors of what waits on the rim: of 64 bytes where the instruction set has AVX-512, else those of lanes.hpp. Masks
// are then bits in registers of their own. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Four sums of lanes. Floats are added as floats: what they hold is no more precise.
inline VD four_sums(VD lanes) {
  return lanes;
}
inline VD four_sums(VF lanes) {
  return widened_sum(lanes);
}

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)

/// Sixteen floats. Eight doubles gained nothing (docs/benchmarks.md).
struct WideF {
  typedef float Lanes __attribute__((vector_size(64)));
  Lanes of;
  static WideF all(float s) { return {_mm512_set1_ps(s)}; }
};
template <>
struct LaneOf<WideF> {
  using Real = float;
};

/// A bit a lane.
struct WideMF {
  __mmask16 of;
};
inline WideMF operator&(WideMF a, WideMF b) {
  return {_kand_mask16(a.of, b.of)};
}
inline WideMF operator|(WideMF a, WideMF b) {
  return {_kor_mask16(a.of, b.of)};
}
inline WideMF operator^(WideMF a, WideMF b) {
  return {_kxor_mask16(a.of, b.of)};
}
inline WideMF operator~(WideMF a) {
  return {_knot_mask16(a.of)};
}
inline unsigned bits(WideMF mask) {
  return mask.of;
}
inline WideMF first_lanes(WideF, int count) {
  return {static_cast<__mmask16>((1U << (count < 16 ? count : 16)) - 1)};
}

inline WideF operator+(WideF a, WideF b) {
  return {a.of + b.of};
}
inline WideF operator-(WideF a, WideF b) {
  return {a.of - b.of};
}
inline WideF operator-(WideF a) {
  return {-a.of};
}
inline WideF operator*(WideF a, WideF b) {
  return {a.of * b.of};
}
inline WideF operator/(WideF a, WideF b) {
  return {a.of / b.of};
}
inline WideMF operator<(WideF a, WideF b) {
  return {_mm512_cmp_ps_mask(a.of, b.of, _CMP_LT_OQ)};
}
inline WideMF operator<=(WideF a, WideF b) {
  return {_mm512_cmp_ps_mask(a.of, b.of, _CMP_LE_OQ)};
}
inline WideMF operator>(WideF a, WideF b) {
  return b < a;
}
inline WideMF operator>=(WideF a, WideF b) {
  return b <= a;
}

inline WideF select(WideMF mask, WideF a, WideF b) {
  return {_mm512_mask_blend_ps(mask.of, b.of, a.of)};
}
inline WideF sqrt(WideF a) {
  return {_mm512_sqrt_ps(a.of)};
}
inline WideF min(WideF a, WideF b) {
  return {_mm512_min_ps(a.of, b.of)};
}
inline WideF max(WideF a, WideF b) {
  return {_mm512_max_ps(a.of, b.of)};
}
inline WideF absolute(WideF a) {
  return {_mm512_abs_ps(a.of)};
}
inline VD four_sums(WideF a) {
  return widened_sum(_mm256_add_ps(_mm512_castps512_ps256(a.of), _mm512_extractf32x8_ps(a.of, 1)));
}

template <class Real>
using RimVector = std::conditional_t<std::is_same_v<Real, float>, WideF, VD>;

#else

template <class Real>
using RimVector = Vector<Real>;

#endif

}  // namespace
}  // namespace kappa::kernels
