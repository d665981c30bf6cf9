// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// Records of the user LASF_Projection that describe the coordinate system.
namespace kappa::io {

inline constexpr std::uint16_t kWkt = 2112;
inline constexpr std::uint16_t kGeoKeys = 34735, kGeoDoubles = 34736;

}  // namespace kappa::io
