// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace kappa {

/// Asks the system for large pages for memory that is not in use yet. A hint: first touches and reads at random cost a
/// fraction of what they do with small pages, and where it is not followed nothing changes.
inline void advise_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = begin + bytes;
  const std::uintptr_t first = (begin + kPage - 1) / kPage * kPage, last = end / kPage * kPage;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#endif
}

/// Room for `count` elements in an empty vector that will be large.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  advise_large_pages(values.data(), values.capacity() * sizeof(T));
}

/// A large vector of `count` elements.
template <class T>
std::vector<T> large_vector(std::size_t count, const T& value = T()) {
  std::vector<T> values;
  reserve_large(values, count);
  values.resize(count, value);
  return values;
}

}  // namespace kappa
