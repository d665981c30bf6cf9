// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/checks.hpp"

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

/// "vertices" for "vertex", "normals" for "normal".
std::string plural(const std::string& noun) {
  const auto ends_with = [&](const std::string& end) {
    return noun.size() >= end.size() && noun.compare(noun.size() - end.size(), end.size(), end) == 0;
  };
  if (ends_with("vertex")) return noun.substr(0, noun.size() - 2) + "ices";
  if (ends_with("radius")) return noun.substr(0, noun.size() - 2) + "i";
  return noun + "s";
}

}  // namespace

void check_one_each(std::size_t values, const std::string& value, std::size_t things, const std::string& thing) {
  if (values == things) return;
  throw Error(ErrorCode::InvalidArgument, std::to_string(values) + " " + plural(value) + " for " +
                                              std::to_string(things) + " " + plural(thing) + ": give one a " + thing);
}

void check_range(const std::string& name, long value, long from, long to, const std::string& what) {
  if (value >= from && value <= to) return;
  throw Error(ErrorCode::InvalidArgument, name + " = " + std::to_string(value) + ": give " + std::to_string(from) +
                                              " to " + std::to_string(to) + " for " + what);
}

}  // namespace kappa
