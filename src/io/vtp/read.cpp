// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include "file.hpp"
#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"
#include "names.hpp"
#include "values.hpp"

namespace kappa::io {

namespace {

/// Name of a component of an array, in our terms.
std::string name_of_component(const VtpFile& vtp, const VtpArray& array, std::size_t k) {
  const bool is_normal = array.components == 3 && (array.name == vtp.normals || array.name == "Normals");
  if (is_normal) return std::string("n") + "xyz"[k];
  if (array.components == 1) return from_vtk_name(array.name);
  if (array.components == 3) return component_name(array.name, static_cast<int>(k));
  return array.name + "_" + std::to_string(k);
}

/// One column a component.
void add_columns(const FileBytes& file, const VtpFile& vtp, const VtpArray& array,
                 const std::vector<std::string>& names, std::vector<Field>& columns, const Execution& run) {
  const std::vector<double> values = vtp_values(file, vtp, array, vtp.points * array.components, stage(run, 0.0, 0.8));
  for (std::size_t k = 0; k < array.components; ++k) {
    Field field;
    field.name = names[k];
    field.type = field_type(array.type);
    field.values.resize(vtp.points);
    for_each_row(vtp.points, part(stage(run, 0.8, 1.0), k, array.components),
                 [&](std::size_t i) { field.values[i] = values[i * array.components + k]; });
    columns.push_back(std::move(field));
  }
}

std::vector<Field> read_columns(const FileBytes& file, const VtpFile& vtp, const Execution& run) {
  std::vector<Field> columns;
  const VtpArray* points = vtp.array("Points", "");
  if (vtp.points == 0 || !points) refuse(file.path, "holds no point: there is nothing to measure");
  if (points->components != 3) refuse(file.path, "its points do not have three coordinates: save it again");
  add_columns(file, vtp, *points, {"x", "y", "z"}, columns, stage(run, 0.0, 0.2));
  for (std::size_t a = 0; a < vtp.arrays.size(); ++a) {
    const VtpArray& array = vtp.arrays[a];
    if (array.section != "PointData") continue;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < array.components; ++k) names.push_back(name_of_component(vtp, array, k));
    add_columns(file, vtp, array, names, columns, part(stage(run, 0.2, 1.0), a, vtp.arrays.size()));
  }
  return columns;
}

[[noreturn]] void refuse_face(const FileBytes& file, std::size_t face, const std::string& what) {
  refuse(file.path, "face " + std::to_string(face) + " " + what + ": the file is damaged");
}

/// Calls `take` with the corners of each cell of a section.
template <class Take>
void for_each_cell(const FileBytes& file, const VtpFile& vtp, const std::string& section, std::size_t cells,
                   const Execution& run, Take&& take) {
  if (cells == 0) return;
  const VtpArray* connectivity = vtp.array(section, "connectivity");
  const VtpArray* offsets = vtp.array(section, "offsets");
  if (!connectivity || !offsets) refuse(file.path, "its " + section + " lack connectivity or offsets: save it again");
  if (is_floating(connectivity->type) || is_floating(offsets->type)) {
    refuse(file.path, "its " + section + " are not made of integers: save it again");
  }
  const std::vector<double> indices = vtp_values(file, vtp, *connectivity, kAllValues, stage(run, 0.0, 0.5));
  const std::vector<double> ends = vtp_values(file, vtp, *offsets, cells, stage(run, 0.5, 0.7));
  std::vector<Index> corners;
  Pace pace(stage(run, 0.7, 1.0), cells, kRowsAtOnce);
  double begin = 0;
  for (std::size_t c = 0; c < cells; begin = ends[c++]) {
    pace.at(c);
    if (!(ends[c] >= begin && ends[c] <= static_cast<double>(indices.size()))) {
      refuse_face(file, c, "has offsets out of range");
    }
    corners.clear();
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(ends[c]); ++i) {
      if (!(indices[i] >= 0 && indices[i] < static_cast<double>(vtp.points))) {
        refuse_face(file, c,
                    "refers to point " + std::to_string(static_cast<long long>(indices[i])) + " of " +
                        std::to_string(vtp.points));
      }
      corners.push_back(static_cast<Index>(indices[i]));
    }
    if (corners.size() < 3) {
      refuse_face(file, c, "has " + std::to_string(corners.size()) + " corners in place of three or more");
    }
    take(corners);
  }
}

Faces read_faces(const FileBytes& file, const VtpFile& vtp, const Execution& run) {
  Faces faces;
  for_each_cell(file, vtp, "Polys", vtp.polys, stage(run, 0.0, 0.9),
                [&](const std::vector<Index>& corners) { faces.add(corners); });
  for_each_cell(file, vtp, "Strips", vtp.strips, stage(run, 0.9, 1.0), [&](const std::vector<Index>& strip) {
    for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
      const std::size_t odd = i % 2;  // every other triangle of a strip turns the other way
      faces.add(strip[i + odd], strip[i + 1 - odd], strip[i + 2]);
    }
  });
  return faces;
}

}  // namespace

Scan read_vtp(const FileBytes& file, const Execution& run) {
  const VtpFile vtp = parse_vtp(file, stage(run, 0.0, 0.1));
  std::vector<Field> columns = read_columns(file, vtp, stage(run, 0.1, 0.7));
  Scan scan = scan_from_columns(file.path, std::move(columns), stage(run, 0.7, 0.75));
  scan.faces = read_faces(file, vtp, stage(run, 0.75, 1.0));
  return scan;
}

}  // namespace kappa::io
