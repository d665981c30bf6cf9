// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/file_bytes.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

Scan read_text(const FileBytes& file, const Execution& run);

}  // namespace kappa::io
