// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// Makes a scan of named columns of equal length: x y z (in any case) become the points, nx ny nz or
/// normal_x normal_y normal_z the normals, all others fields. Points are still relative to 0.
/// @throws Error FileFormat if a coordinate is missing or a name stands twice.
Scan scan_from_columns(const std::string& path, std::vector<Field> columns, const Execution& run);

/// Last step of every reader: width, height and local origin.
/// @throws Error FileFormat if there is no point, or none that is finite.
void finish(const std::string& path, Scan& scan);

/// @throws Error FileFormat if `count` points cannot be indexed.
void check_count(const std::string& path, std::size_t count);

}  // namespace kappa::io
