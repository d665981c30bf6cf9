// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "kappa/core/error.hpp"

namespace kappa::detail {

/// Shortest of the usual notations of a number.
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

[[noreturn]] inline void refuse(const char* name, double value, const std::string& range) {
  throw Error(ErrorCode::InvalidArgument, std::string(name) + " is " + number_text(value) + "; it must be " + range);
}

/// The checks are written so that NaN fails them.
inline void require_positive(const char* name, double value) {
  if (!(value > 0 && std::isfinite(value))) refuse(name, value, "finite and above 0");
}

inline void require_not_negative(const char* name, double value) {
  if (!(value >= 0 && std::isfinite(value))) refuse(name, value, "finite and not negative");
}

inline void require_finite(const char* name, double value) {
  if (!std::isfinite(value)) refuse(name, value, "finite");
}

inline void require_between(const char* name, double value, double from, double to) {
  if (!(value >= from && value <= to)) {
    refuse(name, value, "between " + number_text(from) + " and " + number_text(to));
  }
}

/// Most vertices or points that one shape may have.
inline constexpr double kMaxPoints = 1e8;

}  // namespace kappa::detail
