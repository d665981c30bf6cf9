// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace kappa {

struct LabelOptions {
  std::optional<double> kappa_max, flatness, min_region;
};

}  // namespace kappa
