// SPDX-License-Identifier: BSD-3-Clause
#include "read.hpp"

#include <array>
#include <cstring>
#include <unordered_map>

#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/scalar.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50, kNormalBytes = 12;

struct VertexHash {
  std::size_t operator()(const std::array<double, 3>& x) const {
    std::uint64_t hash = 0;
    for (const double value : x) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Makes one vertex of all that are equal.
class VertexMerger {
 public:
  explicit VertexMerger(Scan& scan) : scan_(scan) {}

  Index add(double x, double y, double z) {
    const std::array<double, 3> key = {x + 0.0, y + 0.0, z + 0.0};  // -0 becomes 0
    const auto [found, is_new] = indices_.emplace(key, static_cast<Index>(scan_.points.size()));
    if (is_new) scan_.points.emplace_back(key[0], key[1], key[2]);
    return found->second;
  }

 private:
  Scan& scan_;
  std::unordered_map<std::array<double, 3>, Index, VertexHash> indices_;
};

std::size_t facet_count(const FileBytes& file) {
  return static_cast<std::size_t>(load(file.bytes.data() + kHeaderBytes - 4, Scalar::UInt32, ByteOrder::Little));
}

Scan read_binary(const FileBytes& file, const Execution& run) {
  const std::size_t count = facet_count(file);
  check_count(file.path, 3 * count);
  Scan scan;
  VertexMerger merger(scan);
  for_each_row(count, run, [&](std::size_t i) {
    const char* vertex = file.bytes.data() + kHeaderBytes + i * kFacetBytes + kNormalBytes;
    Index corners[3];
    for (Index& corner : corners) {
      double x[3];
      for (std::size_t k = 0; k < 3; ++k) x[k] = load(vertex + 4 * k, Scalar::Float32, ByteOrder::Little);
      corner = merger.add(x[0], x[1], x[2]);
      vertex += 12;
    }
    scan.faces.add(corners[0], corners[1], corners[2]);
  });
  return scan;
}

class AsciiStlReader {
 public:
  AsciiStlReader(const FileBytes& file, const Execution& run)
      : file_(file), lines_(file.bytes), pace_(run, file.bytes.size(), kBytesAtOnce), merger_(scan_) {}

  Scan read() {
    for (std::string_view line; lines_.next(line);) {
      parse(line);
      pace_.at(lines_.position());
    }
    if (open_facet_ || !closed_) refuse(file_.path, "ends before 'endsolid': it is cut off");
    check_count(file_.path, scan_.points.size());
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

  void parse(std::string_view rest) {
    std::string_view word;
    if (!next_word(rest, word)) return;
    const std::string key = lower(word);
    if (key == "vertex") {
      parse_vertex(rest);
    } else if (key == "facet") {
      if (open_facet_) fail("a facet begins before the one before it ends: correct the file");
      open_facet_ = true;
      corners_.clear();
    } else if (key == "endfacet") {
      end_facet();
    } else if (key == "solid" || key == "endsolid") {
      closed_ = key == "endsolid";
    } else if (key != "outer" && key != "endloop") {
      fail(in_quotes(word) + " is no word of an ascii STL file: correct the file");
    }
  }

  void parse_vertex(std::string_view rest) {
    if (!open_facet_) fail("a vertex stands outside of a facet: correct the file");
    double x[3];
    std::string_view word;
    for (double& value : x) {
      if (!next_word(rest, word)) fail("a vertex has fewer than three numbers: correct the line");
      if (!parse_number(word, value)) fail(in_quotes(word) + " is not a number: correct the line");
    }
    corners_.push_back(merger_.add(x[0], x[1], x[2]));
  }

  void end_facet() {
    if (!open_facet_ || corners_.size() != 3) {
      fail("a facet has " + std::to_string(corners_.size()) + " vertices in place of three: correct the file");
    }
    scan_.faces.add(corners_);
    open_facet_ = false;
  }

  const FileBytes& file_;
  LineReader lines_;
  Pace pace_;
  Scan scan_;
  VertexMerger merger_;
  std::vector<Index> corners_;
  bool open_facet_ = false, closed_ = false;
};

}  // namespace

Scan read_stl(const FileBytes& file, const Execution& run) {
  const std::size_t size = file.bytes.size();
  const bool has_header = size >= kHeaderBytes;
  // The size decides: many binary files begin with "solid" like an ascii one.
  if (has_header && size == kHeaderBytes + facet_count(file) * kFacetBytes) return read_binary(file, run);
  std::string_view rest = file.bytes, word;
  if (next_word(rest, word) && lower(word.substr(0, 5)) == "solid") return AsciiStlReader(file, run).read();
  if (!has_header) refuse(file.path, "is too short for an STL file: it is cut off or not an STL");
  refuse(file.path, "promises " + std::to_string(facet_count(file)) + " triangles (" +
                        std::to_string(kHeaderBytes + facet_count(file) * kFacetBytes) + " bytes) but has " +
                        std::to_string(size) + " bytes: it is cut off or not an STL");
}

}  // namespace kappa::io
