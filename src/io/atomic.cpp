// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/atomic.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "kappa/core/error.hpp"

namespace kappa {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& path, int reason) {
  throw Error(ErrorCode::FileWrite, "'" + path + "' cannot be written: " + std::strerror(reason));
}

/// Creates a new file beside `path`, with its extension.
std::string create_temporary(const std::string& path) {
  const fs::path target(path);
  const std::string stem = "." + target.stem().string() + ".part-" + std::to_string(::getpid()) + "-";
  for (int attempt = 0;; ++attempt) {
    const fs::path name = target.parent_path() / (stem + std::to_string(attempt) + target.extension().string());
    const int file = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return name.string();
    }
    if (errno != EEXIST) fail(path, errno);
  }
}

/// Removes a file unless it was released.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string name) : name_(std::move(name)) {}
  ~TemporaryFile() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& name() const { return name_; }
  void release() { name_.clear(); }

 private:
  std::string name_;
};

}  // namespace

void write_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& fill) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(ErrorCode::FileWrite, "'" + path + "' is not a regular file, which would be replaced: choose another");
  }
  TemporaryFile temporary(create_temporary(path));
  fill(temporary.name());
  if (::rename(temporary.name().c_str(), path.c_str()) != 0) fail(path, errno);
  temporary.release();
}

}  // namespace kappa
