// SPDX-License-Identifier: BSD-3-Clause
#include "file.hpp"

#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"
#include "xml.hpp"

namespace kappa::io {

namespace {

/// Components of an array that are taken for real.
constexpr std::size_t kMaxComponents = 1 << 16;

bool scalar_from_name(const std::string& name, Scalar& type) {
  static const char* const kNames[] = {"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                       "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  for (std::size_t i = 0; i < std::size(kNames); ++i) {
    if (name != kNames[i]) continue;
    type = static_cast<Scalar>(i);
    return true;
  }
  return false;
}

class VtpParser {
 public:
  VtpParser(const FileBytes& file, const Execution& run)
      : file_(file), xml_(file.bytes), pace_(run, file.bytes.size(), kBytesAtOnce) {}

  VtpFile parse() {
    while (xml_.next(tag_)) {
      pace_.at(xml_.position());
      if (tag_.name == "AppendedData" && tag_.is_start) {
        parse_appended();
        break;
      }
      parse_element();
    }
    if (xml_.is_broken()) fail("its XML is broken near byte " + std::to_string(xml_.position()));
    if (!is_polydata_) fail("it is not a VTKFile of type PolyData");
    if (pieces_ != 1) fail("it has " + std::to_string(pieces_) + " pieces in place of one");
    return std::move(vtp_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    refuse(file_.path, "cannot be read as a VTP file: " + what + "; save it again");
  }

  void parse_element() {
    if (tag_.name == "VTKFile" && tag_.is_start) {
      parse_root();
    } else if (tag_.name == "Piece" && tag_.is_start) {
      parse_piece();
    } else if (tag_.name == "DataArray" && tag_.is_start) {
      parse_array();
    } else if (tag_.is_start && !tag_.is_end) {
      section_ = tag_.name;
      if (section_ == "PointData") vtp_.normals = tag_.attribute("Normals");
    }
  }

  void parse_root() {
    is_polydata_ = tag_.attribute("type") == "PolyData";
    vtp_.order = tag_.attribute("byte_order") == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
    const std::string header = tag_.attribute("header_type", "UInt32");
    if (!scalar_from_name(header, vtp_.header_type) || is_floating(vtp_.header_type)) {
      fail("its header_type is " + in_quotes(header));
    }
    const std::string compressor = tag_.attribute("compressor");
    vtp_.is_compressed = !compressor.empty();
    if (vtp_.is_compressed && compressor != "vtkZLibDataCompressor") {
      fail("its compression " + in_quotes(compressor) + " is not zlib");
    }
  }

  std::size_t integer(const std::string& key, const char* otherwise) const {
    const std::string word = tag_.attribute(key, otherwise);
    std::int64_t value = 0;
    if (!parse_integer(trimmed(word), value) || value < 0) fail(key + " is " + in_quotes(word));
    return static_cast<std::size_t>(value);
  }

  void parse_piece() {
    ++pieces_;
    vtp_.points = integer("NumberOfPoints", "0");
    vtp_.verts = integer("NumberOfVerts", "0");
    vtp_.strips = integer("NumberOfStrips", "0");
    vtp_.polys = integer("NumberOfPolys", "0");
    check_count(file_.path, vtp_.points);
    for (const std::size_t cells : {vtp_.strips, vtp_.polys}) check_count(file_.path, cells);
  }

  void parse_array() {
    VtpArray array;
    array.section = section_;
    array.name = tag_.attribute("Name");
    array.components = integer("NumberOfComponents", "1");
    if (array.components > kMaxComponents) fail(in_quotes(array.name) + " has too many components");
    const std::string format = tag_.attribute("format", "ascii");
    array.format = format == "appended" ? VtpFormat::Appended
                   : format == "binary" ? VtpFormat::Inline
                                        : VtpFormat::Ascii;
    array.offset = integer("offset", "0");
    const bool is_numeric = scalar_from_name(tag_.attribute("type"), array.type);
    if (!tag_.is_end) array.text = content_of_array();
    if (is_numeric) vtp_.arrays.push_back(std::move(array));
  }

  /// Text of the element just begun, without that of elements in it.
  std::string content_of_array() {
    std::string text;
    for (int depth = 0; depth >= 0;) {
      if (!xml_.next(tag_)) fail("an array has no end");
      if (depth == 0) text.append(xml_.text_before());
      depth += (tag_.is_start ? 1 : 0) - (tag_.is_end ? 1 : 0);
    }
    return text;
  }

  void parse_appended() {
    vtp_.appended_is_base64 = tag_.attribute("encoding", "raw") == "base64";
    const std::size_t begin = file_.bytes.find('_', xml_.position());
    if (begin != std::string::npos) vtp_.appended = file_.from(begin + 1);
  }

  const FileBytes& file_;
  XmlReader xml_;
  Pace pace_;
  XmlTag tag_;
  std::string section_;
  VtpFile vtp_;
  bool is_polydata_ = false;
  int pieces_ = 0;
};

}  // namespace

const VtpArray* VtpFile::array(const std::string& section, const std::string& name) const {
  for (const VtpArray& candidate : arrays) {
    if (candidate.section == section && (name.empty() || candidate.name == name)) return &candidate;
  }
  return nullptr;
}

VtpFile parse_vtp(const FileBytes& file, const Execution& run) {
  return VtpParser(file, run).parse();
}

}  // namespace kappa::io
