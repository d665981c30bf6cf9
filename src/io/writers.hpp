// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

#include "kappa/core/decimal.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

/// One writer a format. The scan has been checked; the caller checks the stream.
namespace kappa::io {

void write_csv(std::ostream& out, const Scan& scan, const Execution& run);
void write_ply(std::ostream& out, const Scan& scan, const Execution& run);
void write_pcd(std::ostream& out, const Scan& scan, const Execution& run);
void write_vtp(std::ostream& out, const Scan& scan, const Execution& run);
/// The stream must be able to seek.
void write_las(std::ostream& out, const Scan& scan, const Execution& run);

/// Coordinate `axis` of a point as it was in the file it came from.
inline double coordinate(const Scan& scan, std::size_t point, int axis) {
  const double origin = scan.origin[axis];
  return origin == 0.0 ? scan.points[point][axis] : origin + scan.points[point][axis];  // 0 + -0 would lose the sign
}

/// `name` without the characters that end a word in one of the formats.
std::string safe_name(const std::string& name);

/// Calls `row(i)` for each of `count` rows, with progress and cancellation between blocks.
template <class Row>
void for_each_row(std::size_t count, const Execution& run, Row&& row) {
  constexpr std::size_t kBlock = 16384;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    check_cancelled(run);
    if (run.progress) run.progress(static_cast<double>(begin) / static_cast<double>(count));
    for (std::size_t i = begin; i < count && i < begin + kBlock; ++i) row(i);
  }
}

}  // namespace kappa::io
