// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "extra_bytes.hpp"
#include "io/scalar.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// One attribute of a LAS point: where it stands in the record, and how its value follows from that.
struct LasDimension {
  std::string name;
  Scalar type = Scalar::UInt8;
  std::size_t offset = 0;                 ///< of its bytes in the record
  unsigned first_bit = 0, bits = 0;       ///< part of a byte that it takes, bits = 0 for all
  double scale = 1, shift = 0;            ///< value = stored * scale + shift
  std::optional<double> no_data;          ///< stored for no value, which reads as NaN
  bool common = true;                     ///< a field even if it is 0 at every point
  std::optional<std::size_t> descriptor;  ///< in the record of the extra bytes

  /// How the value is kept in a field.
  Field::Type field_type() const;
};

/// Attributes of points of `format` but the coordinates, in their order.
std::vector<LasDimension> standard_dimensions(int format);

/// All attributes of the points of a file, with names that are unique and not those of coordinates:
/// extra bytes called as a standard attribute take its name if that is 0 at every point, else their
/// name is followed by "_extra".
/// @throws Error FileFormat as parse_extra_bytes.
std::vector<LasDimension> dimensions_of(const std::string& path, const LasFile& las, const Execution& run);

/// Where an attribute called `name` that needs `type` is put behind the others.
LasDimension extra_dimension(const std::string& name, Scalar type, std::size_t offset);

/// Value of an attribute of the record.
double load(const char* record, const LasDimension& dimension);

/// Whether some point has anything but 0 there.
bool is_used(const LasFile& las, const LasDimension& dimension, const Execution& run);

/// Puts the value in the record; false, and nothing done, if the attribute cannot hold it.
bool store(char* record, const LasDimension& dimension, double value);

}  // namespace kappa::io
