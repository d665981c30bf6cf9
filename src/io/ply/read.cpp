// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include "header.hpp"
#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

/// Numbers of a binary body, one after the other.
class BinarySource {
 public:
  BinarySource(const FileBytes& file, const PlyHeader& header)
      : file_(file),
        rest_(file.from(header.offset)),
        order_(header.encoding == PlyEncoding::BigEndian ? ByteOrder::Big : ByteOrder::Little) {}

  void begin_row() {}
  void end_row() {}
  double number(Scalar type) {
    const std::size_t size = size_of(type);
    if (rest_.size() < size) refuse(file_.path, "ends in the middle of its data: it is cut off");
    const double value = load(rest_.data(), type, order_);
    rest_.remove_prefix(size);
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    refuse(file_.path, "at byte " + std::to_string(file_.bytes.size() - rest_.size()) + ", " + what);
  }

 private:
  const FileBytes& file_;
  std::string_view rest_;
  ByteOrder order_;
};

/// Numbers of an ascii body, which has one element a line.
class AsciiSource {
 public:
  AsciiSource(const FileBytes& file, const PlyHeader& header)
      : file_(file), lines_(file.from(header.offset), header.lines) {}

  void begin_row() {
    do {
      if (!lines_.next(rest_)) refuse(file_.path, "ends before its last element: it is cut off");
    } while (trimmed(rest_).empty());
  }
  void end_row() {
    if (!trimmed(rest_).empty()) fail("holds more values than the header says: correct the line");
  }
  double number(Scalar type) {
    std::string_view word;
    double value = 0;
    if (!next_word(rest_, word)) fail("holds fewer values than the header says: correct the line");
    if (!parse_number(word, value)) fail(in_quotes(word) + " is not a number: correct the line");
    if (!is_floating(type) && !fits(value, field_type(type))) {
      fail(in_quotes(word) + " is not of the type that the header says: correct the line");
    }
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

 private:
  const FileBytes& file_;
  LineReader lines_;
  std::string_view rest_;
};

bool is_corner_list(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// Reads a list; each item goes to `take`.
template <class Source, class Take>
void read_list(Source& source, const PlyProperty& property, Take&& take) {
  const double length = source.number(property.count_type);
  if (length < 0) source.fail("a list has a negative length: correct the file");
  for (double i = 0; i < length; ++i) take(source.number(property.type));
}

template <class Source>
void skip(Source& source, const PlyProperty& property) {
  if (property.is_list) {
    read_list(source, property, [](double) {});
  } else {
    source.number(property.type);
  }
}

template <class Source>
void skip_element(Source& source, const PlyElement& element, const Execution& run) {
  for_each_row(element.count, run, [&](std::size_t) {
    source.begin_row();
    for (const PlyProperty& property : element.properties) skip(source, property);
    source.end_row();
  });
}

template <class Source>
std::vector<Field> read_vertices(Source& source, const PlyElement& element, const Execution& run) {
  std::vector<Field> columns(element.properties.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k].name = element.properties[k].name;
    columns[k].type = field_type(element.properties[k].type);
    columns[k].values.reserve(element.properties[k].is_list ? 0 : element.count);
  }
  for_each_row(element.count, run, [&](std::size_t) {
    source.begin_row();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (element.properties[k].is_list) {
        skip(source, element.properties[k]);
      } else {
        columns[k].values.push_back(source.number(element.properties[k].type));
      }
    }
    source.end_row();
  });
  std::vector<Field> scalars;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!element.properties[k].is_list) scalars.push_back(std::move(columns[k]));
  }
  return scalars;
}

template <class Source>
void read_corners(Source& source, const PlyProperty& property, std::size_t vertices, std::vector<Index>& corners) {
  corners.clear();
  read_list(source, property, [&](double index) {
    if (!(index >= 0 && index < static_cast<double>(vertices))) {
      source.fail("a face refers to vertex " + std::to_string(static_cast<long long>(index)) + " of " +
                  std::to_string(vertices) + " (counted from 0): correct the face");
    }
    corners.push_back(static_cast<Index>(index));
  });
  if (corners.size() < 3) {
    source.fail("a face has " + std::to_string(corners.size()) + " corners in place of three or more: remove it");
  }
}

template <class Source>
Faces read_faces(Source& source, const PlyElement& element, std::size_t vertices, const Execution& run) {
  Faces faces;
  std::vector<Index> corners;
  for_each_row(element.count, run, [&](std::size_t) {
    source.begin_row();
    for (const PlyProperty& property : element.properties) {
      if (is_corner_list(property)) {
        read_corners(source, property, vertices, corners);
        faces.add(corners);
      } else {
        skip(source, property);
      }
    }
    source.end_row();
  });
  return faces;
}

template <class Source>
Scan read_body(const FileBytes& file, const PlyHeader& header, Source source, const Execution& run) {
  std::vector<Field> columns;
  Faces faces;
  for (std::size_t k = 0; k < header.elements.size(); ++k) {
    const PlyElement& element = header.elements[k];
    const Execution element_run = part(stage(run, 0.0, 0.9), k, header.elements.size());
    if (element.properties.empty()) continue;
    if (element.name == "vertex") {
      columns = read_vertices(source, element, element_run);
    } else if (element.name == "face") {
      faces = read_faces(source, element, header.element("vertex")->count, element_run);
    } else {
      skip_element(source, element, element_run);
    }
  }
  Scan scan = scan_from_columns(file.path, std::move(columns), stage(run, 0.9, 1.0));
  scan.faces = std::move(faces);
  return scan;
}

/// Refuses what a body cannot make up for.
void check_elements(const FileBytes& file, const PlyHeader& header) {
  const PlyElement* vertex = header.element("vertex");
  if (!vertex) refuse(file.path, "has no element vertex: there is nothing to measure");
  check_count(file.path, vertex->count);
  const PlyElement* face = header.element("face");
  std::size_t lists = 0;
  for (std::size_t k = 0; face && k < face->properties.size(); ++k) {
    const PlyProperty& property = face->properties[k];
    if (!is_corner_list(property)) continue;
    if (is_floating(property.type)) refuse(file.path, "its vertex indices are not integers: correct the header");
    ++lists;
  }
  if (face && face->count > 0 && lists != 1) {
    refuse(file.path, "its faces have " + std::to_string(lists) + " lists vertex_indices in place of one");
  }
  const PlyElement* strips = header.element("tristrips");
  if (strips && strips->count > 0) {
    refuse(file.path, "triangle strips are not read: save it with single faces");
  }
}

}  // namespace

Scan read_ply(const FileBytes& file, const Execution& run) {
  const PlyHeader header = parse_ply_header(file);
  check_elements(file, header);
  if (header.encoding == PlyEncoding::Ascii) return read_body(file, header, AsciiSource(file, header), run);
  return read_body(file, header, BinarySource(file, header), run);
}

}  // namespace kappa::io
