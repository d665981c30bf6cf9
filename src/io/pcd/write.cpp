// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

#include <string>

#include "io/rows.hpp"
#include "io/safe_name.hpp"
#include "io/scalar.hpp"
#include "kappa/core/decimal.hpp"

namespace kappa::io {

namespace {

std::string pcd_header(const Scan& scan) {
  std::string names = "x y z", sizes = "8 8 8", types = "F F F", counts = "1 1 1";
  const auto add = [&](const std::string& name, Scalar type) {
    names += " " + name;
    sizes += " " + std::to_string(size_of(type));
    types += is_floating(type) ? " F" : (type == Scalar::Int32 ? " I" : " U");
    counts += " 1";
  };
  for (const char* name : {"normal_x", "normal_y", "normal_z"}) {
    if (!scan.normals.empty()) add(name, Scalar::Float64);
  }
  for (const Field& field : scan.fields) add(safe_name(field.name), scalar_of(field.type));
  std::string viewpoint;
  for (int axis = 0; axis < 3; ++axis) append_decimal(viewpoint += " ", scan.viewpoint ? (*scan.viewpoint)[axis] : 0.0);
  const std::size_t width = scan.is_organised() ? scan.width : scan.points.size();
  const std::size_t height = scan.is_organised() ? scan.height : 1;
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + names + "\nSIZE " + sizes + "\nTYPE " +
         types + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(width) + "\nHEIGHT " + std::to_string(height) +
         "\nVIEWPOINT" + viewpoint + " 1 0 0 0\nPOINTS " + std::to_string(scan.points.size()) + "\nDATA binary\n";
}

}  // namespace

void write_pcd(std::ostream& out, const Scan& scan, const Execution& run) {
  out << pcd_header(scan);
  write_rows(out, scan, run);
}

}  // namespace kappa::io
