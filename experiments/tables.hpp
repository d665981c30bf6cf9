// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include "kappa/core/error.hpp"

namespace kappa::experiments {

/// A cell of a CSV table that may hold commas.
inline std::string quoted(const std::string& cell) {
  return '"' + cell + '"';
}

/// The tables of a program, each a function that prints it as CSV, by name.
using Tables = std::map<std::string, std::function<void()>>;

/// Prints the table that the argument names, or says which there are. Returns the exit code of the program.
inline int print_table(int argc, char** argv, const Tables& tables) {
  const auto wanted = argc == 2 ? tables.find(argv[1]) : tables.end();
  if (wanted == tables.end()) {
    std::fprintf(stderr, "give one table:");
    for (const auto& table : tables) std::fprintf(stderr, " %s", table.first.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  try {
    wanted->second();
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}

}  // namespace kappa::experiments
