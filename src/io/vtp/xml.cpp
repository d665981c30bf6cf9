// SPDX-License-Identifier: BSD-3-Clause
#include "xml.hpp"

namespace kappa::io {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kEscapes[][2] = {
    {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}};

std::string_view without_leading_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  return begin == text.npos ? std::string_view() : text.substr(begin);
}

std::string unescaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t length = 1;
    std::string_view plain = text.substr(0, 1);
    for (const auto& escape : kEscapes) {
      if (text.substr(0, escape[0].size()) != escape[0]) continue;
      length = escape[0].size();
      plain = escape[1];
    }
    result.append(plain);
    text.remove_prefix(length);
  }
  return result;
}

/// Position of the '>' that ends a tag, outside of quotes.
std::size_t end_of_tag(std::string_view text, std::size_t at) {
  for (char quote = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at;
    }
  }
  return text.npos;
}

/// Takes one name="value" off `rest`.
bool parse_attribute(std::string_view& rest, XmlTag& tag) {
  const std::size_t equals = rest.find('=');
  if (equals == rest.npos) return false;
  const std::string_view name = rest.substr(0, rest.find_first_of("= \t\r\n"));
  rest = without_leading_blanks(rest.substr(equals + 1));
  if (rest.empty() || (rest[0] != '"' && rest[0] != '\'')) return false;
  const std::size_t end = rest.find(rest[0], 1);
  if (end == rest.npos) return false;
  tag.attributes[std::string(name)] = unescaped(rest.substr(1, end - 1));
  rest = without_leading_blanks(rest.substr(end + 1));
  return true;
}

}  // namespace

std::string XmlTag::attribute(const std::string& key, const std::string& otherwise) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? otherwise : found->second;
}

bool XmlReader::skip_past(std::string_view end) {
  const std::size_t found = text_.find(end, position_);
  is_broken_ = found == text_.npos;
  if (!is_broken_) position_ = found + end.size();
  return !is_broken_;
}

bool XmlReader::parse(std::string_view inside, XmlTag& tag) {
  tag = XmlTag();
  tag.is_end = !inside.empty() && inside.front() == '/';
  tag.is_start = !tag.is_end;
  if (tag.is_end) inside.remove_prefix(1);
  if (!inside.empty() && inside.back() == '/') {
    tag.is_end = true;
    inside.remove_suffix(1);
  }
  const std::size_t length = inside.find_first_of(kBlanks);
  tag.name = inside.substr(0, length);
  std::string_view rest = length == inside.npos ? std::string_view() : without_leading_blanks(inside.substr(length));
  while (!rest.empty()) {
    if (!parse_attribute(rest, tag)) return false;
  }
  return !tag.name.empty();
}

bool XmlReader::next(XmlTag& tag) {
  const std::size_t before = position_;
  for (;;) {
    const std::size_t open = text_.find('<', position_);
    if (open == text_.npos) return false;
    text_before_ = text_.substr(before, open - before);
    position_ = open + 1;
    const std::string_view rest = text_.substr(position_);
    if (rest.substr(0, 3) == "!--") {
      if (!skip_past("-->")) return false;
    } else if (rest.substr(0, 1) == "?" || rest.substr(0, 1) == "!") {
      if (!skip_past(">")) return false;
    } else {
      const std::size_t end = end_of_tag(text_, position_);
      is_broken_ = end == text_.npos || !parse(text_.substr(position_, end - position_), tag);
      if (!is_broken_) position_ = end + 1;
      return !is_broken_;
    }
  }
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    std::string_view written(&c, 1);
    for (const auto& escape : kEscapes) {
      if (escape[1][0] == c) written = escape[0];
    }
    result.append(written);
  }
  return result;
}

}  // namespace kappa::io
