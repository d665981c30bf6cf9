// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "kappa/core/labels.hpp"

namespace kappa::test {

/// A picture read back from a PNG.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< rows from the bottom

  Rgb at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  /// How many pixels of [x0, x1) x [y0, y1) fulfil a condition.
  int count(int x0, int y0, int x1, int y1, const std::function<bool(Rgb)>& condition) const;
  int count(const std::function<bool(Rgb)>& condition) const { return count(0, 0, width, height, condition); }
};

Picture read_picture(const std::string& path);

inline bool same(Rgb a, Rgb b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

/// Largest difference of a channel.
int difference(Rgb a, Rgb b);

/// Number of pixels in which two pictures of one size differ.
int differing_pixels(const Picture& a, const Picture& b);

std::string file_bytes(const std::string& path);

/// A folder of its own for the files of a test, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::size_t file_count() const;

 private:
  std::filesystem::path path_;
};

}  // namespace kappa::test
