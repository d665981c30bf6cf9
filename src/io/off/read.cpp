// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

class OffReader {
 public:
  OffReader(const FileBytes& file, const Execution& run)
      : file_(file), lines_(file.bytes), pace_(run, file.bytes.size(), kBytesAtOnce) {}

  Scan read() {
    parse_keyword();
    parse_counts();
    for (std::size_t i = 0; i < vertex_count_; ++i) parse_vertex();
    for (std::size_t i = 0; i < face_count_; ++i) parse_face();
    if (next_content()) fail("follows the " + std::to_string(face_count_) + " faces of the header: correct the counts");
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

  /// Moves to the next line that is not blank or a comment.
  bool next_content() {
    while (lines_.next(rest_)) {
      pace_.at(lines_.position());
      rest_ = trimmed(rest_.substr(0, rest_.find('#')));
      if (!rest_.empty()) return true;
    }
    return false;
  }

  void require_content(const char* what) {
    if (!next_content()) refuse(file_.path, std::string("ends before its ") + what + ": it is cut off");
  }

  /// [ST][C][N][4][n]OFF, which may be missing, alone on its line or before the counts.
  void parse_keyword() {
    require_content("counts");
    std::string_view rest = rest_, word;
    next_word(rest, word);
    const std::size_t off = word.rfind("OFF");
    if (off == std::string_view::npos) return;
    std::string_view prefix = word.substr(0, off);
    if (prefix.substr(0, 2) == "ST") prefix.remove_prefix(2);
    has_colours_ = !prefix.empty() && prefix[0] == 'C';
    if (has_colours_) prefix.remove_prefix(1);
    has_normals_ = prefix == "N";
    if ((!prefix.empty() && !has_normals_) || off + 3 != word.size()) {
      fail("the OFF variant " + in_quotes(word) + " is not read: save it as plain OFF");
    }
    rest_ = trimmed(rest);
    if (rest_.substr(0, 6) == "BINARY") fail("binary OFF is not read: save it as plain OFF, PLY or STL");
    if (rest_.empty()) require_content("counts");
  }

  std::size_t parse_count(std::string_view& rest, const char* what) {
    std::string_view word;
    std::int64_t count = 0;
    if (!next_word(rest, word) || !parse_integer(word, count) || count < 0) {
      fail(std::string("must begin with the numbers of vertices and faces, but the number of ") + what + " is " +
           in_quotes(word) + ": correct the header, or this is not an OFF file");
    }
    // A vertex takes six bytes at least ("0 0 0" and its end), a face eight.
    if (static_cast<std::size_t>(count) > file_.bytes.size() / 6 + 1) {
      fail("promises " + std::to_string(count) + " " + what + ", more than the " + std::to_string(file_.bytes.size()) +
           " bytes of the file can hold: it is cut off");
    }
    return static_cast<std::size_t>(count);
  }

  void parse_counts() {
    std::string_view rest = rest_;
    vertex_count_ = parse_count(rest, "vertices");
    face_count_ = parse_count(rest, "faces");
    check_count(file_.path, vertex_count_);
  }

  void parse_vertex() {
    require_content("last vertex");
    double v[9];
    const std::size_t wanted = 3 + (has_normals_ ? 3 : 0) + (has_colours_ ? 3 : 0);
    std::string_view word;
    for (std::size_t k = 0; k < wanted; ++k) {
      if (!next_word(rest_, word)) fail("a vertex has fewer than " + std::to_string(wanted) + " numbers");
      if (!parse_number(word, v[k])) fail(in_quotes(word) + " is not a number: correct the vertex");
    }
    scan_.points.emplace_back(v[0], v[1], v[2]);
    if (has_normals_) scan_.normals.emplace_back(v[3], v[4], v[5]);
    if (has_colours_) add_colour(v + wanted - 3);
  }

  void add_colour(const double* rgb) {
    const char* const names[] = {"red", "green", "blue"};
    scan_.fields.resize(3);
    for (std::size_t k = 0; k < 3; ++k) {
      scan_.fields[k].name = names[k];
      scan_.fields[k].values.push_back(rgb[k]);
    }
  }

  void parse_face() {
    require_content("last face");
    std::string_view word;
    std::int64_t size = 0;
    if (!next_word(rest_, word) || !parse_integer(word, size) || size < 3) {
      fail("a face begins with " + in_quotes(word) + " in place of its number of corners, three or more");
    }
    corners_.clear();
    for (std::int64_t k = 0; k < size; ++k) corners_.push_back(parse_corner());
    scan_.faces.add(corners_);
  }

  Index parse_corner() {
    std::string_view word;
    std::int64_t index = 0;
    if (!next_word(rest_, word)) fail("a face has fewer corners than it says: correct the face");
    if (!parse_integer(word, index)) fail(in_quotes(word) + " is not an index: correct the face");
    if (index < 0 || index >= static_cast<std::int64_t>(vertex_count_)) {
      fail("a face refers to vertex " + std::to_string(index) + " of " + std::to_string(vertex_count_) +
           " (counted from 0): correct the face");
    }
    return static_cast<Index>(index);
  }

  const FileBytes& file_;
  LineReader lines_;
  Pace pace_;
  std::string_view rest_;  ///< what is left of the line being read
  bool has_normals_ = false, has_colours_ = false;
  std::size_t vertex_count_ = 0, face_count_ = 0;
  std::vector<Index> corners_;
  Scan scan_;
};

}  // namespace

Scan read_off(const FileBytes& file, const Execution& run) {
  return OffReader(file, run).read();
}

}  // namespace kappa::io
