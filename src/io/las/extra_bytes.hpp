// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scalar.hpp"
#include "kappa/io/las/file.hpp"

namespace kappa::io {

inline constexpr std::size_t kDescriptorSize = 192;
inline constexpr std::size_t kExtraNameSize = 32;
inline constexpr std::uint16_t kExtraBytesRecord = 4;

/// One descriptor of the record (LASF_Spec, 4): what some bytes behind the standard ones of a point mean.
struct ExtraBytes {
  std::string name;
  std::optional<Scalar> type;  ///< none if the bytes are not described
  std::size_t values = 1;      ///< of that type (up to 3), or undescribed bytes
  /// Of each value: what stands for no value, and how the number follows from what is stored.
  std::array<std::optional<double>, 3> no_data;
  std::array<double, 3> scale = {1, 1, 1}, offset = {0, 0, 0};

  std::size_t bytes() const { return values * (type ? size_of(*type) : 1); }
};

/// The record that describes the extra bytes, or null.
const LasRecord* extra_bytes_record(const LasFile& las);
LasRecord* extra_bytes_record(LasFile& las);

/// What the record says, empty without one.
/// @throws Error FileFormat, naming `path`, if the record is malformed or describes more bytes than a point has.
std::vector<ExtraBytes> parse_extra_bytes(const std::string& path, const LasFile& las);

/// A descriptor of a value called `name` (at most kExtraNameSize bytes).
std::string descriptor(const std::string& name, Scalar type);
/// A descriptor of `bytes` (1 to 255) bytes of unknown meaning.
std::string undescribed(const std::string& name, std::size_t bytes);
/// Takes the least and largest value off the descriptor at `position`.
void forget_range(LasRecord& record, std::size_t position);

}  // namespace kappa::io
