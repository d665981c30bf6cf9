// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kappa/core/execution.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace kappa {

/// Asks the system to use large pages for memory that is not in use yet. With large pages, first touches and reads at
/// random cost a fraction of the time. This is a hint: a system that does not follow it changes nothing. The ends of
/// the memory, which do not fill a large page, are fetched in one go, because faults one by one cost more than the
/// clearing.
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

/// Fetches memory that is not in use yet, on all threads. The system clears the pages, which takes one thread longer
/// than to fill them, and even longer page by page. This is a hint as well.
/// @throws Cancelled as `parallel_for` does.
inline void fetch_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
                        [[maybe_unused]] const Execution& run) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kPart = std::size_t{1} << 21;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  if (begin >= end) return;
  const std::uintptr_t first = begin / kPart, parts = (end - 1) / kPart + 1 - first;
  parallel_for(parts, 1, stage(run, 0.0, 0.0), [&](std::size_t part, std::size_t, int) {
    const std::uintptr_t from = std::max(begin, (first + part) * kPart), to = std::min(end, (first + part + 1) * kPart);
    madvise(reinterpret_cast<void*>(from), to - from, MADV_POPULATE_WRITE);
  });
#endif
}

/// Makes room for `count` elements in an empty vector that will be large.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t count) {
  values.reserve(count);
  advise_large_pages(values.data(), values.capacity() * sizeof(T));
}

/// A vector of `count` copies of `value` in small pages, for results that are filled once and read once in order. Large
/// pages are no faster there, and where the system has none at hand it takes longer to make them.
template <class T>
std::vector<T> fetched_vector(std::size_t count, const T& value, const Execution& run) {
  std::vector<T> values;
  values.reserve(count);
  fetch_pages(values.data(), values.capacity() * sizeof(T), run);
  values.resize(count, value);
  return values;
}

/// A vector of `count` copies of `value` in large pages.
template <class T>
std::vector<T> large_vector(std::size_t count, const T& value, const Execution& run) {
  std::vector<T> values;
  reserve_large(values, count);
  fetch_pages(values.data(), values.capacity() * sizeof(T), run);
  values.resize(count, value);
  return values;
}

}  // namespace kappa
