// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dimensions.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// Values that are put into the records: those of a field, or an axis of the normals.
struct LasColumn {
  const Field* field = nullptr;
  int axis = 0;
  LasDimension dimension;

  double value(const Scan& scan, std::size_t point) const {
    return field ? field->values[point] : scan.normals[point][axis];
  }
};

/// What a LAS 1.4 file of a scan consists of.
struct LasOutput {
  LasFile frame;                   ///< the parts of the file, without points; the header is still that of the source
  std::vector<LasColumn> columns;  ///< what differs from the records of the source, or from `blank`
  std::string blank;               ///< point record of a scan that came from no LAS file
};

/// @throws Error InvalidArgument if a name or the number of fields is more than LAS can hold, or an
/// attribute of the source cannot hold a value that a field of its name has.
LasOutput plan_las(const Scan& scan, const Execution& run);

}  // namespace kappa::io
