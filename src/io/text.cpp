// SPDX-License-Identifier: BSD-3-Clause
#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

namespace kappa::io {

namespace {

char lower_char(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string_view without_plus(std::string_view word) {
  const bool signed_number = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
  return signed_number ? word.substr(1) : word;
}

/// Whether a number out of the range of doubles is so because of a negative exponent.
bool is_underflow(std::string_view word) {
  const std::size_t e = word.find_first_of("eE");
  return e == std::string_view::npos ? word.find_first_of("123456789") > word.find('.')
                                     : e + 1 < word.size() && word[e + 1] == '-';
}

}  // namespace

bool LineReader::next(std::string_view& line) {
  if (position_ >= text_.size()) return false;
  const char* begin = text_.data() + position_;
  const void* end = std::memchr(begin, '\n', remaining());
  const std::size_t length = end ? static_cast<std::size_t>(static_cast<const char*>(end) - begin) : remaining();
  line = std::string_view(begin, length);
  position_ += length + (end ? 1 : 0);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), lower_char);
  return result;
}

bool next_word(std::string_view& rest, std::string_view& word) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return !word.empty();
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word; next_word(line, word);) words.push_back(word);
  return words;
}

bool next_field(std::string_view& rest, std::string_view& word) {
  const auto is_separator = [](char c) { return c == ',' || c == ';'; };
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end]) && !is_separator(rest[end])) ++end;
  if (begin == rest.size()) return false;
  word = rest.substr(begin, end - begin);
  while (end < rest.size() && is_blank(rest[end])) ++end;
  if (end < rest.size() && is_separator(rest[end])) ++end;
  rest.remove_prefix(end);
  return true;
}

bool parse_number(std::string_view word, double& value) {
  word = without_plus(word);
  const char* end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value);
  if (last != end || word.empty()) return false;
  if (error == std::errc::result_out_of_range && is_underflow(word)) value = 0.0;
  return error == std::errc() || (error == std::errc::result_out_of_range && is_underflow(word));
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  word = without_plus(word);
  const char* end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value);
  return !word.empty() && last == end && error == std::errc();
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string result(text.substr(0, kLongest));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  }
  return "'" + result + (text.size() > kLongest ? "...'" : "'");
}

}  // namespace kappa::io
