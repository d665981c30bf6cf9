// SPDX-License-Identifier: BSD-3-Clause
// Files in memory maps.
#include "io/file_bytes.hpp"

#include "support.hpp"

namespace kappa {
namespace {

std::string long_text() {
  std::string text;
  while (text.size() < 100000) text += std::to_string(text.size()) + " ";
  return text;
}

TEST(FileBytes, AreThoseOfTheFileEvenWhenGivenBack) {
  const test::TemporaryFolder folder;
  const std::string text = long_text();
  const io::FileBytes file = io::load_file(folder.write("a.txt", text));
  EXPECT_EQ(file.bytes, text);
  for (const std::size_t end : {std::size_t{0}, std::size_t{1}, std::size_t{4097}, text.size()}) {
    file.done_before(end);
    EXPECT_EQ(file.bytes, text) << "given back up to " << end;
  }
  EXPECT_EQ(file.from(text.size() - 3), text.substr(text.size() - 3));
  EXPECT_TRUE(io::load_file(folder.write("empty.txt", "")).bytes.empty());
}

TEST(FileBytes, AFileThatChangesIsRefused) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.txt", long_text());
  const io::FileBytes file = io::load_file(path);
  EXPECT_NO_THROW(io::check_unchanged(file));
  std::ofstream(path, std::ios::app) << "more";
  test::expect_error([&] { io::check_unchanged(file); }, ErrorCode::FileFormat, "was changed while it was read");
  EXPECT_NO_THROW(io::check_unchanged({"memory", "bytes"}));
}

TEST(FileBytes, AFileThatIsReplacedByRenamingStaysWhatItWas) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.txt", long_text());
  const io::FileBytes file = io::load_file(path);
  std::filesystem::rename(folder.write("b.txt", "short"), path);
  EXPECT_EQ(file.bytes, long_text());
}

}  // namespace
}  // namespace kappa
