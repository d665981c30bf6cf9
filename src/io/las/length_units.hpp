// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// The units that the coordinate system of a LAS file states: a projected and a vertical one in WKT (1 or 2), else the
/// linear and vertical units of its GeoTIFF keys.
LengthUnits length_units(const LasFile& las);

}  // namespace kappa::io
