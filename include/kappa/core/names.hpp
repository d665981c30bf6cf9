// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <vector>

namespace kappa {

/// A value of an enum, the word that users write for it, and what it means in a few words.
///
/// Every enum that users name has one table, a function `names_of` in the header of the enum:
///
///     const std::vector<Named<Returns>>& names_of(Returns);
///
/// `name`, the command line and its help all read this table. The argument of `names_of` only chooses the enum.
template <class Enum>
struct Named {
  Enum value;
  const char* name;
  const char* meaning;
};

/// The word for `value` in the table of its enum. It is "" if the table lacks the value.
template <class Enum, class = std::enable_if_t<std::is_enum_v<Enum>>>
const char* name(Enum value) {
  for (const Named<Enum>& named : names_of(value)) {
    if (named.value == value) return named.name;
  }
  return "";
}

}  // namespace kappa
