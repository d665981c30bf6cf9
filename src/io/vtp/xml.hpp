// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace kappa::io {

/// A start or end tag.
struct XmlTag {
  std::string name;
  bool is_start = false, is_end = false;  ///< both for <a/>
  std::map<std::string, std::string> attributes;

  /// Value of an attribute, or `otherwise`.
  std::string attribute(const std::string& key, const std::string& otherwise = "") const;
};

/// Reads the tags of a text one by one. Comments, declarations and processing instructions are skipped.
class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : text_(text) {}

  /// False at the end of the text or at something that is no tag (see is_broken()).
  bool next(XmlTag& tag);
  bool is_broken() const { return is_broken_; }
  /// Text between the last two tags.
  std::string_view text_before() const { return text_before_; }
  /// Position after the last tag.
  std::size_t position() const { return position_; }

 private:
  bool skip_past(std::string_view end);
  bool parse(std::string_view inside, XmlTag& tag);

  std::string_view text_, text_before_;
  std::size_t position_ = 0;
  bool is_broken_ = false;
};

/// `text` with the five characters that XML reserves replaced.
std::string xml_escaped(std::string_view text);

}  // namespace kappa::io
