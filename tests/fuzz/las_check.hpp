// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace kappa::fuzz {

/// Reads bytes as a LAS file. If they are one, writes what was read, as it is and with one more field,
/// and reads that again: every record must come back bit for bit.
/// @returns whether the bytes were read; all else that is not refused by a kappa::Error ends in another exception.
bool check_las(const std::string& bytes);

}  // namespace kappa::fuzz
