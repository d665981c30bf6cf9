// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

void write_ply(std::ostream& out, const Scan& scan, const Execution& run);

}  // namespace kappa::io
