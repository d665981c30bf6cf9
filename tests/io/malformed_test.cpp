// SPDX-License-Identifier: BSD-3-Clause
// Every file of the folder of broken and unusual files, with its verdict.
#include <map>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

namespace fs = std::filesystem;

struct Verdict {
  std::size_t points = 0, faces = 0;  ///< of a file that reads right
  std::string message;                ///< part of the message of one that is refused
};

const std::map<std::string, Verdict>& verdicts() {
  static const std::map<std::string, Verdict> table = {
      {"1.2-no-points.las", {0, 0, "promises 1065 points of 34 bytes but holds 0"}},
      {"1.2-with-color-clipped.las",
       {0, 0, "promises 1065 points of 34 bytes but holds 36176 bytes of points (1064 whole ones)"}},
      {"bad_vlr_count.las", {0, 0, "variable length record 3 of 3 does not fit"}},
      {"broken_size.laz", {0, 0, "pdal translate"}},
      {"garbage_nVariableLength.las", {0, 0, "of 1069128089"}},
      {"gps-time-nan.las", {1, 0, ""}},
      {"lots_of_vlr.las", {1, 0, ""}},
      {"no-points.las", {0, 0, "holds no point"}},
      {"simple.laz", {0, 0, "pdal translate"}},
      {"samp11-utm.laz", {0, 0, "git lfs pull"}},
      {"flydracyl.pcd", {0, 0, "line 11: DATA is 'ascii-1.722589'"}},
      {"missingheader.pcd", {0, 0, "line 1: '289814.15' is no entry of a PCD header"}},
      {"no_vertex.obj", {0, 0, "holds no point"}},
      {"no_vertex.ply", {0, 0, "has no element vertex"}},
      {"sized_dims.ply", {0, 0, "its points have no z"}},
      {"fan3.obj", {5, 3, ""}},
      {"moebius.obj", {280, 224, ""}},
      {"tref.off", {1280, 320, ""}},
      {"utm17_comma.pcd", {10, 0, ""}}};  // commas leave no doubt about the values
  return table;
}

void expect_verdict(const std::string& path, const Verdict& verdict) {
  if (!verdict.message.empty()) {
    test::expect_error([&] { read_scan(path); }, ErrorCode::FileFormat, verdict.message);
    test::expect_error([&] { read_scan(path); }, ErrorCode::FileFormat, path);
    return;
  }
  const Scan scan = read_scan(path);
  EXPECT_EQ(scan.points.size(), verdict.points);
  EXPECT_EQ(scan.faces.size(), verdict.faces);
}

TEST(MalformedFiles, EachHasItsVerdict) {
  const fs::path folder = fs::path(KAPPA_SHARED_DATA) / "malformed";
  if (!fs::exists(folder)) GTEST_SKIP() << "no real data at " << folder;
  std::size_t found = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const auto verdict = verdicts().find(name);
    ASSERT_NE(verdict, verdicts().end()) << "is not in the table";
    expect_verdict(entry.path().string(), verdict->second);
    ++found;
  }
  EXPECT_EQ(found, verdicts().size());
}

TEST(MalformedFiles, CommasInAPcdKeepEveryDigit) {
  const fs::path path = fs::path(KAPPA_SHARED_DATA) / "malformed/utm17_comma.pcd";
  if (!fs::exists(path)) GTEST_SKIP() << "no real data at " << path;
  const Scan scan = read_scan(path.string());
  EXPECT_EQ(test::position(scan, 0), Vec3(289814.15, 4320978.61, 170.76));
  EXPECT_EQ(test::position(scan, 9), Vec3(289818.50, 4320980.59, 170.58));
}

}  // namespace
}  // namespace kappa
