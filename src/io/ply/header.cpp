// SPDX-License-Identifier: BSD-3-Clause
#include "header.hpp"

#include "io/text.hpp"

namespace kappa::io {

namespace {

class HeaderParser {
 public:
  explicit HeaderParser(const FileBytes& file) : file_(file), lines_(file.bytes) {}

  PlyHeader parse() {
    std::string_view line;
    if (!lines_.next(line) || trimmed(line) != "ply") fail("must be 'ply': this is not a PLY file");
    while (lines_.next(line)) {
      if (!parse_line(words_of(line))) return finished();
    }
    refuse(file_.path, "its header has no end_header line: the file is cut off or not a PLY");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse_line(file_.path, lines_.number(), what); }

  /// False at the end of the header.
  bool parse_line(const std::vector<std::string_view>& words) {
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "end_header") return false;
    if (words[0] == "format") {
      parse_format(words);
    } else if (words[0] == "element") {
      parse_element(words);
    } else if (words[0] == "property") {
      parse_property(words);
    } else {
      fail(in_quotes(words[0]) + " is no entry of a PLY header: correct the header");
    }
    return true;
  }

  void parse_format(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() > 1 ? words[1] : std::string_view();
    if (name == "ascii") {
      header_.encoding = PlyEncoding::Ascii;
    } else if (name == "binary_little_endian") {
      header_.encoding = PlyEncoding::LittleEndian;
    } else if (name == "binary_big_endian") {
      header_.encoding = PlyEncoding::BigEndian;
    } else {
      fail("the format " + in_quotes(name) + " is not ascii, binary_little_endian or binary_big_endian");
    }
    has_format_ = true;
  }

  void parse_element(const std::vector<std::string_view>& words) {
    std::int64_t count = 0;
    if (words.size() != 3 || !parse_integer(words[2], count) || count < 0) {
      fail("must read 'element NAME COUNT' with a count that is not negative: correct the header");
    }
    const std::string name(words[1]);
    if (header_.element(name)) fail("the element " + in_quotes(name) + " stands twice: remove one");
    header_.elements.push_back({name, static_cast<std::size_t>(count), {}});
  }

  void parse_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty()) fail("has a property before any element: correct the header");
    PlyProperty property;
    if (words.size() == 3) {
      property.type = scalar(words[1]);
    } else if (words.size() == 5 && words[1] == "list") {
      property.is_list = true;
      property.count_type = scalar(words[2]);
      property.type = scalar(words[3]);
      if (is_floating(property.count_type)) fail("a list cannot have a length of type " + in_quotes(words[2]));
    } else {
      fail("must read 'property TYPE NAME' or 'property list TYPE TYPE NAME': correct the header");
    }
    property.name = words.back();
    header_.elements.back().properties.push_back(property);
  }

  Scalar scalar(std::string_view name) const {
    if (name == "char" || name == "int8") return Scalar::Int8;
    if (name == "uchar" || name == "uint8") return Scalar::UInt8;
    if (name == "short" || name == "int16") return Scalar::Int16;
    if (name == "ushort" || name == "uint16") return Scalar::UInt16;
    if (name == "int" || name == "int32") return Scalar::Int32;
    if (name == "uint" || name == "uint32") return Scalar::UInt32;
    if (name == "float" || name == "float32") return Scalar::Float32;
    if (name == "double" || name == "float64") return Scalar::Float64;
    fail("there is no PLY type " + in_quotes(name) + ": correct the header");
  }

  PlyHeader finished() {
    if (!has_format_) refuse(file_.path, "its header has no format line: add it");
    header_.lines = lines_.number();
    header_.offset = lines_.position();
    for (const PlyElement& element : header_.elements) check_count(element);
    return std::move(header_);
  }

  /// Refuses a count that the file has no room for, before anything is allocated for it.
  void check_count(const PlyElement& element) const {
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties) {
      const bool ascii = header_.encoding == PlyEncoding::Ascii;
      least += ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
    }
    const std::size_t remaining = file_.bytes.size() - header_.offset + 1;
    if (least > 0 && element.count > remaining / least) {
      refuse(file_.path, "promises " + std::to_string(element.count) + " elements " + in_quotes(element.name) +
                             ", more than its " + std::to_string(remaining - 1) +
                             " bytes of data can hold: it is "
                             "cut off");
    }
  }

  const FileBytes& file_;
  LineReader lines_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

const PlyElement* PlyHeader::element(const std::string& name) const {
  for (const PlyElement& candidate : elements) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

PlyHeader parse_ply_header(const FileBytes& file) {
  return HeaderParser(file).parse();
}

}  // namespace kappa::io
