// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <ostream>
#include <string>

#include "kappa/core/execution.hpp"

namespace kappa::io {

/// Writes a file atomically (see write_atomically) through a stream.
/// @throws Error FileWrite with the reason why the stream could not be written, Cancelled, or what `fill` throws; then
/// `path` is as it was.
void write_stream(const std::string& path, const Execution& run, const std::function<void(std::ostream&)>& fill);

}  // namespace kappa::io
