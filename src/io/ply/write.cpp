// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "io/pace.hpp"
#include "io/rows.hpp"
#include "io/safe_name.hpp"
#include "io/scalar.hpp"

namespace kappa::io {

namespace {

const char* ply_type(Field::Type type) {
  switch (type) {
    case Field::Type::Float32:
      return "float";
    case Field::Type::Int32:
      return "int";
    case Field::Type::UInt32:
      return "uint";
    case Field::Type::UInt16:
      return "ushort";
    case Field::Type::UInt8:
      return "uchar";
    case Field::Type::Float64:
      break;
  }
  return "double";
}

std::size_t largest_face(const Faces& faces) {
  std::size_t largest = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) largest = std::max(largest, faces[f].size());
  return largest;
}

/// How faces are stored: in a byte and an int, as all readers know it, unless the mesh needs more.
struct FaceTypes {
  Scalar count, index;
  const char* text;
};

FaceTypes face_types(const Scan& scan) {
  const bool long_faces = largest_face(scan.faces) > 255;
  const bool many_points = scan.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  const Scalar index = many_points ? Scalar::UInt32 : Scalar::Int32;
  if (long_faces) return {Scalar::Int32, index, many_points ? "int uint" : "int int"};
  return {Scalar::UInt8, index, many_points ? "uchar uint" : "uchar int"};
}

std::string ply_header(const Scan& scan, const FaceTypes& types) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment written by kappa\nelement vertex " +
                       std::to_string(scan.points.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) header += std::string("property double ") + name + "\n";
  for (const char* name : {"nx", "ny", "nz"}) {
    if (!scan.normals.empty()) header += std::string("property double ") + name + "\n";
  }
  for (const Field& field : scan.fields) {
    header += std::string("property ") + ply_type(field.type) + " " + safe_name(field.name) + "\n";
  }
  if (scan.is_mesh()) {
    header +=
        "element face " + std::to_string(scan.faces.size()) + "\nproperty list " + types.text + " vertex_indices\n";
  }
  return header + "end_header\n";
}

}  // namespace

void write_ply(std::ostream& out, const Scan& scan, const Execution& run) {
  const FaceTypes types = face_types(scan);
  out << ply_header(scan, types);
  const double share = scan.is_mesh() ? 0.5 : 1.0;
  write_rows(out, scan, stage(run, 0.0, share));
  std::string row;
  for_each_row(scan.faces.size(), stage(run, share, 1.0), [&](std::size_t f) {
    row.clear();
    const Faces::View face = scan.faces[f];
    append(row, static_cast<double>(face.size()), types.count);
    for (const Index corner : face) append(row, corner, types.index);
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  });
}

}  // namespace kappa::io
