// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/file_bytes.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/io/las/file.hpp"

namespace kappa::io {

/// Takes a LAS file apart. Every count, offset and length is checked against the size of the file
/// before it is used, so that what is allocated never exceeds that size.
/// @throws Error FileFormat with the entry of the header at fault, its value and what to do.
LasFile parse_las(const FileBytes& file, const Execution& run);

/// How to convert a compressed file.
std::string laz_remedy(const std::string& path);

}  // namespace kappa::io
