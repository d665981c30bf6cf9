// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/scalar.hpp"

namespace kappa::io {

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::Float32;  ///< of the value, or of the items of a list
  bool is_list = false;
  Scalar count_type = Scalar::UInt8;  ///< of the length of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t lines = 0;   ///< of the header
  std::size_t offset = 0;  ///< of the data in the file

  const PlyElement* element(const std::string& name) const;
};

/// Header of a PLY file; the counts of its elements are checked against the size of the file.
/// @throws Error FileFormat with the line at fault.
PlyHeader parse_ply_header(const FileBytes& file);

}  // namespace kappa::io
