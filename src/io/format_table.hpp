// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "io/file_bytes.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// What kappa does with the files of an extension.
struct Format {
  const char* extension;  ///< lower case, with the dot
  /// Returns points relative to 0, or to a local origin if they would lose digits otherwise. `finish` is left to the
  /// caller.
  /// @throws Error FileFormat for anything that cannot be read exactly; Cancelled.
  Scan (*read)(const FileBytes& file, const Execution& run);
  /// Writes a scan that has been checked; the caller checks the stream, which must be able to seek. Null for a format
  /// that is only read.
  /// @throws Error InvalidArgument for what the format cannot hold; Cancelled.
  void (*write)(std::ostream& out, const Scan& scan, const Execution& run);
  bool holds_faces;
};

/// All formats, in the order in which messages and help name them: those that are also written come first.
const std::vector<Format>& format_table();

/// The format of a file by the extension of its name, in any case; null if there is none.
const Format* format_of(const std::string& path);

/// The words with blanks between them.
std::string listed(const std::vector<std::string>& words);

}  // namespace kappa::io
