// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Parts of text, whatever the locale.
namespace kappa::io {

/// Lines of a text one by one, without their end (LF, or CR LF).
class LineReader {
 public:
  explicit LineReader(std::string_view text, std::size_t lines_before = 0) : text_(text), number_(lines_before) {}

  /// False at the end of the text.
  bool next(std::string_view& line);
  /// Number of the line last returned, from 1.
  std::size_t number() const { return number_; }
  /// Position in the text after the line last returned.
  std::size_t position() const { return position_; }
  std::size_t remaining() const { return text_.size() - position_; }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_;
};

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

std::string_view trimmed(std::string_view text);
std::string lower(std::string_view text);

/// Takes the next word, ended by blanks, off `rest`; false if there is none.
bool next_word(std::string_view& rest, std::string_view& word);
std::vector<std::string_view> words_of(std::string_view line);

/// The same for words ended by blanks or by one comma or semicolon among blanks; two of those enclose an
/// empty word, and one at the end of the line encloses none.
bool next_field(std::string_view& rest, std::string_view& word);

/// Whole-word conversions, false if `word` is anything else. Numbers: decimal, with or without
/// exponent, `nan` and `inf` in any case; one too small for a double is 0, one too large is refused.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// `text` shortened and without control characters, in quotes: a part of a file fit for a message.
std::string in_quotes(std::string_view text);

}  // namespace kappa::io
