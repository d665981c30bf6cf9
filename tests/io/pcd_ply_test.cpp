// SPDX-License-Identifier: BSD-3-Clause
// PCD and PLY, given as text or bytes.
#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::bytes_of;
using test::position;
using test::scan_of;

TEST(Pcd, OldVersionWithoutViewpointOrCount) {
  const Scan scan = scan_of("a.pcd",
                            "# .PCD v.5\nVERSION .5\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\n"
                            "POINTS 2\nDATA ascii\n1 2 3\n\n4 nan 6\n");
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_FALSE(scan.viewpoint.has_value());
  EXPECT_EQ(position(scan, 0), Vec3(1, 2, 3));
  EXPECT_TRUE(std::isnan(scan.points[1].y()));
}

TEST(Pcd, AsciiKeepsDigitsWhateverTheDeclaredSize) {
  const Scan scan = scan_of("a.pcd",
                            "FIELDS x y z\nSIZE 4 8 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n"
                            "512700.123456789 5403547.987654321 0.1\n");
  EXPECT_EQ(position(scan, 0), Vec3(512700.123456789, 5403547.987654321, 0.1));
}

TEST(Pcd, BinaryFieldsOfEveryTypeWithPaddingAndCounts) {
  const std::string header =
      "VERSION 0.7\nFIELDS i8 _ X Y Z u16 bins rgb\nSIZE 1 1 8 4 4 2 4 4\nTYPE I U F F I U F F\n"
      "COUNT 1 3 1 1 1 1 2 1\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 1\nDATA binary\n";
  const std::string data = std::string(1, '\x80') + "???" + bytes_of({512700.123456789}) + bytes_of({2.5f}) +
                           bytes_of<std::int32_t>({-7}) + bytes_of<std::uint16_t>({65535}) + bytes_of({0.25f, 0.5f}) +
                           bytes_of<std::uint32_t>({0x00ff8040u});
  const Scan scan = scan_of("a.pcd", header + data);
  EXPECT_EQ(position(scan, 0), Vec3(512700.123456789, 2.5, -7));
  EXPECT_EQ(*scan.viewpoint, Vec3(1, 2, 3));
  ASSERT_EQ(scan.fields.size(), 5u);
  EXPECT_EQ(scan.field("i8")->values[0], -128);
  EXPECT_EQ(scan.field("u16")->values[0], 65535);
  EXPECT_EQ(scan.field("bins_1")->values[0], 0.5);
  EXPECT_EQ(scan.field("rgb")->type, Field::Type::UInt32);  // the bits of the float are the colour
  EXPECT_EQ(scan.field("rgb")->values[0], 0x00ff8040);
}

TEST(Pcd, OneColumnIsNoGrid) {
  const Scan scan = scan_of("a.pcd", "FIELDS x y z\nWIDTH 1\nHEIGHT 2\nDATA ascii\n1 2 3\n4 5 6\n");
  EXPECT_EQ(scan.width, 2u);
  EXPECT_FALSE(scan.is_organised());
}

const std::string kPlySquare =
    "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty double x\nproperty double y\nproperty float64 z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n";

TEST(Ply, AsciiWithEverything) {
  const Scan scan = scan_of("a.ply", kPlySquare +
                                         "property list uchar int neighbours\nelement edge 1\nproperty int a\n"
                                         "element face 2\nproperty uchar flags\nproperty list uint8 uint vertex_index\n"
                                         "obj_info i\nend_header\n"
                                         "512700.123456789 0 0 0 0 1 255 0\n1 0 0 0 0 1 0 2 5 6\n\n1 1 0 0 0 1 7 1 9\n"
                                         "0 1 0 0 0 1 8 0\n77\n0 4 0 1 2 3\n1 3 0 1 2\n");
  ASSERT_EQ(scan.points.size(), 4u);
  EXPECT_EQ(position(scan, 0).x(), 512700.123456789);
  EXPECT_EQ(scan.normals[3], Vec3(0, 0, 1));
  ASSERT_EQ(scan.fields.size(), 1u);
  EXPECT_EQ(scan.fields[0].type, Field::Type::UInt8);
  EXPECT_EQ(scan.fields[0].values, (std::vector<double>{255, 0, 7, 8}));
  ASSERT_EQ(scan.faces.size(), 2u);
  EXPECT_EQ(scan.faces[0].size(), 4u);
  EXPECT_EQ(scan.faces[1][2], 2u);
}

std::string reversed(std::string bytes) {
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST(Ply, BinaryInBothOrders) {
  const auto number = [](bool big, const std::string& bytes) { return big ? reversed(bytes) : bytes; };
  for (const bool big : {false, true}) {
    std::string file =
        std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty float y\r\nproperty short z\r\n"
        "element face 1\r\nproperty list ushort int vertex_indices\r\nend_header\r\n";
    for (int i = 0; i < 3; ++i) {
      file += number(big, bytes_of({512700.123456789 + i})) + number(big, bytes_of({0.5f})) +
              number(big, bytes_of<std::int16_t>({static_cast<std::int16_t>(-300 - i)}));
    }
    file += number(big, bytes_of<std::uint16_t>({3}));
    for (const int corner : {2, 0, 1}) file += number(big, bytes_of<std::int32_t>({corner}));
    const Scan scan = scan_of("a.ply", file);
    ASSERT_EQ(scan.points.size(), 3u);
    EXPECT_EQ(position(scan, 1), Vec3(512700.123456789 + 1, 0.5, -301));
    ASSERT_EQ(scan.faces.size(), 1u);
    EXPECT_EQ(scan.faces[0][0], 2u);
  }
}

TEST(Ply, NoFacesIsACloud) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
      "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_FALSE(scan_of("a.ply", header + "1 2 3\n").is_mesh());
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.ply", header + "1 2 3\n");
  test::expect_error([&] { read_mesh(path); }, ErrorCode::InvalidData, "without faces");
}

TEST(ReadScan, ExtensionInAnyCase) {
  EXPECT_EQ(scan_of("A.XYZ", "1 2 3\n").points.size(), 1u);
  EXPECT_EQ(scan_of("A.Obj", "v 1 2 3\n").points.size(), 1u);
}

TEST(Ply, IsWrittenAlikeByAnyNumberOfThreads) {
  const test::TemporaryFolder folder;
  Scan scan;
  for (int i = 0; i < 5000; ++i) scan.points.emplace_back(i, -i, 0.5 * i);
  scan.fields = {{"number", Field::Type::UInt16, std::vector<double>(5000, 7)}};
  std::string expected;
  for (int threads = 1; threads <= 3; ++threads) {
    Execution run;
    run.threads = threads;
    write_scan(folder.file("out.ply"), scan, run);
    std::stringstream bytes;
    bytes << std::ifstream(folder.file("out.ply"), std::ios::binary).rdbuf();
    if (threads == 1) expected = bytes.str();
    EXPECT_EQ(bytes.str(), expected) << threads;
  }
  EXPECT_GT(expected.size(), 5000u * 26);
  const std::atomic<bool> stop{true};
  Execution stopped;
  stopped.threads = 3;
  stopped.cancel = &stop;
  EXPECT_THROW(write_scan(folder.file("none.ply"), scan, stopped), Cancelled);
  EXPECT_EQ(folder.size(), 1u);
}

}  // namespace
}  // namespace kappa
