// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace kappa {

/// Asks the system for large pages for memory that is not in use yet. A hint: first touches and reads at random cost a
/// fraction of what they do with small pages, and where it is not followed nothing changes. The ends, which do not fill
/// a large page, are fetched in one go: faults one by one cost more than the clearing.
inline void advise_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t kLarge = std::uintptr_t{1} << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = begin + bytes;
  const auto up = [](std::uintptr_t at, std::uintptr_t page) { return (at + page - 1) / page * page; };
  const std::uintptr_t first = up(begin, kLarge), last = end / kLarge * kLarge;
  if (first >= last) return;
  madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#if defined(MADV_POPULATE_WRITE)
  const auto small = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t own = up(begin, small), own_end = end / small * small;
  madvise(reinterpret_cast<void*>(own), first - own, MADV_POPULATE_WRITE);
  madvise(reinterpret_cast<void*>(last), own_end - last, MADV_POPULATE_WRITE);
#endif
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
