// SPDX-License-Identifier: BSD-3-Clause
#include "json.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace kappa::app {

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return std::string(text.data(), end);
}

std::string json_string(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      text += std::string("\\") + c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      constexpr char kHex[] = "0123456789abcdef";
      text += std::string("\\u00") + kHex[c >> 4] + kHex[c & 15];
    } else {
      text += c;
    }
  }
  return text + '"';
}

Json& Json::add(std::string_view key, double value) {
  return add_raw(key, json_number(value));
}
Json& Json::add(std::string_view key, std::size_t value) {
  return add_raw(key, std::to_string(value));
}
Json& Json::add(std::string_view key, std::string_view value) {
  return add_raw(key, json_string(value));
}
Json& Json::add(std::string_view key, const Json& object) {
  return add_raw(key, object.text());
}

Json& Json::add_raw(std::string_view key, const std::string& value) {
  body_ += (body_.empty() ? "" : ", ") + json_string(key) + ": " + value;
  return *this;
}

}  // namespace kappa::app
