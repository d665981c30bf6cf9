// SPDX-License-Identifier: BSD-3-Clause
// A file that is written is complete or not there.
#include <sys/resource.h>

#include <csignal>

#include "kappa/io/atomic.hpp"
#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::expect_error;
using test::TemporaryFolder;

Scan cloud(std::size_t count) {
  Scan scan;
  for (std::size_t i = 0; i < count; ++i) scan.points.emplace_back(static_cast<double>(i), 0.5, -1.0);
  scan.width = count;
  return scan;
}

TEST(WriteAtomically, RemovesTheTemporaryFileOnError) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "before");
  std::string temporary;
  EXPECT_THROW(write_atomically(path,
                                [&](const std::string& name) {
                                  temporary = name;
                                  std::ofstream(name) << "half";
                                  throw std::runtime_error("stop");
                                }),
               std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(temporary));
  EXPECT_EQ(test::content_of(path), "before");
  EXPECT_EQ(folder.size(), 1u);
}

TEST(WriteAtomically, ReplacesWithTheExtensionKept) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.png", "before");
  write_atomically(path, [&](const std::string& name) {
    EXPECT_EQ(std::filesystem::path(name).extension(), ".png");
    EXPECT_EQ(std::filesystem::path(name).parent_path(), folder.path());
    EXPECT_EQ(test::content_of(path), "before");
    std::ofstream(name) << "after";
  });
  EXPECT_EQ(test::content_of(path), "after");
  EXPECT_EQ(folder.size(), 1u);
}

TEST(WriteAtomically, KeepsOffFoldersAndDevices) {
  const TemporaryFolder folder;
  const auto nothing = [](const std::string&) {};
  expect_error([&] { write_atomically(folder.path(), nothing); }, ErrorCode::FileWrite, "directory");
  expect_error([&] { write_atomically("/dev/null", nothing); }, ErrorCode::FileWrite, "not a regular file");
  expect_error([&] { write_atomically(folder.file("no/a.csv"), nothing); }, ErrorCode::FileWrite, "No such file");
}

/// Lets no file of this process grow beyond a size, as a full disk would.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(WriteScan, ReportsAFullDiskAndLeavesNothing) {
  const Scan scan = cloud(20000);
  for (const std::string& extension : writable_extensions()) {
    SCOPED_TRACE(extension);
    const TemporaryFolder folder;
    bool thrown = false;
    {
      const FileSizeLimit limit(1000);
      try {
        write_scan(folder.file("a" + extension), scan);
      } catch (const Error& error) {
        thrown = error.code() == ErrorCode::FileWrite;
      }
    }
    EXPECT_TRUE(thrown);
    EXPECT_EQ(folder.size(), 0u);
  }
}

TEST(WriteScan, StopsWhenCancelled) {
  const Scan scan = cloud(100000);
  for (const std::string& extension : writable_extensions()) {
    const TemporaryFolder folder;
    const std::atomic<bool> stop{true};
    Execution run;
    run.cancel = &stop;
    EXPECT_THROW(write_scan(folder.file("a" + extension), scan, run), Cancelled) << extension;
    EXPECT_EQ(folder.size(), 0u);
  }
}

TEST(WriteScan, RefusesWhatNoFileCanHold) {
  const TemporaryFolder folder;
  const auto refuses = [&](const Scan& scan, const char* part) {
    expect_error([&] { write_scan(folder.file("a.ply"), scan); }, ErrorCode::InvalidArgument, part);
    EXPECT_EQ(folder.size(), 0u);
  };
  Scan scan = cloud(2);
  scan.normals = {Vec3::UnitX()};
  refuses(scan, "1 normals for 2 points: give one a point");
  scan = cloud(2);
  scan.fields = {{"a", Field::Type::Float64, {1}}};
  refuses(scan, "1 'a' values for 2 points: give one a point");
  scan.fields = {{"label", Field::Type::UInt8, {1, kNaN}}};
  refuses(scan, "not of its type uint8");
  scan.fields = {{"label", Field::Type::UInt16, {1, 65536}}};
  refuses(scan, "not of its type uint16");
  scan.fields = {{"nx", Field::Type::Float64, {1, 2}}};
  refuses(scan, "cannot be called 'nx'");
  scan = cloud(2);
  scan.faces.add(0, 1, 2);
  refuses(scan, "a face has vertex 2 of 2");
}

TEST(CheckWritable, RefusesBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  check_writable(folder.file("a.PLY"));
  check_writable("a.csv");
  const auto refuses = [&](const std::string& path, const char* part) {
    expect_error([&] { check_writable(path); }, ErrorCode::FileWrite, part);
  };
  refuses(folder.file("a.xyz"), "use one of .ply .pcd .csv .vtp .las");
  refuses(folder.file("a"), "extension ''");
  refuses(folder.file("none/a.ply"), "there is no folder");
  std::filesystem::create_directory(folder.file("b.ply"));
  refuses(folder.file("b.ply"), "is a folder");
  EXPECT_EQ(folder.size(), 1u);
}

}  // namespace
}  // namespace kappa
