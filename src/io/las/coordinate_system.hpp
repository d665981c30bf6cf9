// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "kappa/io/las/file.hpp"

namespace kappa::io {

// Records of the user LASF_Projection that describe the coordinate system.
inline constexpr std::uint16_t kWkt = 2112;
inline constexpr std::uint16_t kGeoKeys = 34735, kGeoDoubles = 34736;

/// Whether the coordinate system of a LAS file (WKT, else GeoTIFF keys) states degrees; nothing where it is silent.
std::optional<bool> states_degrees(const LasFile& las);

}  // namespace kappa::io
