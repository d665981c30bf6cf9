// SPDX-License-Identifier: BSD-3-Clause
#include "checks.hpp"

#include <cmath>

#include "kappa/core/types.hpp"

namespace kappa::app {

double parse_number(const std::string& option, const std::string& text) {
  double value = kNaN;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value))
    throw CLI::ValidationError(option, "'" + text + "' is not a finite number");
  return value;
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (const std::string& part : CLI::detail::split(text, ',')) values.push_back(parse_number(option, part));
  if (values.size() != count)
    throw CLI::ValidationError(option, "'" + text + "' is not " + std::to_string(count) + " numbers with commas");
  return values;
}

}  // namespace kappa::app
