// SPDX-License-Identifier: BSD-3-Clause
#include "io/format_table.hpp"

#include <algorithm>
#include <set>

#include "support.hpp"

namespace kappa {
namespace {

bool is_in(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

TEST(FormatTable, HasEveryExtensionOnceAndFindsIt) {
  std::set<std::string> found;
  for (const io::Format& format : io::format_table()) {
    EXPECT_TRUE(found.insert(format.extension).second) << format.extension;
    EXPECT_EQ(io::format_of("folder.obj/a" + std::string(format.extension)), &format);
  }
  EXPECT_EQ(io::format_of("A.PlY"), io::format_of("a.ply"));
  EXPECT_EQ(io::format_of("a.doc"), nullptr);
  EXPECT_EQ(io::format_of("ply"), nullptr);
}

TEST(FormatTable, MakesTheListsOfExtensions) {
  for (const io::Format& format : io::format_table()) {
    EXPECT_TRUE(is_in(readable_extensions(), format.extension)) << "what is written is read, too";
    EXPECT_EQ(is_in(writable_extensions(), format.extension), format.write != nullptr);
    EXPECT_EQ(is_in(writable_mesh_extensions(), format.extension), format.write && format.holds_faces);
  }
  EXPECT_EQ(readable_extensions().size(), io::format_table().size());
}

/// A format keeps faces exactly if the table says so.
TEST(FormatTable, KnowsWhoKeepsFaces) {
  Scan scan;
  scan.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scan.width = 3;
  scan.faces.add(0, 1, 2);
  const test::TemporaryFolder folder;
  for (const io::Format& format : io::format_table()) {
    if (!format.write) continue;
    const std::string path = folder.file(std::string("a") + format.extension);
    write_scan(path, scan);
    EXPECT_EQ(read_scan(path).is_mesh(), format.holds_faces) << format.extension;
  }
}

TEST(Listed, HasBlanksBetweenTheWords) {
  EXPECT_EQ(io::listed({}), "");
  EXPECT_EQ(io::listed({".ply"}), ".ply");
  EXPECT_EQ(io::listed({".ply", ".pcd"}), ".ply .pcd");
}

}  // namespace
}  // namespace kappa
