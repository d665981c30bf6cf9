// SPDX-License-Identifier: BSD-3-Clause
#include "header.hpp"

#include <map>

#include "io/columns.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

/// The most values that are taken for a point: far above any real one, and safe to multiply.
constexpr std::int64_t kMaxCount = 1 << 16;
constexpr std::int64_t kMaxPoints = kNoIndex - 1;

struct Entry {
  std::vector<std::string> words;
  std::size_t line = 0;
};
using Entries = std::map<std::string, Entry>;

bool is_keyword(const std::string& word) {
  for (const char* known :
       {"VERSION", "FIELDS", "COLUMNS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"}) {
    if (word == known) return true;
  }
  return false;
}

/// Reads the lines up to DATA.
Entries read_entries(const FileBytes& file, PcdHeader& header) {
  Entries entries;
  LineReader lines(file.bytes);
  for (std::string_view line; lines.next(line);) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    std::string key(words[0]);
    if (!is_keyword(key)) {
      refuse_line(file.path, lines.number(),
                  in_quotes(words[0]) +
                      " is no entry of a PCD header: give the file a header (FIELDS ... DATA), or if it "
                      "is plain x y z text the extension .xyz");
    }
    if (key == "COLUMNS") key = "FIELDS";
    const Entry entry{{words.begin() + 1, words.end()}, lines.number()};
    if (!entries.emplace(key, entry).second) refuse_line(file.path, lines.number(), key + " stands twice: remove one");
    if (key != "DATA") continue;
    header.lines = lines.number();
    header.offset = lines.position();
    return entries;
  }
  refuse(file.path, "its header has no DATA line: the file is cut off or not a PCD");
}

const Entry& required(const FileBytes& file, const Entries& entries, const std::string& key) {
  const auto found = entries.find(key);
  if (found == entries.end()) refuse(file.path, "its header has no " + key + " line: add it");
  return found->second;
}

std::int64_t integer(const FileBytes& file, const Entry& entry, std::size_t i, std::int64_t low, std::int64_t high) {
  std::int64_t value = 0;
  if (!parse_integer(entry.words[i], value) || value < low || value > high) {
    refuse_line(file.path, entry.line,
                in_quotes(entry.words[i]) + " is not an integer from " + std::to_string(low) + " to " +
                    std::to_string(high) + ": correct the header");
  }
  return value;
}

/// The entry with one word a field, or null if it is absent.
const Entry* per_field(const FileBytes& file, const Entries& entries, const std::string& key, std::size_t fields) {
  const auto found = entries.find(key);
  if (found == entries.end()) return nullptr;
  if (found->second.words.size() != fields) {
    refuse_line(file.path, found->second.line,
                key + " has " + std::to_string(found->second.words.size()) + " values for " + std::to_string(fields) +
                    " fields: correct the header");
  }
  return &found->second;
}

Scalar scalar_type(const FileBytes& file, std::size_t line, const std::string& letter, std::int64_t size) {
  if (letter == "F" && size == 4) return Scalar::Float32;
  if (letter == "F" && size == 8) return Scalar::Float64;
  if (letter == "I" && size == 1) return Scalar::Int8;
  if (letter == "I" && size == 2) return Scalar::Int16;
  if (letter == "I" && size == 4) return Scalar::Int32;
  if (letter == "I" && size == 8) return Scalar::Int64;
  if (letter == "U" && size == 1) return Scalar::UInt8;
  if (letter == "U" && size == 2) return Scalar::UInt16;
  if (letter == "U" && size == 4) return Scalar::UInt32;
  if (letter == "U" && size == 8) return Scalar::UInt64;
  refuse_line(file.path, line,
              "there is no type " + in_quotes(letter) + " of size " + std::to_string(size) +
                  ": use F (4, 8), I or U (1, 2, 4, 8)");
}

std::vector<PcdField> parse_fields(const FileBytes& file, const Entries& entries) {
  const Entry& names = required(file, entries, "FIELDS");
  if (names.words.empty()) refuse_line(file.path, names.line, "FIELDS names no field: correct the header");
  const Entry* sizes = per_field(file, entries, "SIZE", names.words.size());
  const Entry* types = per_field(file, entries, "TYPE", names.words.size());
  const Entry* counts = per_field(file, entries, "COUNT", names.words.size());
  std::vector<PcdField> fields;
  for (std::size_t i = 0; i < names.words.size(); ++i) {
    const std::int64_t size = sizes ? integer(file, *sizes, i, 1, 8) : 4;
    const std::size_t line = types ? types->line : names.line;
    const Scalar type = scalar_type(file, line, types ? types->words[i] : "F", size);
    const std::int64_t count = counts ? integer(file, *counts, i, 0, kMaxCount) : 1;
    fields.push_back({names.words[i], type, static_cast<std::size_t>(count)});
  }
  return fields;
}

std::size_t single(const FileBytes& file, const Entries& entries, const std::string& key, std::size_t otherwise) {
  const auto found = entries.find(key);
  if (found == entries.end()) return otherwise;
  if (found->second.words.size() != 1) {
    refuse_line(file.path, found->second.line, key + " must have one value: correct the header");
  }
  return static_cast<std::size_t>(integer(file, found->second, 0, 0, kMaxPoints));
}

void parse_extent(const FileBytes& file, const Entries& entries, PcdHeader& header) {
  if (!entries.count("WIDTH") && !entries.count("POINTS")) required(file, entries, "WIDTH");
  const std::size_t height = single(file, entries, "HEIGHT", 1);
  const std::size_t width = single(file, entries, "WIDTH", single(file, entries, "POINTS", 0));
  const std::size_t points = single(file, entries, "POINTS", width * height);
  if (width * height != points) {
    refuse(file.path, "its header promises " + std::to_string(points) + " points but a grid of " +
                          std::to_string(width) + " x " + std::to_string(height) + ": make WIDTH x HEIGHT = POINTS");
  }
  check_count(file.path, points);
  header.width = width;  // below 2^32, as is the height: their product fits
  header.height = height;
}

void parse_viewpoint(const FileBytes& file, const Entries& entries, PcdHeader& header) {
  const auto found = entries.find("VIEWPOINT");
  if (found == entries.end()) return;
  const Entry& entry = found->second;
  double v[7];
  bool sound = entry.words.size() == 7;
  for (std::size_t i = 0; sound && i < 7; ++i) sound = parse_number(entry.words[i], v[i]);
  if (!sound) refuse_line(file.path, entry.line, "VIEWPOINT must have seven numbers (tx ty tz qw qx qy qz)");
  header.viewpoint = Vec3(v[0], v[1], v[2]);
}

PcdData parse_encoding(const FileBytes& file, const Entry& entry) {
  const std::string word = entry.words.size() == 1 ? lower(entry.words[0]) : "";
  if (word == "ascii") return PcdData::Ascii;
  if (word == "binary") return PcdData::Binary;
  if (word == "binary_compressed") return PcdData::Compressed;
  refuse_line(file.path, entry.line,
              "DATA is " + in_quotes(entry.words.empty() ? "" : entry.words[0]) +
                  ", not 'ascii', 'binary' or 'binary_compressed' alone on its line: put a "
                  "line break where the data begins");
}

}  // namespace

std::size_t PcdHeader::values_per_point() const {
  std::size_t values = 0;
  for (const PcdField& field : fields) values += field.count;
  return values;
}

std::size_t PcdHeader::bytes_per_point() const {
  std::size_t bytes = 0;
  for (const PcdField& field : fields) bytes += field.count * size_of(field.type);
  return bytes;
}

PcdHeader parse_pcd_header(const FileBytes& file) {
  PcdHeader header;
  const Entries entries = read_entries(file, header);
  header.data = parse_encoding(file, entries.at("DATA"));
  header.fields = parse_fields(file, entries);
  if (header.values_per_point() > kMaxCount) {
    refuse(file.path, "its header promises more than " + std::to_string(kMaxCount) + " values a point: correct COUNT");
  }
  parse_extent(file, entries, header);
  parse_viewpoint(file, entries, header);
  return header;
}

}  // namespace kappa::io
