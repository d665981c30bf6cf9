// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <cmath>
#include <cstring>

#include "header.hpp"
#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"
#include "lzf.hpp"

namespace kappa::io {

namespace {

/// A value of each point, and where it stands in a row.
struct PcdColumn {
  Field field;
  Scalar type = Scalar::Float32;
  std::size_t position = 0;  ///< among the values of a point
  std::size_t offset = 0;    ///< of its bytes in a point
};

bool is_padding(const PcdField& field) {
  return field.name == "_";
}

std::vector<PcdColumn> columns_of(const PcdHeader& header) {
  std::vector<PcdColumn> columns;
  std::size_t position = 0, offset = 0;
  for (const PcdField& field : header.fields) {
    for (std::size_t i = 0; i < field.count; ++i) {
      PcdColumn column;
      column.field.name = field.count == 1 ? field.name : field.name + "_" + std::to_string(i);
      column.field.type = field_type(field.type);
      column.type = field.type;
      column.position = position++;
      column.offset = offset;
      offset += size_of(field.type);
      if (!is_padding(field)) columns.push_back(std::move(column));
    }
  }
  return columns;
}

void reserve(std::vector<PcdColumn>& columns, std::size_t points) {
  for (PcdColumn& column : columns) column.field.values.reserve(points);
}

/// PCL packs the bytes of a colour in a float: as a number it is of no use, and copying it as one may lose it.
void unpack_colour(Field& field, const Execution& run) {
  if ((field.name != "rgb" && field.name != "rgba") || field.type != Field::Type::Float32) return;
  for_each_row(field.values.size(), run, [&](std::size_t i) {
    const float packed = static_cast<float>(field.values[i]);
    std::uint32_t bits;
    std::memcpy(&bits, &packed, sizeof bits);
    field.values[i] = bits;
  });
  field.type = Field::Type::UInt32;
}

void parse_row(const FileBytes& file, const PcdHeader& header, LineReader& lines, std::vector<double>& row) {
  std::string_view line, word;
  do {
    if (!lines.next(line)) {
      refuse(file.path, "ends before its " + std::to_string(header.points()) + " points: it is cut off");
    }
  } while (trimmed(line).empty());
  std::size_t found = 0;
  for (std::string_view rest = line; next_field(rest, word); ++found) {
    if (found < row.size() && !parse_number(word, row[found])) {
      refuse_line(file.path, lines.number(), in_quotes(word) + " is not a number: correct the line");
    }
  }
  if (found != row.size()) {
    refuse_line(
        file.path, lines.number(),
        "has " + std::to_string(found) + " values in place of " + std::to_string(row.size()) + ": correct the line");
  }
}

void read_ascii(const FileBytes& file, const PcdHeader& header, std::vector<PcdColumn>& columns, const Execution& run) {
  reserve(columns, header.points());
  LineReader lines(file.from(header.offset), header.lines);
  Pace pace(run, lines.remaining(), kBytesAtOnce);
  std::vector<double> row(header.values_per_point());
  for (std::size_t i = 0; i < header.points(); ++i) {
    parse_row(file, header, lines, row);
    pace.at(lines.position());
    for (PcdColumn& column : columns) {
      const double value = row[column.position];
      if (!fits(value, column.field.type)) {
        refuse_line(file.path, lines.number(),
                    "a value of " + in_quotes(column.field.name) + " is not of type " + type_name(column.field.type) +
                        ": correct the line or the header");
      }
      column.field.values.push_back(value);
    }
  }
  for (std::string_view line; lines.next(line);) {
    if (trimmed(line).empty()) continue;
    refuse_line(file.path, lines.number(),
                "follows the " + std::to_string(header.points()) + " points of the header: correct WIDTH and POINTS");
  }
}

void read_binary(const FileBytes& file, const PcdHeader& header, std::vector<PcdColumn>& columns,
                 const Execution& run) {
  const std::size_t stride = header.bytes_per_point();
  const char* data = file.bytes.data() + header.offset;
  reserve(columns, header.points());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    PcdColumn& column = columns[c];
    for_each_row(header.points(), part(run, c, columns.size()), [&](std::size_t i) {
      column.field.values.push_back(load(data + i * stride + column.offset, column.type, ByteOrder::Little));
    });
  }
}

/// The expanded data: all values of the first field, then all of the second, and so on.
std::string expand(const FileBytes& file, const PcdHeader& header, const Execution& run) {
  const std::string_view data = file.from(header.offset);
  if (data.size() < 8) refuse(file.path, "ends before its compressed data: it is cut off");
  const auto stored = static_cast<std::size_t>(load(data.data(), Scalar::UInt32, ByteOrder::Little));
  const auto expanded = static_cast<std::size_t>(load(data.data() + 4, Scalar::UInt32, ByteOrder::Little));
  if (stored > data.size() - 8) {
    refuse(file.path, "promises " + std::to_string(stored) + " compressed bytes but holds " +
                          std::to_string(data.size() - 8) + ": it is cut off");
  }
  const std::size_t needed = header.points() * header.bytes_per_point();
  std::string out;
  if (expanded != needed || expanded / kLzfLargestRatio > stored ||
      !expand_lzf(data.substr(8, stored), expanded, out, run)) {
    refuse(file.path, "its compressed data do not expand to the " + std::to_string(needed) +
                          " bytes of its points: the file is damaged");
  }
  return out;
}

void read_compressed(const FileBytes& file, const PcdHeader& header, std::vector<PcdColumn>& columns,
                     const Execution& run) {
  const std::string data = expand(file, header, stage(run, 0.0, 0.5));
  const Execution rest = stage(run, 0.5, 1.0);
  reserve(columns, header.points());
  auto column = columns.begin();
  std::size_t begin = 0;
  for (const PcdField& field : header.fields) {
    const std::size_t size = size_of(field.type);
    for (std::size_t k = 0; k < field.count && !is_padding(field); ++k, ++column) {
      const auto number = static_cast<std::size_t>(column - columns.begin());
      for_each_row(header.points(), part(rest, number, columns.size()), [&](std::size_t i) {
        const char* value = data.data() + begin + (i * field.count + k) * size;
        column->field.values.push_back(load(value, field.type, ByteOrder::Little));
      });
    }
    begin += header.points() * field.count * size;
  }
}

/// Refuses what the file cannot hold, before anything is allocated for it.
void check_size(const FileBytes& file, const PcdHeader& header) {
  const std::size_t remaining = file.bytes.size() - header.offset;
  if (header.data == PcdData::Compressed) return;
  const bool ascii = header.data == PcdData::Ascii;
  const std::size_t per_point = ascii ? 2 * header.values_per_point() : header.bytes_per_point();
  const std::size_t needed = header.points() * per_point - (ascii && header.points() ? 1 : 0);
  if (remaining < needed) {
    refuse(file.path, "promises " + std::to_string(header.points()) + " points (at least " + std::to_string(needed) +
                          " bytes) but holds " + std::to_string(remaining) + " bytes of data: it is cut off");
  }
}

}  // namespace

Scan read_pcd(const FileBytes& file, const Execution& run) {
  const PcdHeader header = parse_pcd_header(file);
  check_size(file, header);
  std::vector<PcdColumn> columns = columns_of(header);
  const Execution data = stage(run, 0.0, 0.9);
  switch (header.data) {
    case PcdData::Ascii:
      read_ascii(file, header, columns, data);
      break;
    case PcdData::Binary:
      read_binary(file, header, columns, data);
      break;
    case PcdData::Compressed:
      read_compressed(file, header, columns, data);
      break;
  }
  std::vector<Field> fields;
  for (PcdColumn& column : columns) {
    unpack_colour(column.field, silent(run));
    fields.push_back(std::move(column.field));
  }
  Scan scan = scan_from_columns(file.path, std::move(fields), stage(run, 0.9, 1.0));
  scan.width = header.width;
  scan.height = header.height;
  scan.viewpoint = header.viewpoint;
  return scan;
}

}  // namespace kappa::io
