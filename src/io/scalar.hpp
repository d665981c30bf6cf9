// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// Numbers that binary files are made of.
enum class Scalar : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

enum class ByteOrder { Little, Big };

std::size_t size_of(Scalar type);
bool is_floating(Scalar type);

/// The number stored at `bytes`; 64-bit integers beyond 2^53 are rounded.
double load(const char* bytes, Scalar type, ByteOrder order);

/// Appends `value`, which must fit, in little-endian order.
void append(std::string& bytes, double value, Scalar type);

/// Stores `count` values, which must fit, in little-endian order, the first at `bytes`, the others `stride` apart.
void store(const double* values, std::size_t count, Scalar type, char* bytes, std::size_t stride);

/// The smallest field type that holds every value of `type` (64-bit integers: Float64).
Field::Type field_type(Scalar type);
Scalar scalar_of(Field::Type type);

/// Whether `value` can be stored in `type`: exactly in an integer, within the range in a float.
bool fits(double value, Field::Type type);

/// "uint8" and so on.
const char* type_name(Field::Type type);

}  // namespace kappa::io
