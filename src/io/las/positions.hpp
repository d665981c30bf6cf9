// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"
#include "points.hpp"

namespace kappa::io {

/// Scale and offset for a scan that came from no LAS file. The scale of an axis is the coarsest power
/// of ten, from 1e-3 down, in which every coordinate is a whole number (to 1e-4 of the finest), else the finest that 32
/// bits allow: then the error is below 2.5e-9 of the extent.
void choose_grid(const Scan& scan, LasFile& las, const Execution& run);

/// Stored positions of the points of a scan, with the scale and offset of `las`. A point that is where
/// its record has it gives the integers of the record, whatever the rounding.
class LasPositions {
 public:
  LasPositions(const Scan& scan, const LasFile& las);
  /// @throws Error InvalidArgument if the point is not finite, or too far from the offset for 32 bits.
  LasPosition operator()(std::size_t point) const;

 private:
  std::int32_t stored(std::size_t point, int axis) const;
  bool is_unmoved(std::size_t point, int axis, std::int32_t stored) const;

  const Scan& scan_;
  const LasFile* las_;  ///< that the scan came from, if any
  Vec3 scale_, shift_, offset_;
  /// Stored position of the local origin, where the scan still has the origin of its file.
  std::array<std::optional<std::int64_t>, 3> centre_;
};

}  // namespace kappa::io
