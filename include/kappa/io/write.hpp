// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Writes points, normals (if any), fields and faces (where the format has them) by the extension:
/// .csv (header line, the shortest decimal that gives back each value, `nan`), .ply (binary, coordinates in double),
/// .pcd (binary, coordinates in double, normals as normal_x ...), .vtp (VTK's names: Mean_Curvature, Gauss_Curvature,
/// Minimum_Curvature, Maximum_Curvature, with directions as 3-vectors), .las (1.4, no faces, no points without a
/// position; coordinates to 2.5e-9 of the extent at worst, all that came from a LAS file bit for bit).
///
/// Coordinates leave as they came: the local origin is added back in double. The file is written
/// under a temporary name beside `path` and renamed: it is complete or not there.
/// @throws Error FileWrite (unknown extension, or the system's reason); InvalidArgument if sizes differ, two fields
/// have one name or that of a coordinate, or a value does not fit the type of its field; Cancelled.
void write_scan(const std::string& path, const Scan& scan, const Execution& run = {});

/// Extensions that write_scan knows, lower case with the dot.
const std::vector<std::string>& writable_extensions();

/// Those of them whose files keep faces.
const std::vector<std::string>& writable_mesh_extensions();

/// @throws Error FileWrite if write_scan would refuse `path` for its extension or its folder: to be
/// called before a long computation.
void check_writable(const std::string& path);

}  // namespace kappa
