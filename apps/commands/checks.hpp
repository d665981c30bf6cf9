// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>

#include "kappa/core/names.hpp"

namespace kappa::app {

/// The words of an enum, as a list with commas.
template <class Enum>
std::string words_of() {
  std::string words;
  for (const Named<Enum>& named : names_of(Enum{})) words += (words.empty() ? "" : ", ") + std::string(named.name);
  return words;
}

/// Turns a word of the table of an enum into its value. What is none of the words is named, with those that are.
template <class Enum>
CLI::Validator word_of() {
  const auto transform = [](std::string& word) {
    for (const Named<Enum>& named : names_of(Enum{})) {
      if (word != named.name) continue;
      word = std::to_string(static_cast<std::underlying_type_t<Enum>>(named.value));
      return std::string();
    }
    return "'" + word + "' is none of " + words_of<Enum>();
  };
  return CLI::Validator(transform, "");
}

/// Adds an option whose value is a word of the table of an enum; the help says what each word means, and the default.
template <class Enum>
CLI::Option* add_choice(CLI::App& command, const std::string& option, Enum& value, const std::string& description,
                        const std::string& kind = "KIND") {
  std::string help = description + ":";
  for (const Named<Enum>& named : names_of(Enum{})) help += std::string("\n  ") + named.name + ": " + named.meaning;
  return command.add_option(option, value, help)->transform(word_of<Enum>())->option_text(kind + "=" + name(value));
}

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

/// A finite number. @throws CLI::ValidationError.
double parse_number(const std::string& option, const std::string& text);

/// `count` numbers separated by commas. @throws CLI::ValidationError.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count);

}  // namespace kappa::app
