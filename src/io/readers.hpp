// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file_bytes.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

/// One reader a format. Each returns points relative to 0 and throws Error FileFormat for anything
/// it cannot read exactly; `finish` is left to the caller.
namespace kappa::io {

Scan read_pcd(const FileBytes& file);
Scan read_ply(const FileBytes& file);
Scan read_obj(const FileBytes& file);
Scan read_off(const FileBytes& file);
Scan read_stl(const FileBytes& file);
Scan read_vtp(const FileBytes& file);
Scan read_text(const FileBytes& file);
/// Points come relative to a local origin already, lest they lose digits.
Scan read_las(const FileBytes& file);

}  // namespace kappa::io
