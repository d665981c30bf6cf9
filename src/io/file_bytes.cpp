// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "kappa/core/error.hpp"
#include "text.hpp"

namespace kappa::io {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kLfsPointer = "version https://git-lfs.github.com/spec/";

void check_kind(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    throw Error(ErrorCode::FileNotFound, "'" + path + "' does not exist or is out of reach: check its name");
  }
  if (fs::is_directory(status)) {
    throw Error(ErrorCode::FileNotFound, "'" + path + "' is a folder: name a file in it");
  }
  if (!fs::is_regular_file(status)) refuse(path, "is not a regular file: copy its content to one");
}

std::ifstream open(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(ErrorCode::FileNotFound, "'" + path + "' cannot be opened: " + std::strerror(errno));
  return in;
}

}  // namespace

void check_file(const std::string& path) {
  check_kind(path);
  std::ifstream in = open(path);
  std::string head(kLfsPointer.size(), '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head == kLfsPointer) {
    refuse(path, "is a Git-LFS pointer, not the data itself: run 'git lfs pull' where it came from");
  }
}

FileBytes load_file(const std::string& path) {
  check_kind(path);
  std::ifstream in = open(path);
  FileBytes file{path, std::string(fs::file_size(path), '\0')};
  in.read(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size()));
  if (static_cast<std::size_t>(in.gcount()) != file.bytes.size()) {
    throw Error(ErrorCode::FileNotFound, "'" + path + "' cannot be read to its end: " + std::strerror(errno));
  }
  return file;
}

std::string extension_of(const std::string& path) {
  return lower(fs::path(path).extension().string());
}

void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::FileFormat, "'" + path + "': " + what);
}

void refuse_line(const std::string& path, std::size_t line, const std::string& what) {
  throw Error(ErrorCode::FileFormat, "'" + path + "', line " + std::to_string(line) + ": " + what);
}

}  // namespace kappa::io
