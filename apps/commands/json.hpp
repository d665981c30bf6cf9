// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace kappa::app {

/// Writes one JSON object, in the order of the calls. A number that is not finite becomes null.
class Json {
 public:
  Json& add(std::string_view key, double value);
  Json& add(std::string_view key, std::size_t value);
  Json& add(std::string_view key, std::string_view value);
  Json& add(std::string_view key, const char* value) { return add(key, std::string_view(value)); }
  Json& add(std::string_view key, const Json& object);
  /// `items` are JSON texts.
  template <class Items>
  Json& add_list(std::string_view key, const Items& items) {
    std::string list;
    for (const auto& item : items) list += (list.empty() ? "" : ", ") + std::string(item);
    return add_raw(key, "[" + list + "]");
  }
  std::string text() const { return "{" + body_ + "}"; }

 private:
  Json& add_raw(std::string_view key, const std::string& value);
  std::string body_;
};

/// A number with the fewest digits that give it back, "null" if it is not finite.
std::string json_number(double value);
std::string json_string(std::string_view value);

}  // namespace kappa::app
