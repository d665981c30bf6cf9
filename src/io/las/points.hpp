// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "kappa/core/execution.hpp"
#include "kappa/io/las/file.hpp"

namespace kappa::io {

/// A position as LAS stores it.
using LasPosition = std::array<std::int32_t, 3>;

struct LasRange {
  LasPosition min{}, max{};
};

/// Least and largest stored coordinate; 0 without points.
LasRange range_of(const LasFile& las, const Execution& run);

LasPosition stored_position(const LasFile& las, std::size_t point);

/// Positions relative to a local origin that is itself a stored position: (integer - integer) * scale
/// loses no digit and does not depend on the offset of the file, however large.
struct LasGrid {
  std::array<std::int64_t, 3> centre{};  ///< stored position of the local origin
  Vec3 scale = Vec3::Ones();
  Vec3 origin = Vec3::Zero();  ///< of the local origin in the coordinates of the file

  double local(std::int32_t stored, int axis) const {
    return static_cast<double>(stored - centre[static_cast<std::size_t>(axis)]) * scale[axis];
  }
  Vec3 local(const LasPosition& p) const { return {local(p[0], 0), local(p[1], 1), local(p[2], 2)}; }
};

/// A grid about the middle of the points, whose range is `range`, its centre a round number of steps.
LasGrid local_grid(const LasFile& las, const LasRange& range);

}  // namespace kappa::io
