// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kappa::io {

/// A file in memory, with its name for messages.
struct FileBytes {
  std::string path;
  std::string bytes;

  std::string_view from(std::size_t offset) const { return std::string_view(bytes).substr(offset); }
};

/// @throws Error FileNotFound if the file cannot be opened, FileFormat if it is not a regular file, or a
/// Git-LFS pointer in place of the data.
void check_file(const std::string& path);

/// Reads a whole file.
/// @throws Error FileNotFound if it cannot be read.
FileBytes load_file(const std::string& path);

/// Lower-case extension of a file name, with the dot.
std::string extension_of(const std::string& path);

/// Throws Error FileFormat: "'path': what".
[[noreturn]] void refuse(const std::string& path, const std::string& what);

/// Throws Error FileFormat: "'path', line n: what".
[[noreturn]] void refuse_line(const std::string& path, std::size_t line, const std::string& what);

}  // namespace kappa::io
