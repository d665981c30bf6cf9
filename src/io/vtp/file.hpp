// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/scalar.hpp"
#include "kappa/core/execution.hpp"

/// The structure of a VTK XML file of type PolyData, and the numbers in its arrays. Nothing in it is trusted.
namespace kappa::io {

enum class VtpFormat { Ascii, Inline, Appended };

struct VtpArray {
  std::string section;  ///< element it stands in: Points, PointData, Polys, ...
  std::string name;
  Scalar type = Scalar::Float64;
  std::size_t components = 1;
  VtpFormat format = VtpFormat::Ascii;
  std::size_t offset = 0;  ///< in the appended data
  std::string text;        ///< content of an array that is not appended
};

struct VtpFile {
  ByteOrder order = ByteOrder::Little;
  Scalar header_type = Scalar::UInt32;
  bool is_compressed = false;
  std::size_t points = 0, verts = 0, strips = 0, polys = 0;
  std::string normals;  ///< name of the array that holds them
  std::vector<VtpArray> arrays;
  std::string_view appended;
  bool appended_is_base64 = false;

  const VtpArray* array(const std::string& section, const std::string& name) const;
};

/// @throws Error FileFormat for anything that is not one sound piece of PolyData.
VtpFile parse_vtp(const FileBytes& file, const Execution& run);

}  // namespace kappa::io
