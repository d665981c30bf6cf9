// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// Vectors of 32 bytes that compile for any instruction set. Every operation is rounded as IEEE 754 says and none is
// contracted, so that results do not depend on the instruction set. Included by kernel files alone.

namespace kappa::kernels {
namespace {

template <class Real>
struct Lanes;

template <>
struct Lanes<double> {
  typedef double V __attribute__((vector_size(32)));
  using M = decltype(V{} < V{});  ///< what a comparison gives
  static constexpr int kCount = 4;
};

template <>
struct Lanes<float> {
  typedef float V __attribute__((vector_size(32)));
  using M = decltype(V{} < V{});
  static constexpr int kCount = 8;
};

template <class Real>
using Vector = typename Lanes<Real>::V;
template <class Real>
using Mask = typename Lanes<Real>::M;
using VD = Lanes<double>::V;
using MD = Lanes<double>::M;
using VF = Lanes<float>::V;
using MF = Lanes<float>::M;

template <class V, class Real>
inline V load(const Real* from) {
  V v;
  __builtin_memcpy(&v, from, sizeof(V));
  return v;
}

template <class V, class Real>
inline void store(Real* to, const V& v) {
  __builtin_memcpy(to, &v, sizeof(V));
}

inline VD spread(double s) {
  return VD{s, s, s, s};
}
inline VF spread(float s) {
  return VF{s, s, s, s, s, s, s, s};
}

inline VD select(MD mask, VD a, VD b) {
  return mask ? a : b;
}
inline VF select(MF mask, VF a, VF b) {
  return mask ? a : b;
}

#if defined(__AVX__)
inline VD sqrt(VD a) {
  return _mm256_sqrt_pd(a);
}
inline VF sqrt(VF a) {
  return _mm256_sqrt_ps(a);
}
inline VD min(VD a, VD b) {
  return _mm256_min_pd(a, b);
}
inline VF min(VF a, VF b) {
  return _mm256_min_ps(a, b);
}
inline VD max(VD a, VD b) {
  return _mm256_max_pd(a, b);
}
inline VF max(VF a, VF b) {
  return _mm256_max_ps(a, b);
}
inline unsigned bits(MD mask) {
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
}
inline unsigned bits(MF mask) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}
#else
template <class V>
inline V min(V a, V b) {
  return a < b ? a : b;
}
template <class V>
inline V max(V a, V b) {
  return a > b ? a : b;
}
inline VD sqrt(VD a) {
  for (int i = 0; i < 4; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}
inline VF sqrt(VF a) {
  for (int i = 0; i < 8; ++i) a[i] = __builtin_sqrtf(a[i]);
  return a;
}
inline unsigned bits(MD mask) {
  unsigned b = 0;
  for (int i = 0; i < 4; ++i) b |= static_cast<unsigned>(mask[i] & 1) << i;
  return b;
}
inline unsigned bits(MF mask) {
  unsigned b = 0;
  for (int i = 0; i < 8; ++i) b |= static_cast<unsigned>(mask[i] & 1) << i;
  return b;
}
#endif

inline VD absolute(VD a) {
  constexpr long long kAll = 0x7fffffffffffffff;
  return reinterpret_cast<VD>(reinterpret_cast<MD>(a) & MD{kAll, kAll, kAll, kAll});
}
inline VF absolute(VF a) {
  constexpr int kAll = 0x7fffffff;
  return reinterpret_cast<VF>(reinterpret_cast<MF>(a) & MF{kAll, kAll, kAll, kAll, kAll, kAll, kAll, kAll});
}

template <class V>
struct LaneOf {
  using Real = std::decay_t<decltype(V{}[0])>;
};
template <class V>
using RealOf = typename LaneOf<V>::Real;

template <class V>
constexpr int kLanes = sizeof(V) / sizeof(RealOf<V>);

/// The same in all lanes.
template <class V, class Real>
inline V splat(Real s) {
  if constexpr (std::is_class_v<V>) {
    return V::all(static_cast<RealOf<V>>(s));
  } else {
    return spread(static_cast<RealOf<V>>(s));
  }
}

/// Lanes [0, count) of a vector.
inline MD first_lanes(VD, int count) {
  return VD{0, 1, 2, 3} < spread(static_cast<double>(count));
}
inline MF first_lanes(VF, int count) {
  return VF{0, 1, 2, 3, 4, 5, 6, 7} < spread(static_cast<float>(count));
}

typedef float HalfVF __attribute__((vector_size(16)));

/// The sums of lanes i and i + 4.
inline VD widened_sum(VF a) {
#if defined(__AVX__)
  return _mm256_cvtps_pd(_mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1)));
#else
  return __builtin_convertvector(HalfVF{a[0], a[1], a[2], a[3]} + HalfVF{a[4], a[5], a[6], a[7]}, VD);
#endif
}

inline VF widened(const std::int16_t* from) {
#if defined(__AVX2__)
  return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from))));
#else
  VF v;
  for (int i = 0; i < 8; ++i) v[i] = static_cast<float>(from[i]);
  return v;
#endif
}

/// Moves the lanes of a mask to the front. The other lanes then hold what the first one held.
template <class V>
struct Compression;

#if defined(__AVX2__)
/// For every mask of lanes of so many times 32 bits, the 8 lanes of 32 bits that it has, a byte each; where it has
/// none, those of the first one.
template <unsigned kWords>
struct LaneLists {
  static constexpr unsigned kLanes = 8 / kWords;
  std::uint64_t of[1U << kLanes];
  constexpr LaneLists() : of() {
    for (unsigned mask = 0; mask < 1U << kLanes; ++mask) {
      unsigned place = 0;
      for (unsigned lane = 0; lane < kLanes; ++lane) {
        if (mask >> lane & 1) add(of[mask], place++, lane);
      }
      while (place < kLanes) add(of[mask], place++, 0);
    }
  }
  static constexpr void add(std::uint64_t& list, unsigned place, unsigned lane) {
    for (unsigned word = 0; word < kWords; ++word)
      list |= std::uint64_t{kWords * lane + word} << 8 * (kWords * place + word);
  }
  __m256i order(unsigned mask) const {
    return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(of[mask])));
  }
};
constexpr LaneLists<1> kLists;
constexpr LaneLists<2> kWideLists;

template <>
struct Compression<VF> {
  __m256i order;
  explicit Compression(unsigned mask) : order(kLists.order(mask)) {}
  VF operator()(VF v) const { return _mm256_permutevar8x32_ps(v, order); }
};
template <>
struct Compression<VD> {
  __m256i order;
  explicit Compression(unsigned mask) : order(kWideLists.order(mask)) {}
  VD operator()(VD v) const {
    return reinterpret_cast<VD>(_mm256_permutevar8x32_ps(reinterpret_cast<__m256>(v), order));
  }
};
#else
template <class V>
struct Compression {
  unsigned mask;
  explicit Compression(unsigned of) : mask(of) {}
  V operator()(V v) const {
    V packed = v;
    for (int i = 0; i < static_cast<int>(sizeof(V) / sizeof(v[0])); ++i) packed[i] = v[0];
    int place = 0;
    for (unsigned rest = mask; rest != 0; rest &= rest - 1) packed[place++] = v[__builtin_ctz(rest)];
    return packed;
  }
};
#endif

template <class V>
struct Vector2 {
  V x, y;
};

template <class V>
struct Vector3 {
  V x, y, z;
};

template <class V>
inline Vector2<V> operator+(const Vector2<V>& a, const Vector2<V>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class V>
inline Vector2<V> operator-(const Vector2<V>& a, const Vector2<V>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class V>
inline Vector2<V> operator*(V s, const Vector2<V>& a) {
  return {s * a.x, s * a.y};
}
template <class V>
inline V dot(const Vector2<V>& a, const Vector2<V>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class V>
inline V cross(const Vector2<V>& a, const Vector2<V>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class V>
inline Vector3<V> operator+(const Vector3<V>& a, const Vector3<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
inline Vector3<V> operator-(const Vector3<V>& a, const Vector3<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
inline Vector3<V> operator*(V s, const Vector3<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
inline V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
inline Vector3<V> cross(const Vector3<V>& a, const Vector3<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Triangles, a corner a row.
template <class V>
struct Corners {
  Vector3<V> x0, x1, x2;
};

/// Four vectors of three doubles, wherever they are.
[[gnu::always_inline]] inline Vector3<VD> gathered_vectors(const double* const (&from)[4]) {
#if defined(__AVX__)
  const auto pair = [](const double* low, const double* high) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
  };
  const __m256d xy_ac = pair(from[0], from[2]), xy_bd = pair(from[1], from[3]);
  const __m256d yz_ac = pair(from[0] + 1, from[2] + 1), yz_bd = pair(from[1] + 1, from[3] + 1);
  return {_mm256_unpacklo_pd(xy_ac, xy_bd), _mm256_unpackhi_pd(xy_ac, xy_bd), _mm256_unpackhi_pd(yz_ac, yz_bd)};
#else
  const auto row = [&](int axis) { return VD{from[0][axis], from[1][axis], from[2][axis], from[3][axis]}; };
  return {row(0), row(1), row(2)};
#endif
}

inline void transpose(const VD (&rows)[4], VD (&columns)[4]) {
#if defined(__AVX__)
  const __m256d ab_low = _mm256_unpacklo_pd(rows[0], rows[1]), ab_high = _mm256_unpackhi_pd(rows[0], rows[1]);
  const __m256d cd_low = _mm256_unpacklo_pd(rows[2], rows[3]), cd_high = _mm256_unpackhi_pd(rows[2], rows[3]);
  columns[0] = _mm256_permute2f128_pd(ab_low, cd_low, 0x20);
  columns[1] = _mm256_permute2f128_pd(ab_high, cd_high, 0x20);
  columns[2] = _mm256_permute2f128_pd(ab_low, cd_low, 0x31);
  columns[3] = _mm256_permute2f128_pd(ab_high, cd_high, 0x31);
#else
  for (int i = 0; i < 4; ++i) columns[i] = VD{rows[0][i], rows[1][i], rows[2][i], rows[3][i]};
#endif
}

/// Whole numbers one after the other, as they lie in memory: names of what is side by side.
inline VF numbers_from(std::uint32_t first) {
  typedef std::uint32_t Numbers __attribute__((vector_size(32)));
  return reinterpret_cast<VF>(first + Numbers{0, 1, 2, 3, 4, 5, 6, 7});
}

}  // namespace
}  // namespace kappa::kernels
