// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <algorithm>
#include <cmath>

#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/scalar.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

bool is_comment(std::string_view line) {
  return line[0] == '#' || line.substr(0, 2) == "//";
}

std::string_view without_quotes(std::string_view word) {
  const bool is_quoted = word.size() >= 2 && word.front() == '"' && word.back() == '"';
  return is_quoted ? word.substr(1, word.size() - 2) : word;
}

class TextReader {
 public:
  TextReader(const FileBytes& file, const Execution& run)
      : file_(file), lines_(file.bytes), pace_(run, file.bytes.size(), kBytesAtOnce) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (file.from(0).substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      lines_ = LineReader(file.from(kByteOrderMark.size()));
    }
  }

  /// The columns, without a name if the file has no header line.
  std::vector<Field> read() {
    std::string_view line;
    if (!next_content(line)) refuse(file_.path, "holds no point: there is nothing to measure");
    begin(line);
    while (next_content(line)) parse_row(line);
    check_promise();
    return std::move(columns_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

  bool next_content(std::string_view& line) {
    while (lines_.next(line)) {
      pace_.at(lines_.position());
      line = trimmed(line);
      if (!line.empty() && !is_comment(line)) return true;
    }
    return false;
  }

  /// The first line is a header, a lone number of points, or a point.
  void begin(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::string_view rest = line, word; next_field(rest, word);) words.push_back(word);
    double value = 0;
    if (!std::all_of(words.begin(), words.end(), [&](std::string_view w) { return parse_number(w, value); })) {
      for (const std::string_view word : words) add_named(without_quotes(word));
      return;
    }
    if (words.size() == 1) {
      if (!parse_integer(words[0], promised_)) fail("has one number in place of x, y and z: correct the line");
      has_promise_ = true;
      if (!next_content(line)) refuse(file_.path, "ends after the number of its points: it is cut off");
      return begin_row(line);
    }
    begin_row(line);
  }

  void add_named(std::string_view name) {
    columns_.emplace_back();
    columns_.back().name = name.empty() ? "column_" + std::to_string(columns_.size()) : std::string(name);
  }

  /// Lets the first row fix the number of columns.
  void begin_row(std::string_view line) {
    for (std::string_view rest = line, word; next_field(rest, word);) columns_.emplace_back();
    if (columns_.size() < 3) {
      fail("has " + std::to_string(columns_.size()) + " columns in place of x, y, z or more: correct the line");
    }
    parse_row(line);
  }

  void parse_row(std::string_view line) {
    std::size_t found = 0;
    for (std::string_view rest = line, word; next_field(rest, word); ++found) {
      if (found >= columns_.size()) continue;
      double value = 0;
      if (!parse_number(word, value)) fail_at(line, word);
      columns_[found].values.push_back(value);
    }
    const bool is_first = columns_[0].values.size() == 1;
    if (is_first || found != columns_.size()) check_separators(line);
    if (found != columns_.size()) {
      fail("has " + std::to_string(found) + " columns where those above have " + std::to_string(columns_.size()) +
           ": correct the line");
    }
  }

  [[noreturn]] void fail_at(std::string_view line, std::string_view word) const {
    check_separators(line);
    fail(in_quotes(word) + " is not a number: correct the line");
  }

  /// Decimal commas would be taken for separators.
  void check_separators(std::string_view line) const {
    if (line.find(';') == line.npos || line.find(',') == line.npos) return;
    fail("has both commas and semicolons: write decimal points, and one kind of separator");
  }

  void check_promise() const {
    const std::size_t points = columns_[0].values.size();
    if (!has_promise_ || promised_ == static_cast<std::int64_t>(points)) return;
    refuse(file_.path, "promises " + std::to_string(promised_) + " points on its first line but holds " +
                           std::to_string(points) + ": it is cut off, or correct the number");
  }

  const FileBytes& file_;
  LineReader lines_;
  Pace pace_;
  std::vector<Field> columns_;
  std::int64_t promised_ = 0;
  bool has_promise_ = false;
};

/// Whether the last three of six columns are 8-bit colours: integers up to 255, of which some exceed 1.
bool are_colours(const std::vector<Field>& columns, const Execution& run) {
  bool above_one = false;
  for (std::size_t k = 3; k < 6; ++k) {
    const std::vector<double>& values = columns[k].values;
    const bool some_do_not_fit = any_row(values.size(), run, [&](std::size_t i) {
      above_one = above_one || values[i] > 1;
      return !fits(values[i], Field::Type::UInt8);
    });
    if (some_do_not_fit) return false;
  }
  return above_one;
}

/// Columns of a file without header: x y z, then normals or colours if there are six, else numbers of columns.
void name_columns(std::vector<Field>& columns, const Execution& run) {
  static const char* const kPosition[] = {"x", "y", "z"};
  static const char* const kNormal[] = {"nx", "ny", "nz"};
  static const char* const kColour[] = {"red", "green", "blue"};
  const bool six = columns.size() == 6;
  const bool colours = six && are_colours(columns, run);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k < 3) {
      columns[k].name = kPosition[k];
    } else if (six) {
      columns[k].name = colours ? kColour[k - 3] : kNormal[k - 3];
      if (colours) columns[k].type = Field::Type::UInt8;
    } else {
      columns[k].name = "column_" + std::to_string(k + 1);
    }
  }
}

/// Gives the fields that kappa writes back the types they were written with.
void restore_types(std::vector<Field>& columns, const Execution& run) {
  const auto begins = [](const std::string& name, const char* stem) {
    const std::string_view text(stem);
    return name == text || name.compare(0, text.size() + 2, std::string(text) + "_r") == 0;
  };
  for (Field& column : columns) {
    const bool small = begins(column.name, "status") || begins(column.name, "label");
    const bool large = begins(column.name, "face_count") || begins(column.name, "region");
    if (!small && !large) continue;
    const Field::Type type = small ? Field::Type::UInt8 : Field::Type::UInt32;
    const std::vector<double>& values = column.values;
    if (!any_row(values.size(), run, [&](std::size_t i) { return !fits(values[i], type); })) column.type = type;
  }
}

}  // namespace

Scan read_text(const FileBytes& file, const Execution& run) {
  std::vector<Field> columns = TextReader(file, stage(run, 0.0, 0.9)).read();
  check_count(file.path, columns[0].values.size());
  if (columns[0].name.empty()) name_columns(columns, silent(run));
  restore_types(columns, silent(run));
  return scan_from_columns(file.path, std::move(columns), stage(run, 0.9, 1.0));
}

}  // namespace kappa::io
