// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace kappa::app {

/// Turns one of `names` into its value; a word that is none of them is named, with those that are.
template <class Enum>
CLI::Validator choice(const std::vector<std::pair<std::string, Enum>>& names) {
  const auto transform = [names](std::string& word) {
    std::string known;
    for (const auto& [name, value] : names) {
      if (word == name) {
        word = std::to_string(static_cast<std::underlying_type_t<Enum>>(value));
        return std::string();
      }
      known += (known.empty() ? "" : ", ") + name;
    }
    return "'" + word + "' is none of " + known;
  };
  return CLI::Validator(transform, "");
}

/// A number above 0, or one that is not below it: CLI11's own checks answer with 309 digits.
inline CLI::Validator positive() {
  const auto check = [](std::string& word) {
    double value = 0;
    return CLI::detail::lexical_cast(word, value) && value > 0 ? std::string() : "'" + word + "' is not above 0";
  };
  return CLI::Validator(check, "POSITIVE");
}
inline CLI::Validator not_negative() {
  const auto check = [](std::string& word) {
    double value = 0;
    return CLI::detail::lexical_cast(word, value) && value >= 0 ? std::string() : "'" + word + "' is not 0 or more";
  };
  return CLI::Validator(check, "NONNEGATIVE");
}

}  // namespace kappa::app
