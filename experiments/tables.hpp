// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kappa/core/error.hpp"

namespace kappa::experiments {

/// Tables of a program by the names that its arguments call them.
using Tables = std::vector<std::pair<std::string, std::function<void()>>>;

/// Prints those that the arguments name, all of them without an argument. The exit code of the program.
inline int print_tables(int argc, char** argv, const Tables& tables) {
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  try {
    for (const auto& [name, print] : tables) {
      if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) print();
    }
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}

}  // namespace kappa::experiments
