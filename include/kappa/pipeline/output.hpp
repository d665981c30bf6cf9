// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/pipeline/measure_scan.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// The points of a scan with their corrected normals (NaN where there is none) and the faces of the file, in the
/// coordinates of the file.
/// @throws Cancelled
Scan output_scan(const SurfacedScan& surfaced, const Execution& run = {});

/// The same with the fields of every radius, each name followed by `field_suffix`, and where there are labels `label`
/// and `region`: what `kappa curvature` and `kappa segment` write.
/// @throws Cancelled
Scan output_scan(const ScanResult& result, const Execution& run = {});

/// What is put behind the names of the fields of a radius: nothing if there is one radius alone, else "_r<value>".
std::string field_suffix(const ScanResult& result, std::size_t radius);

}  // namespace kappa
