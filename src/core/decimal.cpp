// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/decimal.hpp"

#include <charconv>
#include <cmath>

namespace kappa {

std::string decimal(double value) {
  std::string text;
  append_decimal(text, value);
  return text;
}

void append_decimal(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "nan";
    return;
  }
  // Left to itself to_chars writes 5e+05 for 500000.
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-4 && size < 1e15);
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value,
                                          plain ? std::chars_format::fixed : std::chars_format::scientific);
  text.append(buffer, end);
}

}  // namespace kappa
