// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::test {

/// A fresh folder, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "kappa-io-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
  std::size_t size() const {
    const auto begin = std::filesystem::directory_iterator(path_);
    return static_cast<std::size_t>(std::distance(begin, std::filesystem::directory_iterator()));
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// The scan in a file of that name and content.
inline Scan scan_of(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return read_scan(folder.write(name, content));
}

inline std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Point `i` in the coordinates of the file.
inline Vec3 position(const Scan& scan, std::size_t i) {
  return scan.origin + scan.points[i];
}

inline bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b);
}

/// Expects an Error of that code with a message that holds `part`, and no output on stdout or stderr.
template <class Call>
void expect_error(Call&& call, ErrorCode code, const std::string& part) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string message;
  ErrorCode found = code;
  try {
    call();
  } catch (const Error& error) {
    message = error.what();
    found = error.code();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(found, code) << message;
  EXPECT_FALSE(message.empty()) << "no error, expected: " << part;
  EXPECT_NE(message.find(part), std::string::npos) << "expected: " << part << ", message: " << message;
}

/// Expects that a file of that name and content is refused.
inline void expect_refused(const std::string& name, const std::string& content, const std::string& part) {
  SCOPED_TRACE(name + " that should be refused for: " + part);
  expect_error([&] { scan_of(name, content); }, ErrorCode::FileFormat, part);
}

/// Bytes of numbers, in the order of this machine (little-endian on all that run the tests).
template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

}  // namespace kappa::test
