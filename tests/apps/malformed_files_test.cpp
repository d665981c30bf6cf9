// SPDX-License-Identifier: BSD-3-Clause
// What the program says to every file of the folder of broken and unusual files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "program.hpp"

namespace kappa::apps {
namespace {

struct Verdict {
  int exit_code;
  std::string expected;  ///< part of the message, or of the summary of one that is only unusual
};

const std::map<std::string, Verdict>& verdicts() {
  static const std::map<std::string, Verdict> table = {
      {"1.2-no-points.las", {1, "promises 1065 points"}},
      {"1.2-with-color-clipped.las", {1, "promises 1065 points"}},
      {"bad_vlr_count.las", {1, "variable length record 3 of 3"}},
      {"broken_size.laz", {1, "pdal translate"}},
      {"garbage_nVariableLength.las", {1, "of 1069128089"}},
      {"gps-time-nan.las", {1, "none of the 1 points"}},  // reads right, but holds a single point
      {"lots_of_vlr.las", {1, "none of the 1 points"}},   // the same
      {"no-points.las", {1, "holds no point"}},
      {"simple.laz", {1, "pdal translate"}},
      {"samp11-utm.laz", {1, "git lfs pull"}},
      {"flydracyl.pcd", {1, "DATA is 'ascii-1.722589'"}},
      {"missingheader.pcd", {1, "no entry of a PCD header"}},
      {"no_vertex.obj", {1, "holds no point"}},
      {"no_vertex.ply", {1, "no element vertex"}},
      {"sized_dims.ply", {1, "no z"}},
      {"utm17_comma.pcd", {1, "no face can be made"}},  // reads right, but holds a single scan line
      {"fan3.obj", {0, "5 valid"}},                     // three sheets on an edge
      {"moebius.obj", {0, "280 valid"}},                // not orientable
      {"tref.off", {0, "1280 valid"}}};                 // quads that share no vertices
  return table;
}

void expect_verdict(const std::string& input, const Verdict& verdict) {
  const Folder folder;
  const Outcome outcome = run({"curvature", input, folder.file("out.ply")});
  EXPECT_EQ(outcome.exit_code, verdict.exit_code) << outcome.err;
  if (verdict.exit_code == 0) {
    EXPECT_NE(outcome.out.find(verdict.expected), std::string::npos) << outcome.out;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out.ply"});
    return;
  }
  EXPECT_NE(outcome.err.find(verdict.expected), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << "one line: " << outcome.err;
  EXPECT_TRUE(folder.names().empty()) << "no file is left";
}

TEST(MalformedFiles, EachGetsItsResultOrItsMessage) {
  const std::string folder = shared_file("malformed");
  if (folder.empty()) GTEST_SKIP() << "no ../shared/data";
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const auto verdict = verdicts().find(name);
    ASSERT_NE(verdict, verdicts().end()) << "is not in the table";
    expect_verdict(entry.path().string(), verdict->second);
    ++found;
  }
  EXPECT_EQ(found, verdicts().size());
}

}  // namespace
}  // namespace kappa::apps
