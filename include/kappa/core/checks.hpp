// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace kappa {

/// Checks that there is one value for each thing, such as one normal a point.
/// @throws Error InvalidArgument, "12 normals for 10 points: give one a point", for (12, "normal", 10, "point").
void check_one_each(std::size_t values, const std::string& value, std::size_t things, const std::string& thing);

/// Checks that `value` is in [from, to].
/// @throws Error InvalidArgument, "neighbours = 2: give 3 to 255 for <what>".
void check_range(const std::string& name, long value, long from, long to, const std::string& what);

}  // namespace kappa
