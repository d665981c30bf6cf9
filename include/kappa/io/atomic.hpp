// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace kappa {

/// Opens a temporary file beside `path`, lets `fill` write it, and renames it; removes it on any error.
/// @throws Error FileWrite with the system's reason, or what `fill` throws.
void write_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& fill);

}  // namespace kappa
