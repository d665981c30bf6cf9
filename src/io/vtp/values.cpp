// SPDX-License-Identifier: BSD-3-Clause
#include "values.hpp"

#include <zlib.h>

#include "io/pace.hpp"
#include "io/text.hpp"

namespace kappa::io {

namespace {

/// zlib expands a byte to 1032 at most.
constexpr std::size_t kZlibLargestRatio = 1032;

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : (c == '/' ? 63 : -1);
}

/// Bytes that stand in a text as they are or in base64, of which padding may stand between two parts.
class ByteSource {
 public:
  ByteSource(std::string_view text, bool is_base64, const Execution& run)
      : text_(text), is_base64_(is_base64), size_(text.size()), pace_(run, text.size(), kBytesAtOnce) {}

  /// No more bytes than that can come.
  std::size_t limit() const { return is_base64_ ? text_.size() / 4 * 3 + pending_.size() : text_.size(); }

  bool take(std::size_t count, std::string& bytes) {
    if (count > limit()) return false;
    pace_.at(size_ - text_.size());
    if (!is_base64_) {
      bytes.assign(text_.substr(0, count));
      text_.remove_prefix(count);
      return true;
    }
    while (pending_.size() < count) {
      if (!decode_quad()) return false;
      pace_.at(size_ - text_.size());
    }
    bytes.assign(pending_, 0, count);
    pending_.erase(0, count);
    return true;
  }

 private:
  bool decode_quad() {
    if (text_.size() < 4) return false;
    unsigned bits = 0, digits = 0;
    for (const char c : text_.substr(0, 4)) {
      const int digit = base64_digit(c);
      if (digit < 0 && c != '=') return false;
      bits = (bits << 6) | static_cast<unsigned>(digit < 0 ? 0 : digit);
      digits += digit < 0 ? 0 : 1;
    }
    for (unsigned k = 0; k + 1 < digits; ++k) pending_.push_back(static_cast<char>((bits >> (16 - 8 * k)) & 0xff));
    text_.remove_prefix(4);
    return digits >= 2;
  }

  std::string_view text_;  ///< what is left of it
  bool is_base64_;
  std::size_t size_;  ///< of the whole text
  Pace pace_;
  std::string pending_;
};

/// Reads the bytes of one array.
class ArrayReader {
 public:
  ArrayReader(const VtpFile& vtp, ByteSource source) : vtp_(vtp), source_(std::move(source)) {}

  /// Fails unless the size agrees with `expected` (any, for kAllValues).
  bool read(std::size_t expected, std::string& bytes) {
    return vtp_.is_compressed ? read_compressed(expected, bytes) : read_plain(expected, bytes);
  }

 private:
  bool take_word(std::size_t& word) {
    std::string bytes;
    if (!source_.take(size_of(vtp_.header_type), bytes)) return false;
    const double value = load(bytes.data(), vtp_.header_type, vtp_.order);
    if (!(value >= 0 && value < 0x1p52)) return false;
    word = static_cast<std::size_t>(value);
    return true;
  }

  bool read_plain(std::size_t expected, std::string& bytes) {
    std::size_t size = 0;
    return take_word(size) && (expected == kAllValues || size == expected) && source_.take(size, bytes);
  }

  /// Header: number of blocks, size of a block, size of the last one if it is partial, compressed sizes.
  bool read_compressed(std::size_t expected, std::string& bytes) {
    std::size_t blocks = 0, size = 0, last = 0;
    if (!take_word(blocks) || !take_word(size) || !take_word(last) || last > size) return false;
    const std::size_t most = kZlibLargestRatio * source_.limit();
    if (blocks > source_.limit() || size > most || (size > 0 && blocks > most / size + 1)) return false;
    std::vector<std::size_t> stored(blocks);
    for (std::size_t& block : stored) {
      if (!take_word(block)) return false;
    }
    const std::size_t total = blocks == 0 ? 0 : (blocks - 1) * size + (last ? last : size);
    if (expected != kAllValues && total != expected) return false;
    bytes.resize(total);
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t block_size = b + 1 == blocks && last ? last : size;
      if (!expand(stored[b], bytes.data() + b * size, block_size)) return false;
    }
    return true;
  }

  bool expand(std::size_t stored, char* out, std::size_t size) {
    std::string block;
    if (!source_.take(stored, block)) return false;
    uLongf expanded = size;
    const int result = ::uncompress(reinterpret_cast<Bytef*>(out), &expanded,
                                    reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
    return result == Z_OK && expanded == size;
  }

  const VtpFile& vtp_;
  ByteSource source_;
};

bool parse_ascii(const VtpArray& array, std::size_t count, std::vector<double>& values, const Execution& run) {
  std::string_view text = array.text;
  Pace pace(run, text.size(), kBytesAtOnce);
  std::size_t begin = 0;
  while ((begin = text.find_first_not_of(" \t\r\n")) != text.npos) {
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    values.emplace_back();
    if (!parse_number(word, values.back()) || !fits(values.back(), field_type(array.type))) return false;
    text.remove_prefix(word.size());
    pace.at(array.text.size() - text.size());
  }
  return count == kAllValues || values.size() == count;
}

bool parse_binary(const VtpFile& vtp, const VtpArray& array, std::size_t count, std::vector<double>& values,
                  const Execution& run) {
  const bool is_inline = array.format == VtpFormat::Inline;
  if (!is_inline && array.offset > vtp.appended.size()) return false;
  std::string text = is_inline ? array.text : std::string();
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (is_inline && begin == text.npos) return count == 0;
  const std::string_view source = is_inline ? std::string_view(text).substr(begin) : vtp.appended.substr(array.offset);
  const std::size_t size = size_of(array.type);
  std::string bytes;
  const std::size_t expected = count == kAllValues ? kAllValues : count * size;
  const ByteSource stored(source, is_inline || vtp.appended_is_base64, stage(run, 0.0, 0.5));
  if (!ArrayReader(vtp, stored).read(expected, bytes)) return false;
  if (bytes.size() % size != 0) return false;
  values.resize(bytes.size() / size);
  for_each_row(values.size(), stage(run, 0.5, 1.0),
               [&](std::size_t i) { values[i] = load(bytes.data() + i * size, array.type, vtp.order); });
  return true;
}

}  // namespace

std::vector<double> vtp_values(const FileBytes& file, const VtpFile& vtp, const VtpArray& array, std::size_t count,
                               const Execution& run) {
  std::vector<double> values;
  const bool sound = array.format == VtpFormat::Ascii ? parse_ascii(array, count, values, run)
                                                      : parse_binary(vtp, array, count, values, run);
  if (!sound) {
    const std::string promised = count == kAllValues ? "values" : std::to_string(count) + " values";
    refuse(file.path, "cannot be read as a VTP file: its array " + in_quotes(array.name) + " in " +
                          in_quotes(array.section) + " does not hold its " + promised +
                          "; it is damaged, save it again");
  }
  return values;
}

}  // namespace kappa::io
