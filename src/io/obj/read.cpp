// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <algorithm>

#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

/// Greatest index used so far, 1-based, and where: OBJ allows an index before what it refers to.
struct LargestIndex {
  std::int64_t value = 0;
  std::size_t line = 0;
  void note(std::int64_t index, std::size_t at) {
    if (index > value) *this = {index, at};
  }
};

constexpr Index kNoNormal = kNoIndex;

class ObjReader {
 public:
  ObjReader(const FileBytes& file, const Execution& run) : file_(file), run_(run), lines_(file.bytes) {}

  Scan read() {
    Pace pace(stage(run_, 0.0, 0.9), file_.bytes.size(), kBytesAtOnce);
    for (std::string_view line; lines_.next(line);) {
      parse(join_continued(line));
      pace.at(lines_.position());
    }
    check_largest(largest_vertex_, scan_.points.size(), "vertex");
    check_largest(largest_normal_, normals_.size(), "normal");
    check_count(file_.path, scan_.points.size());
    add_colours();
    add_normals();
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

  /// The line with those after it, as long as they end with a backslash.
  std::string_view join_continued(std::string_view line) {
    if (line.empty() || line.back() != '\\') return line;
    joined_.clear();
    while (!line.empty() && line.back() == '\\') {
      joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
      line = {};
      lines_.next(line);
    }
    joined_.append(line);
    return joined_;
  }

  void parse(std::string_view line) {
    line = line.substr(0, line.find('#'));
    std::string_view key;
    if (!next_word(line, key)) return;
    if (key == "v") {
      parse_vertex(line);
    } else if (key == "vn") {
      if (parse_numbers(line) != 3) fail("a normal must have three numbers: correct the line");
      normals_.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
    } else if (key == "f" || key == "fo") {
      parse_face(line);
    }
  }

  std::size_t parse_numbers(std::string_view rest) {
    numbers_.clear();
    for (std::string_view word; next_word(rest, word);) {
      double value = 0;
      if (!parse_number(word, value)) fail(in_quotes(word) + " is not a number: correct the line");
      numbers_.push_back(value);
    }
    return numbers_.size();
  }

  void parse_vertex(std::string_view rest) {
    const std::size_t count = parse_numbers(rest);
    if (count < 3 || count == 5) {
      fail("a vertex has " + std::to_string(count) + " numbers in place of 3, 4 (weight) or 6 (colour)");
    }
    scan_.points.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
    if (count >= 6) colours_.emplace_back(numbers_[3], numbers_[4], numbers_[5]);
  }

  /// One index of a corner, resolved to start from 0.
  Index parse_index(std::string_view word, std::size_t count, const char* kind, LargestIndex& largest) const {
    std::int64_t index = 0;
    if (!parse_integer(word, index)) fail(in_quotes(word) + " is not an index: correct the face");
    if (index == 0) fail(std::string("refers to ") + kind + " 0, but OBJ counts from 1: correct the face");
    if (index < 0) {
      if (-(index + 1) >= static_cast<std::int64_t>(count)) {
        fail(std::string("refers to ") + kind + " " + std::to_string(index) + " when there are only " +
             std::to_string(count) + ": correct the face");
      }
      return static_cast<Index>(static_cast<std::int64_t>(count) + index);
    }
    largest.note(index, lines_.number());
    return static_cast<Index>(std::min<std::int64_t>(index - 1, kNoIndex - 1));
  }

  /// "v", "v/t", "v//n" or "v/t/n".
  void parse_corner(std::string_view word) {
    const std::size_t first = word.find('/');
    corners_.push_back(parse_index(word.substr(0, first), scan_.points.size(), "vertex", largest_vertex_));
    const std::size_t second = first == std::string_view::npos ? first : word.find('/', first + 1);
    const bool has_normal = second != std::string_view::npos && second + 1 < word.size();
    corner_normals_.push_back(
        has_normal ? parse_index(word.substr(second + 1), normals_.size(), "normal", largest_normal_) : kNoNormal);
  }

  void parse_face(std::string_view rest) {
    corners_.clear();
    for (std::string_view word; next_word(rest, word);) parse_corner(word);
    if (corners_.size() < 3) {
      fail("a face has " + std::to_string(corners_.size()) + " corners in place of three or more: remove it");
    }
    scan_.faces.add(corners_);
  }

  void check_largest(const LargestIndex& largest, std::size_t count, const char* kind) const {
    if (largest.value <= static_cast<std::int64_t>(count)) return;
    refuse_line(file_.path, largest.line,
                std::string("refers to ") + kind + " " + std::to_string(largest.value) + " of " +
                    std::to_string(count) + ": correct the face");
  }

  void add_colours() {
    if (colours_.empty() || colours_.size() != scan_.points.size()) return;
    const char* const names[] = {"red", "green", "blue"};
    for (int k = 0; k < 3; ++k) {
      Field field;
      field.name = names[k];
      for (const Vec3& colour : colours_) field.values.push_back(colour[k]);
      scan_.fields.push_back(std::move(field));
    }
  }

  void add_normals() {
    if (scan_.faces.empty()) {
      if (normals_.size() == scan_.points.size()) scan_.normals = std::move(normals_);
      return;
    }
    const auto given = [](Index normal) { return normal != kNoNormal; };
    if (std::any_of(corner_normals_.begin(), corner_normals_.end(), given)) average_corners();
  }

  /// One normal a vertex: the only one of its corners as it is, else the sum of the distinct ones at unit length.
  void average_corners() {
    std::vector<std::pair<Index, Index>> pairs;  // vertex, normal
    const std::vector<Index>& vertices = scan_.faces.corners();
    for_each_row(vertices.size(), stage(run_, 0.9, 0.95), [&](std::size_t c) {
      if (corner_normals_[c] != kNoNormal) pairs.emplace_back(vertices[c], corner_normals_[c]);
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    scan_.normals.assign(scan_.points.size(), Vec3::Zero());
    std::vector<Vec3> distinct;
    Pace pace(stage(run_, 0.95, 1.0), pairs.size(), kRowsAtOnce);
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
      pace.at(begin);
      distinct.clear();
      for (; end < pairs.size() && pairs[end].first == pairs[begin].first; ++end) {
        const Vec3& normal = normals_[pairs[end].second];
        if (std::find(distinct.begin(), distinct.end(), normal) == distinct.end()) distinct.push_back(normal);
      }
      scan_.normals[pairs[begin].first] = common_normal(distinct);
    }
  }

  static Vec3 common_normal(const std::vector<Vec3>& distinct) {
    if (distinct.size() == 1) return distinct.front();
    Vec3 sum = Vec3::Zero();
    for (const Vec3& normal : distinct) sum += normal;
    const double length = sum.norm();
    return length > 0 ? Vec3(sum / length) : Vec3::Zero().eval();
  }

  const FileBytes& file_;
  const Execution& run_;
  LineReader lines_;
  std::string joined_;
  std::vector<double> numbers_;
  std::vector<Vec3> colours_, normals_;
  std::vector<Index> corners_;         ///< of the face being read
  std::vector<Index> corner_normals_;  ///< of all faces, parallel to Faces::corners()
  LargestIndex largest_vertex_, largest_normal_;
  Scan scan_;
};

}  // namespace

Scan read_obj(const FileBytes& file, const Execution& run) {
  return ObjReader(file, run).read();
}

}  // namespace kappa::io
