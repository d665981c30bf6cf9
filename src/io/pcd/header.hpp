// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/scalar.hpp"
#include "kappa/core/types.hpp"

namespace kappa::io {

struct PcdField {
  std::string name;
  Scalar type = Scalar::Float32;
  std::size_t count = 1;  ///< values a point
};

enum class PcdData { Ascii, Binary, Compressed };

/// Header of a PCD file, checked for consistency and against the size of the file.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t width = 0, height = 1;
  std::optional<Vec3> viewpoint;
  PcdData data = PcdData::Ascii;
  std::size_t lines = 0;   ///< of the header
  std::size_t offset = 0;  ///< of the data in the file

  std::size_t points() const { return width * height; }
  std::size_t values_per_point() const;
  std::size_t bytes_per_point() const;
};

/// @throws Error FileFormat with the line at fault.
PcdHeader parse_pcd_header(const FileBytes& file);

}  // namespace kappa::io
