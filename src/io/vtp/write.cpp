// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

#include <functional>

#include "io/coordinate.hpp"
#include "io/pace.hpp"
#include "io/scalar.hpp"
#include "names.hpp"
#include "xml.hpp"

namespace kappa::io {

namespace {

/// An array of the appended data: `rows` times what `append_row` appends, `bytes` in all.
struct Appended {
  std::string name, type;
  std::size_t components, rows, bytes;
  std::function<void(std::size_t row, std::string& bytes)> append_row;
};

const char* vtk_type(Field::Type type) {
  switch (type) {
    case Field::Type::Float32:
      return "Float32";
    case Field::Type::Int32:
      return "Int32";
    case Field::Type::UInt32:
      return "UInt32";
    case Field::Type::UInt16:
      return "UInt16";
    case Field::Type::UInt8:
      return "UInt8";
    case Field::Type::Float64:
      break;
  }
  return "Float64";
}

/// How many fields from field `f` on make one vector, 1 if it is none.
std::size_t vector_size(const std::vector<Field>& fields, std::size_t f) {
  const std::string name = direction_of(fields[f].name);
  if (name.empty() || f + 3 > fields.size()) return 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Field& field = fields[f + k];
    if (field.name != component_name(name, static_cast<int>(k)) || field.type != fields[f].type) return 1;
  }
  return 3;
}

Appended field_array(const Scan& scan, std::size_t f, std::size_t size) {
  const Field* fields = &scan.fields[f];
  const std::string name = size == 3 ? direction_of(fields->name) : to_vtk_name(fields->name);
  const Scalar type = scalar_of(fields->type);
  const std::size_t rows = scan.points.size();
  return {name,
          vtk_type(fields->type),
          size,
          rows,
          rows * size * size_of(type),
          [fields, size, type](std::size_t i, std::string& bytes) {
            for (std::size_t k = 0; k < size; ++k) append(bytes, fields[k].values[i], type);
          }};
}

std::vector<Appended> point_data(const Scan& scan) {
  std::vector<Appended> arrays;
  if (!scan.normals.empty()) {
    arrays.push_back({"Normals", "Float64", 3, scan.normals.size(), scan.normals.size() * 24,
                      [&scan](std::size_t i, std::string& bytes) {
                        for (int k = 0; k < 3; ++k) append(bytes, scan.normals[i][k], Scalar::Float64);
                      }});
  }
  for (std::size_t f = 0, size = 1; f < scan.fields.size(); f += size) {
    size = vector_size(scan.fields, f);
    arrays.push_back(field_array(scan, f, size));
  }
  return arrays;
}

Appended points_array(const Scan& scan) {
  const std::size_t rows = scan.points.size();
  return {"Points", "Float64", 3, rows, rows * 24, [&scan](std::size_t i, std::string& bytes) {
            for (int axis = 0; axis < 3; ++axis) append(bytes, coordinate(scan, i, axis), Scalar::Float64);
          }};
}

/// Faces, or every point as a cell, so that a viewer shows a cloud.
std::vector<Appended> cells(const Scan& scan) {
  const auto append_index = [](std::string& bytes, std::size_t index) {
    append(bytes, static_cast<double>(index), Scalar::Int64);
  };
  const std::size_t points = scan.points.size(), faces = scan.faces.size(), corners = scan.faces.corners().size();
  if (!scan.is_mesh()) {
    return {{"connectivity", "Int64", 1, points, points * 8,
             [=](std::size_t i, std::string& bytes) { append_index(bytes, i); }},
            {"offsets", "Int64", 1, points, points * 8,
             [=](std::size_t i, std::string& bytes) { append_index(bytes, i + 1); }}};
  }
  return {{"connectivity", "Int64", 1, corners, corners * 8,
           [=, &scan](std::size_t i, std::string& bytes) { append_index(bytes, scan.faces.corners()[i]); }},
          {"offsets", "Int64", 1, faces, faces * 8, [=, &scan](std::size_t f, std::string& bytes) {
             append_index(bytes, scan.faces.offset(f) + scan.faces[f].size());
           }}};
}

/// Element `name` with the headers of its arrays; `offset` is that of the next array in the appended data.
void write_section(std::ostream& out, const std::string& start, const std::string& name,
                   const std::vector<Appended>& arrays, std::size_t& offset) {
  out << "<" << name << start << ">\n";
  for (const Appended& array : arrays) {
    out << "<DataArray type=\"" << array.type << "\" Name=\"" << xml_escaped(array.name) << "\" NumberOfComponents=\""
        << array.components << "\" format=\"appended\" offset=\"" << offset << "\"/>\n";
    offset += 8 + array.bytes;
  }
  out << "</" << name << ">\n";
}

void write_array(std::ostream& out, const Appended& array, const Execution& run) {
  std::string bytes;
  append(bytes, static_cast<double>(array.bytes), Scalar::UInt64);
  for_each_row(array.rows, run, [&](std::size_t i) {
    array.append_row(i, bytes);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  });
  out << bytes;  // of an array without rows
}

}  // namespace

void write_vtp(std::ostream& out, const Scan& scan, const Execution& run) {
  const std::vector<Appended> data = point_data(scan), points = {points_array(scan)}, faces = cells(scan);
  const bool is_mesh = scan.is_mesh();
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\""
      << scan.points.size() << "\" NumberOfVerts=\"" << (is_mesh ? 0 : scan.points.size())
      << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" << scan.faces.size() << "\">\n";
  std::size_t offset = 0;
  write_section(out, scan.normals.empty() ? "" : " Normals=\"Normals\"", "PointData", data, offset);
  write_section(out, "", "Points", points, offset);
  write_section(out, "", is_mesh ? "Polys" : "Verts", faces, offset);
  out << "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  const double count = static_cast<double>(data.size() + points.size() + faces.size());
  double done = 0;
  for (const auto* section : {&data, &points, &faces}) {
    for (const Appended& array : *section) {
      write_array(out, array, stage(run, done / count, (done + 1) / count));
      ++done;
    }
  }
  out << "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace kappa::io
