// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

/// Little-endian numbers of the LAS header and records.
namespace kappa::io {

/// The integer at `at`; the caller has checked that it lies within `bytes`.
template <class T>
T get(std::string_view bytes, std::size_t at) {
  static_assert(std::is_unsigned_v<T>);
  std::uint64_t value = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return static_cast<T>(value);
}

inline std::int32_t get_int32(std::string_view bytes, std::size_t at) {
  return static_cast<std::int32_t>(get<std::uint32_t>(bytes, at));
}

inline double get_double(std::string_view bytes, std::size_t at) {
  const auto bits = get<std::uint64_t>(bytes, at);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  static_assert(std::is_unsigned_v<T>);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
  }
}

inline void put_int32(std::string& bytes, std::size_t at, std::int32_t value) {
  put(bytes, at, static_cast<std::uint32_t>(value));
}

inline void put_double(std::string& bytes, std::size_t at, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  put(bytes, at, bits);
}

}  // namespace kappa::io
