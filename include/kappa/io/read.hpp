// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Reads a cloud or a mesh, by the extension of its name (any case):
/// .pcd (ascii, binary, compressed; float or double; x y z in any case), .ply, .obj, .off, .stl, .vtp,
/// .las (1.0 to 1.4, point formats 0 to 10), and text
/// .xyz .pts .txt .csv (x y z, optionally normals, optional header line; separated by blanks, commas
/// or semicolons).
///
/// Points are in double relative to `choose_origin` of their bounds; not one digit of the file is
/// lost. Numeric attributes other than position and normal become `Scan::fields`. Normals are those of
/// the file, one a vertex (those given per corner of a face are averaged at its vertex). Equal
/// vertices of .stl are merged. Text and VTK files written by `write_scan` come back as they were.
/// @throws Error FileNotFound, or FileFormat with the name of the file, what is wrong with it (with
/// line or byte where known) and the remedy. Never a partial result.
Scan read_scan(const std::string& path, const Execution& run = {});

/// The same for a file that must have faces.
/// @throws Error InvalidData if it has none.
Mesh read_mesh(const std::string& path, const Execution& run = {});

/// Extensions that read_scan knows, lower case with the dot.
const std::vector<std::string>& readable_extensions();

}  // namespace kappa
