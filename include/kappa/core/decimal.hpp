// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace kappa {

/// The shortest decimal that gives back `value`, such as "0.1", "500000" or "2e-10"; "nan" for any NaN.
std::string decimal(double value);

/// Appends it to `text`.
void append_decimal(std::string& text, double value);

}  // namespace kappa
