// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace kappa::io {

class FileMap;

/// The bytes of a file, with its name for messages.
struct FileBytes {
  std::string path;
  std::string_view bytes;
  std::shared_ptr<const FileMap> map = nullptr;  ///< that the bytes are in; null if they are somebody else's

  std::string_view from(std::size_t offset) const { return bytes.substr(offset); }
  /// Says that no byte before `end` will be read again soon, so that they need no memory.
  void done_before(std::size_t end) const;
};

/// @throws Error FileNotFound if the file cannot be opened, FileFormat if it is not a regular file, or a
/// Git-LFS pointer in place of the data.
void check_file(const std::string& path);

/// Maps a whole file into memory: pages are read when they are touched, and can be given back (done_before).
///
/// A file that others change meanwhile is refused by `check_unchanged`, unless they make it shorter (truncate, or write
/// anew under the same name) than what is touched then: the system ends the process with SIGBUS, as for any program
/// that maps files. A file that is replaced by renaming, as all good writers do and ours does, is safe. So is the
/// result: readers copy what they keep, and the map ends with the reading.
/// @throws Error FileNotFound if it cannot be read.
FileBytes load_file(const std::string& path);

/// @throws Error FileFormat if the file has changed in length or time since it was mapped.
void check_unchanged(const FileBytes& file);

/// Lower-case extension of a file name, with the dot.
std::string extension_of(const std::string& path);

/// Throws Error FileFormat: "'path': what".
[[noreturn]] void refuse(const std::string& path, const std::string& what);

/// Throws Error FileFormat: "'path', line n: what".
[[noreturn]] void refuse_line(const std::string& path, std::size_t line, const std::string& what);

}  // namespace kappa::io
