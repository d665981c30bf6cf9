// SPDX-License-Identifier: BSD-3-Clause
#include "scalar.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include "kappa/scan/scan.hpp"

namespace kappa::io {

namespace {

constexpr ByteOrder kHost = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ByteOrder::Little : ByteOrder::Big;

template <class T>
double load_as(const char* bytes, ByteOrder order) {
  char buffer[sizeof(T)];
  std::memcpy(buffer, bytes, sizeof(T));
  if (order != kHost) std::reverse(buffer, buffer + sizeof(T));
  T value;
  std::memcpy(&value, buffer, sizeof(T));
  return static_cast<double>(value);
}

template <class T>
void store_as(const double* values, std::size_t count, char* bytes, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i, bytes += stride) {
    const T stored = static_cast<T>(values[i]);
    std::memcpy(bytes, &stored, sizeof(T));
    if (kHost != ByteOrder::Little) std::reverse(bytes, bytes + sizeof(T));
  }
}

template <class T>
bool fits_in(double value) {
  return value >= static_cast<double>(std::numeric_limits<T>::min()) &&
         value <= static_cast<double>(std::numeric_limits<T>::max()) && value == std::floor(value);
}

}  // namespace

std::size_t size_of(Scalar type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_floating(Scalar type) {
  return type == Scalar::Float32 || type == Scalar::Float64;
}

double load(const char* bytes, Scalar type, ByteOrder order) {
  switch (type) {
    case Scalar::Int8:
      return load_as<std::int8_t>(bytes, order);
    case Scalar::UInt8:
      return load_as<std::uint8_t>(bytes, order);
    case Scalar::Int16:
      return load_as<std::int16_t>(bytes, order);
    case Scalar::UInt16:
      return load_as<std::uint16_t>(bytes, order);
    case Scalar::Int32:
      return load_as<std::int32_t>(bytes, order);
    case Scalar::UInt32:
      return load_as<std::uint32_t>(bytes, order);
    case Scalar::Int64:
      return load_as<std::int64_t>(bytes, order);
    case Scalar::UInt64:
      return load_as<std::uint64_t>(bytes, order);
    case Scalar::Float32:
      return load_as<float>(bytes, order);
    case Scalar::Float64:
      break;
  }
  return load_as<double>(bytes, order);
}

void store(const double* values, std::size_t count, Scalar type, char* bytes, std::size_t stride) {
  switch (type) {
    case Scalar::Int8:
      return store_as<std::int8_t>(values, count, bytes, stride);
    case Scalar::UInt8:
      return store_as<std::uint8_t>(values, count, bytes, stride);
    case Scalar::Int16:
      return store_as<std::int16_t>(values, count, bytes, stride);
    case Scalar::UInt16:
      return store_as<std::uint16_t>(values, count, bytes, stride);
    case Scalar::Int32:
      return store_as<std::int32_t>(values, count, bytes, stride);
    case Scalar::UInt32:
      return store_as<std::uint32_t>(values, count, bytes, stride);
    case Scalar::Int64:
      return store_as<std::int64_t>(values, count, bytes, stride);
    case Scalar::UInt64:
      return store_as<std::uint64_t>(values, count, bytes, stride);
    case Scalar::Float32:
      return store_as<float>(values, count, bytes, stride);
    case Scalar::Float64:
      return store_as<double>(values, count, bytes, stride);
  }
}

void append(std::string& bytes, double value, Scalar type) {
  const std::size_t size = bytes.size();
  bytes.resize(size + size_of(type));
  store(&value, 1, type, &bytes[size], 0);
}

Field::Type field_type(Scalar type) {
  switch (type) {
    case Scalar::UInt8:
      return Field::Type::UInt8;
    case Scalar::UInt16:
      return Field::Type::UInt16;
    case Scalar::Int8:
    case Scalar::Int16:
    case Scalar::Int32:
      return Field::Type::Int32;
    case Scalar::UInt32:
      return Field::Type::UInt32;
    case Scalar::Float32:
      return Field::Type::Float32;
    default:
      return Field::Type::Float64;
  }
}

Scalar scalar_of(Field::Type type) {
  switch (type) {
    case Field::Type::Float32:
      return Scalar::Float32;
    case Field::Type::Int32:
      return Scalar::Int32;
    case Field::Type::UInt32:
      return Scalar::UInt32;
    case Field::Type::UInt16:
      return Scalar::UInt16;
    case Field::Type::UInt8:
      return Scalar::UInt8;
    case Field::Type::Float64:
      break;
  }
  return Scalar::Float64;
}

bool fits(double value, Field::Type type) {
  switch (type) {
    case Field::Type::Int32:
      return fits_in<std::int32_t>(value);
    case Field::Type::UInt32:
      return fits_in<std::uint32_t>(value);
    case Field::Type::UInt16:
      return fits_in<std::uint16_t>(value);
    case Field::Type::UInt8:
      return fits_in<std::uint8_t>(value);
    case Field::Type::Float32:
      return !(std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) || std::isinf(value);
    case Field::Type::Float64:
      break;
  }
  return true;
}

const char* type_name(Field::Type type) {
  switch (type) {
    case Field::Type::Float32:
      return "float32";
    case Field::Type::Int32:
      return "int32";
    case Field::Type::UInt32:
      return "uint32";
    case Field::Type::UInt16:
      return "uint16";
    case Field::Type::UInt8:
      return "uint8";
    case Field::Type::Float64:
      break;
  }
  return "float64";
}

}  // namespace kappa::io
