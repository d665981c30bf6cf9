// SPDX-License-Identifier: BSD-3-Clause
#include "safe_name.hpp"

namespace kappa::io {

std::string safe_name(const std::string& name) {
  std::string safe = name;
  for (char& c : safe) {
    const bool separates = static_cast<unsigned char>(c) <= 0x20 || c == ',' || c == ';' || c == '"' || c == 0x7f;
    if (separates) c = '_';
  }
  return safe;
}

}  // namespace kappa::io
