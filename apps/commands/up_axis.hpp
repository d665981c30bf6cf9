// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

#include "checks.hpp"
#include "kappa/view/figure.hpp"

namespace kappa::app {

inline void declare_up_axis(CLI::App& command, std::optional<UpAxis>& axis) {
  command
      .add_option("--up", axis, "Axis that points up: y, z, or camera (-y, a depth camera's frame); default: chosen")
      ->transform(choice<UpAxis>({{"y", UpAxis::Y}, {"z", UpAxis::Z}, {"camera", UpAxis::NegativeY}}));
}

}  // namespace kappa::app
