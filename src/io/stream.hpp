// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace kappa::io {

/// Writes a file through a stream and reports what the stream could not do.
void write_stream(const std::string& path, const std::function<void(std::ostream&)>& fill);

}  // namespace kappa::io
