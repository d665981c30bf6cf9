// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

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

/// A file mapped for reading as long as this lives.
class FileMap {
 public:
  explicit FileMap(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (file_ < 0 || ::fstat(file_, &status_) != 0) fail(path, "opened");
    if (size() == 0) return;
    begin_ = ::mmap(nullptr, size(), PROT_READ, MAP_PRIVATE, file_, 0);
    if (begin_ == MAP_FAILED) fail(path, "mapped into memory");
    ::madvise(begin_, size(), MADV_SEQUENTIAL);
  }
  ~FileMap() {
    if (begin_) ::munmap(begin_, size());
    ::close(file_);
  }
  FileMap(const FileMap&) = delete;
  FileMap& operator=(const FileMap&) = delete;

  std::size_t size() const { return static_cast<std::size_t>(status_.st_size); }
  std::string_view bytes() const { return {static_cast<const char*>(begin_), size()}; }

  void done_before(std::size_t end) const {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    if (begin_ && end >= page) ::madvise(begin_, end / page * page, MADV_DONTNEED);
  }

  bool is_unchanged() const {
    struct stat now;
    return ::fstat(file_, &now) == 0 && now.st_size == status_.st_size &&
           now.st_mtim.tv_sec == status_.st_mtim.tv_sec && now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec;
  }

 private:
  [[noreturn]] void fail(const std::string& path, const char* what) {
    const std::string reason = std::strerror(errno);
    if (file_ >= 0) ::close(file_);
    throw Error(ErrorCode::FileNotFound, "'" + path + "' cannot be " + what + ": " + reason);
  }

  int file_;
  struct stat status_ = {};
  void* begin_ = nullptr;
};

void FileBytes::done_before(std::size_t end) const {
  if (map) map->done_before(end);
}

FileBytes load_file(const std::string& path) {
  check_kind(path);
  const auto map = std::make_shared<const FileMap>(path);
  return {path, map->bytes(), map};
}

void check_unchanged(const FileBytes& file) {
  if (!file.map || file.map->is_unchanged()) return;
  refuse(file.path, "was changed while it was read: wait until it is complete and read it again");
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
