// SPDX-License-Identifier: BSD-3-Clause
// Malformed files of every format: refused with what is wrong, whatever they promise.
#include <random>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::bytes_of;
using test::expect_refused;
using test::TemporaryFolder;

std::string pcd(const std::string& fields, const std::string& counts, const std::string& data) {
  return "VERSION 0.7\n" + fields + "\n" + counts + "\nDATA " + data;
}

const std::string kXyz = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1";

TEST(RefusedPcd, Headers) {
  const std::string one = "WIDTH 1\nHEIGHT 1\nPOINTS 1";
  expect_refused("a.pcd", pcd("FIELDS x y z\nSIZE 4 4", one, "ascii\n1 2 3\n"), "SIZE has 2 values for 3 fields");
  expect_refused("a.pcd", pcd("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F", one, "ascii\n1 2 3\n"), "no type 'F' of size 3");
  expect_refused("a.pcd", pcd("FIELDS x y z\nTYPE F F Q", one, "ascii\n1 2 3\n"), "no type 'Q'");
  expect_refused("a.pcd", pcd("FIELDS x y", one, "ascii\n1 2\n"), "have no z");
  expect_refused("a.pcd", pcd("FIELDS x y z x", one, "ascii\n1 2 3 4\n"), "two columns 'x'");
  expect_refused("a.pcd", pcd("SIZE 4", one, "ascii\n1\n"), "no FIELDS line");
  expect_refused("a.pcd", pcd("FIELDS", one, "ascii\n1\n"), "names no field");
  expect_refused("a.pcd", pcd(kXyz, "HEIGHT 1", "ascii\n1 2 3\n"), "no WIDTH line");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2\nHEIGHT 2\nPOINTS 3", "ascii\n1 2 3\n"), "promises 3 points but a grid");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH -1\nHEIGHT 1", "ascii\n1 2 3\n"), "'-1' is not an integer");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1 2", "ascii\n1 2 3\n"), "WIDTH must have one value");
  expect_refused("a.pcd", pcd(kXyz, one + "\nVIEWPOINT 0 0 0", "ascii\n1 2 3\n"), "VIEWPOINT must have seven");
  expect_refused("a.pcd", pcd(kXyz, one + "\n" + one, "ascii\n1 2 3\n"), "WIDTH stands twice");
  expect_refused("a.pcd", pcd(kXyz, one, "binary_zip\n1 2 3\n"), "'binary_zip'");
  expect_refused("a.pcd", kXyz + "\n" + one, "no DATA line");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 0\nHEIGHT 1\nPOINTS 0", "ascii\n"), "holds no point");
}

TEST(RefusedPcd, CountsThatLie) {
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1000000000000\nHEIGHT 1", "binary\n"), "'1000000000000' is not an integer");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 65536\nHEIGHT 65536", "binary\n"), "promises 4294967296 points");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 4294967294\nHEIGHT 4294967294", "binary\n"), "points");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2147483649", "binary\n"), "holds 0 bytes of data");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2147483649", "ascii\n1 2 3\n"), "holds 6 bytes of data");
  expect_refused("a.pcd",
                 pcd("FIELDS x y z h\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 65536", "WIDTH 4294967294", "binary\n"),
                 "values a point");
  expect_refused("a.pcd", pcd("FIELDS x y z\nCOUNT 1 1 -1", "WIDTH 1", "ascii\n1 2\n"), "'-1' is not an integer");
  expect_refused("a.pcd", pcd("FIELDS x y z\nCOUNT 0 0 0", "WIDTH 4000000000", "binary\n"), "have no x");
}

TEST(RefusedPcd, Bodies) {
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2", "ascii\n1 2 3\n"), "it is cut off");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2", "ascii\n1000 2000 3000\n"), "ends before its 2 points");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1", "ascii\n1 2 3\n4 5 6\n"), "line 9: follows the 1 points");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1", "ascii\n1 2 3 4\n"), "line 8: has 4 values in place of 3");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1", "ascii\n1 2 z\n"), "line 8: 'z' is not a number");
  expect_refused("a.pcd", pcd("FIELDS x y z l\nSIZE 4 4 4 1\nTYPE F F F U", "WIDTH 1", "ascii\n1 2 3 256\n"),
                 "not of type uint8");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 2", "binary\n" + bytes_of({1.f, 2.f, 3.f, 4.f, 5.f})), "holds 20 bytes");
}

std::string compressed(std::uint32_t stored, std::uint32_t expanded, const std::string& stream) {
  return pcd(kXyz, "WIDTH 1", "binary_compressed\n" + bytes_of({stored, expanded}) + stream);
}

TEST(RefusedPcd, CompressedBodies) {
  const std::string literal = "\x0b" + bytes_of({1.f, 2.f, 3.f});
  EXPECT_EQ(test::position(test::scan_of("a.pcd", compressed(13, 12, literal)), 0), Vec3(1, 2, 3));
  expect_refused("a.pcd", compressed(14, 12, literal), "promises 14 compressed bytes but holds 13");
  expect_refused("a.pcd", compressed(13, 24, literal), "do not expand to the 12 bytes");
  expect_refused("a.pcd", compressed(12, 12, literal), "do not expand");
  expect_refused("a.pcd", compressed(13, 12, "\xe0" + literal.substr(1)), "do not expand");
  expect_refused("a.pcd", compressed(3, 12, std::string("\xe0\x01\xff")), "do not expand");
  expect_refused("a.pcd", compressed(0, 12, ""), "do not expand");
  expect_refused("a.pcd", compressed(0xffffffff, 0xffffffff, literal), "it is cut off");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 1", "binary_compressed\nabc"), "ends before its compressed data");
  expect_refused("a.pcd", pcd(kXyz, "WIDTH 300000000", "binary_compressed\n" + bytes_of({13u, 3600000000u}) + literal),
                 "do not expand");
}

std::string ply(const std::string& format, const std::string& elements, const std::string& data) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + data;
}

std::string vertices(const std::string& count) {
  return "element vertex " + count + "\nproperty float x\nproperty float y\nproperty float z\n";
}

std::string faces(const std::string& count) {
  return "element face " + count + "\nproperty list uchar int vertex_indices\n";
}

TEST(RefusedPly, Headers) {
  expect_refused("a.ply", "plx\n", "line 1: must be 'ply'");
  expect_refused("a.ply", "ply\nformat ascii 1.0\n" + vertices("1"), "no end_header");
  expect_refused("a.ply", "ply\n" + vertices("1") + "end_header\n1 2 3\n", "no format line");
  expect_refused("a.ply", ply("binary", vertices("1"), ""), "the format 'binary'");
  expect_refused("a.ply", ply("ascii", vertices("-1"), ""), "line 3: must read 'element NAME COUNT'");
  expect_refused("a.ply", ply("ascii", "property float x\n", ""), "line 3: has a property before any element");
  expect_refused("a.ply", ply("ascii", "element vertex 1\nproperty real x\n", ""), "no PLY type 'real'");
  expect_refused("a.ply", ply("ascii", "element vertex 1\nproperty list float int x\n", ""), "cannot have a length");
  expect_refused("a.ply", ply("ascii", vertices("1") + vertices("1"), ""), "'vertex' stands twice");
  expect_refused("a.ply", ply("ascii", "hello\n", ""), "'hello' is no entry");
  expect_refused(
      "a.ply",
      ply("ascii", vertices("1") + "element face 1\nproperty list uchar float vertex_indices\n", "1 2 3\n3 0 0 0\n"),
      "not integers");
  expect_refused("a.ply",
                 ply("ascii", vertices("1") + "element face 1\nproperty list uchar int corners\n", "1 2 3\n3 0 0 0\n"),
                 "0 lists vertex_indices");
  expect_refused(
      "a.ply",
      ply("ascii", vertices("1") + "element tristrips 1\nproperty list int int vertex_indices\n", "1 2 3\n3 0 0 0\n"),
      "strips are not read");
}

TEST(RefusedPly, CountsThatLie) {
  for (const char* format : {"ascii", "binary_little_endian"}) {
    expect_refused("a.ply", ply(format, vertices("1000000000000"), "1 2 3\n"), "promises 1000000000000 elements");
    expect_refused("a.ply", ply(format, vertices("2147483649"), "1 2 3\n"), "promises 2147483649 elements");
    expect_refused("a.ply", ply(format, vertices("0") + faces("99999999999"), ""), "promises 99999999999 elements");
    expect_refused("a.ply", ply(format, "element vertex 18446744073709551615\nproperty float x\n", ""), "must read");
  }
  EXPECT_EQ(
      test::scan_of("a.ply", ply("ascii", "element nothing 1000000000000\n" + vertices("1"), "1 2 3\n")).points.size(),
      1u);
}

TEST(RefusedPly, Bodies) {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n", elements = vertices("3") + faces("1");
  expect_refused("a.ply", ply("ascii", elements, three + "3 0 1 3\n"), "line 13: a face refers to vertex 3 of 3");
  expect_refused("a.ply", ply("ascii", elements, three + "3 0 1 -1\n"), "vertex -1 of 3");
  expect_refused("a.ply", ply("ascii", elements, three + "3 0 1 1.5\n"), "not of the type");
  expect_refused("a.ply", ply("ascii", elements, three + "2 0 1\n"), "a face has 2 corners");
  expect_refused("a.ply", ply("ascii", elements, three + "4 0 1 2\n"), "fewer values");
  expect_refused("a.ply", ply("ascii", elements, three + "3 0 1 2 0\n"), "more values");
  expect_refused("a.ply", ply("ascii", elements, three), "cut off");
  expect_refused("a.ply", ply("ascii", vertices("1"), "1 2 x\n"), "line 8: 'x' is not a number");
  expect_refused("a.ply", ply("ascii", vertices("1"), "nan 1 2\n"), "no point with finite");
  const std::string binary = bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f});
  const auto little = [&](const std::string& tail) { return ply("binary_little_endian", elements, binary + tail); };
  EXPECT_EQ(test::scan_of("a.ply", little("\x03" + bytes_of({0, 1, 2}))).faces.size(), 1u);
  expect_refused("a.ply", little("\x03" + bytes_of({0, 1})), "cut off");
  expect_refused("a.ply", little("\xff" + bytes_of({0, 1, 2})), "cut off");
  expect_refused("a.ply", little("\x03" + bytes_of({0, 1, INT32_MIN})), "refers to vertex -2147483648");
  expect_refused("a.ply",
                 ply("binary_little_endian", vertices("3") + "element face 1\nproperty list int int vertex_indices\n",
                     binary + bytes_of({-3, 0, 1, 2})),
                 "negative length");
}

std::string vtp() {
  const TemporaryFolder folder;
  Scan scan;
  for (int i = 0; i < 30; ++i) scan.points.emplace_back(i * 0.1, i * i, -i);
  scan.normals.assign(30, Vec3::UnitZ());
  for (Index i = 0; i + 2 < 30; ++i) scan.faces.add(i, i + 1, i + 2);
  scan.fields.push_back({"k_min", Field::Type::Float64, std::vector<double>(30, 0.5)});
  write_scan(folder.file("a.vtp"), scan);
  return test::content_of(folder.file("a.vtp"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string ascii_vtp(const std::string& connectivity, const std::string& offsets, const char* kind = "Polys") {
  const std::string count = std::string("NumberOf") + kind + "=\"1\"";
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"4\" " +
         count +
         "><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points><" +
         kind +
         "><DataArray type=\"Int64\" "
         "Name=\"connectivity\" format=\"ascii\">" +
         connectivity +
         "</DataArray><DataArray type=\"Int64\" "
         "Name=\"offsets\" format=\"ascii\">" +
         offsets + "</DataArray></" + kind + "></Piece></PolyData></VTKFile>\n";
}

TEST(Vtp, PolygonsAndStrips) {
  EXPECT_EQ(test::scan_of("a.vtp", ascii_vtp("0 1 3 2", "4")).faces[0].size(), 4u);
  const Scan strips = test::scan_of("a.vtp", ascii_vtp("0 1 2 3", "4", "Strips"));
  ASSERT_EQ(strips.faces.size(), 2u);
  EXPECT_EQ(strips.faces.corners(), (std::vector<Index>{0, 1, 2, 2, 1, 3}));
}

TEST(RefusedVtp, StructureAndCells) {
  expect_refused("a.vtp", "hello\n", "cannot be read as a VTP file");
  expect_refused("a.vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\"></VTKFile>\n", "cannot be read");
  expect_refused("a.vtp", ascii_vtp("0 1 9", "3"), "refers to point 9 of 4");
  expect_refused("a.vtp", ascii_vtp("0 1 -1", "3"), "refers to point -1 of 4");
  expect_refused("a.vtp", ascii_vtp("0 1", "2"), "2 corners");
  expect_refused("a.vtp", replaced(vtp(), "NumberOfPoints=\"30\"", "NumberOfPoints=\"1000000000000\""),
                 "promises 1000000000000 points");
  expect_refused("a.vtp", replaced(vtp(), "NumberOfPoints=\"30\"", "NumberOfPoints=\"-30\""),
                 "NumberOfPoints is '-30'");
  expect_refused("a.vtp", replaced(vtp(), "NumberOfPoints=\"30\"", "NumberOfPoints=\"4000000000\""),
                 "does not hold its");
  expect_refused("a.vtp", replaced(vtp(), "</Piece>", "</Piece><Piece>"), "has 2 pieces");
  expect_refused("a.vtp", replaced(vtp(), "header_type", "compressor=\"vtkLZ4DataCompressor\" header_type"),
                 "not zlib");
  expect_refused("a.vtp", replaced(vtp(), "offset=\"0\"", "offset=\"99999999\""), "does not hold its 90 values");
  expect_refused("a.vtp", vtp().substr(0, 2000), "does not hold its");
  expect_refused("a.vtp", ascii_vtp("0 1 2", "4"), "offsets out of range");
  expect_refused("a.vtp", ascii_vtp("0 1 2", "3 3"), "does not hold its 1 values");
  expect_refused("a.vtp", replaced(ascii_vtp("0 1 2", "3"), "0 0 0 1", "0 0 x 1"), "does not hold its 12 values");
}

/// Reads a damaged file: any outcome but a crash, or an exception of another kind, will do.
void read_anyhow(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
  try {
    const Scan scan = read_scan(folder.write(name, content));
    for (const Index corner : scan.faces.corners()) ASSERT_LT(corner, scan.points.size());
    ASSERT_TRUE(scan.normals.empty() || scan.normals.size() == scan.points.size());
    for (const Field& field : scan.fields) ASSERT_EQ(field.values.size(), scan.points.size());
  } catch (const Error& error) {
    ASSERT_EQ(error.code(), ErrorCode::FileFormat) << error.what();
  }
}

/// A sound file of each format.
std::vector<std::pair<std::string, std::string>> sound_files() {
  return {{"a.vtp", vtp()},
          {"a.ply", ply("binary_little_endian", vertices("3") + faces("1"),
                        bytes_of({0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) + "\x03" + bytes_of({0, 1, 2}))},
          {"b.ply", ply("ascii", vertices("3") + faces("1"), "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")},
          {"a.pcd", pcd(kXyz, "WIDTH 3", "ascii\n1 2 3\n4 5 6\n7 8 9\n")},
          {"b.pcd", compressed(13, 12, "\x0b" + bytes_of({1.f, 2.f, 3.f}))},
          {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 -1//-1\n"},
          {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
          {"a.stl",
           "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
           "endfacet\nendsolid a\n"},
          {"a.csv", "x,y,z,nx,ny,nz,label\n1,2,3,0,0,1,6\n4,5,6,1,0,0,2\n"}};
}

TEST(DamagedFiles, CutAtEveryByte) {
  const TemporaryFolder folder;
  testing::internal::CaptureStderr();
  for (const auto& [name, content] : sound_files()) {
    SCOPED_TRACE(name);
    const std::size_t step = content.size() > 1000 ? 37 : 1;
    for (std::size_t size = 1; size < content.size(); size += step) read_anyhow(folder, name, content.substr(0, size));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(DamagedFiles, RandomBytesChanged) {
  const TemporaryFolder folder;
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  testing::internal::CaptureStderr();
  for (const auto& [name, content] : sound_files()) {
    SCOPED_TRACE(name);
    for (int trial = 0; trial < 300; ++trial) {
      std::string damaged = content;
      for (unsigned k = 0; k <= random() % 3; ++k) {
        const char digits[] = "0123456789-";
        damaged[random() % damaged.size()] =
            random() % 2 ? static_cast<char>(random() % 256) : digits[random() % (sizeof digits - 1)];
      }
      read_anyhow(folder, name, damaged);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(RefusedFiles, ByNameOrKind) {
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& path, ErrorCode code, const char* part) {
    test::expect_error([&] { read_scan(path); }, code, part);
  };
  refuses(folder.file("none.ply"), ErrorCode::FileNotFound, "does not exist");
  refuses(folder.path(), ErrorCode::FileNotFound, "is a folder");
  refuses("/dev/null", ErrorCode::FileFormat, "not a regular file");
  refuses(folder.write("a.las", "LASF"), ErrorCode::FileFormat, "fewer than the 227");
  refuses(folder.write("a.e57", "x"), ErrorCode::FileFormat, "E57 is not read");
  refuses(folder.write("a.vol", "x"), ErrorCode::FileFormat, "voxel volumes");
  refuses(folder.write("a.vtk", "x"), ErrorCode::FileFormat, "save it as .vtp");
  refuses(folder.write("a.doc", "x"), ErrorCode::FileFormat, ".ply .pcd .csv .vtp .las .obj .off .stl .xyz .pts .txt");
  refuses(folder.write("a", "x"), ErrorCode::FileFormat, "the extension ''");
  refuses(folder.write("b.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 9\n"),
          ErrorCode::FileFormat, "git lfs pull");
  for (const std::string& extension : readable_extensions()) {
    refuses(folder.write("empty" + extension, ""), ErrorCode::FileFormat, "is empty");
  }
}

}  // namespace
}  // namespace kappa
