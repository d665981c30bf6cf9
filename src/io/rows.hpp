// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// Writes a row of little-endian numbers a point: coordinates and normals (if any) as doubles, then the fields, each as
/// its type. PLY and PCD have the same rows. One thread writes while the others fill blocks.
void write_rows(std::ostream& out, const Scan& scan, const Execution& run);

}  // namespace kappa::io
