// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "file.hpp"
#include "kappa/core/execution.hpp"

namespace kappa::io {

/// Any number of values.
inline constexpr std::size_t kAllValues = static_cast<std::size_t>(-1);

/// The values of an array, of which there must be `count`.
/// @throws Error FileFormat if they are not there; before that, nothing is allocated that the file is too small for.
std::vector<double> vtp_values(const FileBytes& file, const VtpFile& vtp, const VtpArray& array, std::size_t count,
                               const Execution& run);

}  // namespace kappa::io
