// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

#include <string>

#include "io/coordinate.hpp"
#include "io/pace.hpp"
#include "io/safe_name.hpp"
#include "kappa/core/decimal.hpp"

namespace kappa::io {

void write_csv(std::ostream& out, const Scan& scan, const Execution& run) {
  std::string line = scan.normals.empty() ? "x,y,z" : "x,y,z,nx,ny,nz";
  for (const Field& field : scan.fields) line += "," + safe_name(field.name);
  out << line << '\n';
  for_each_row(scan.points.size(), run, [&](std::size_t i) {
    line.clear();
    const auto add = [&](double value) {
      append_decimal(line, value);
      line += ',';
    };
    for (int axis = 0; axis < 3; ++axis) add(coordinate(scan, i, axis));
    for (int axis = 0; axis < 3 && !scan.normals.empty(); ++axis) add(scan.normals[i][axis]);
    for (const Field& field : scan.fields) add(field.values[i]);
    line.back() = '\n';
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  });
}

}  // namespace kappa::io
