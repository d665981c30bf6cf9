// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace kappa::io {

/// `name` without the characters that end a word in one of the formats.
std::string safe_name(const std::string& name);

}  // namespace kappa::io
