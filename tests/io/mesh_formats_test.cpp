// SPDX-License-Identifier: BSD-3-Clause
// OBJ, OFF and STL, given as text or bytes.
#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::bytes_of;
using test::expect_refused;
using test::position;
using test::scan_of;

std::vector<Index> corners(const Scan& scan, std::size_t face) {
  return {scan.faces[face].begin(), scan.faces[face].end()};
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, AllFormsOfACorner) {
  const Scan scan = scan_of("a.obj", kSquare +
                                         "vt 0 0\nvn 0 0 2\nf 1 2 3\nf 1/1 2/1 3/1 4/1\nf 2//1 3//1 4//1\n"
                                         "f 1/1/1 2/1/1 4/1/1\nf -4 -2 -1\n");
  ASSERT_EQ(scan.faces.size(), 5u);
  EXPECT_EQ(corners(scan, 1), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(corners(scan, 4), (std::vector<Index>{0, 2, 3}));
  for (const Vec3& normal : scan.normals) EXPECT_EQ(normal, Vec3(0, 0, 2));  // as in the file
}

TEST(Obj, RelativeIndicesCountFromTheirLine) {
  const Scan scan = scan_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -3 -2 -1\n");
  EXPECT_EQ(corners(scan, 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(corners(scan, 1), (std::vector<Index>{1, 2, 3}));
}

TEST(Obj, IndicesMayComeBeforeTheirVertices) {
  EXPECT_EQ(corners(scan_of("a.obj", "f 1 2 4\n" + kSquare), 0), (std::vector<Index>{0, 1, 3}));
}

TEST(Obj, DistinctNormalsOfCornersAreAveraged) {
  // Vertex 1 sees (0,0,1) three times, once under another number, and (1,0,0) once.
  const Scan scan = scan_of("a.obj", kSquare +
                                         "vn 0 0 1\nvn 1 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n"
                                         "f 1//2 2//1 4//1\nf 1//3 2//1 4\n");
  ASSERT_EQ(scan.normals.size(), 4u);
  EXPECT_NEAR((scan.normals[0] - Vec3(1, 0, 1).normalized()).norm(), 0, 1e-15);
  EXPECT_EQ(scan.normals[3], Vec3(0, 0, 1));
}

TEST(Obj, CloudWithNormalsAndColours) {
  const Scan scan = scan_of("a.obj", "v 1 2 3 0.5 0.25 1\nvn 0 1 0\nv 4 5 6 0 0 0\nvn 1 0 0\n");
  EXPECT_FALSE(scan.is_mesh());
  ASSERT_EQ(scan.normals.size(), 2u);
  EXPECT_EQ(scan.normals[1], Vec3(1, 0, 0));
  ASSERT_NE(scan.field("green"), nullptr);
  EXPECT_EQ(scan.field("green")->values[0], 0.25);
}

TEST(Obj, ContinuedLinesAndWhatIsIgnored) {
  const Scan scan = scan_of("a.obj",
                            "mtllib a.mtl\no thing\r\ng part\n# comment\nv 0 0 \\\n0\nv 1 0 0 1.0\nv 0 1 0 # c\n"
                            "usemtl m\ns off\nl 1 2\np 1\nf 1 \\\r\n2 \\\n3\n");
  ASSERT_EQ(scan.points.size(), 3u);
  ASSERT_EQ(scan.faces.size(), 1u);
  EXPECT_EQ(corners(scan, 0), (std::vector<Index>{0, 1, 2}));
}

TEST(Obj, KeepsDoubles) {
  EXPECT_EQ(position(scan_of("a.obj", "v 512700.123456789 5403547.987654321 0.1\n"), 0),
            Vec3(512700.123456789, 5403547.987654321, 0.1));
}

TEST(Obj, RefusedWithTheLine) {
  expect_refused("a.obj", kSquare + "f 1 2 0\n", "line 5: refers to vertex 0");
  expect_refused("a.obj", kSquare + "f 1 2 5\nf 1 2 3\n", "line 5: refers to vertex 5 of 4");
  expect_refused("a.obj", kSquare + "f 1 2 -5\n", "line 5: refers to vertex -5");
  expect_refused("a.obj", kSquare + "f 1 2 2147483649\n", "refers to vertex 2147483649 of 4");
  expect_refused("a.obj", kSquare + "f 1 2 4294967297\n", "refers to vertex 4294967297 of 4");
  expect_refused("a.obj", kSquare + "f 1 2 -9223372036854775808\n", "refers to vertex -9223372036854775808");
  expect_refused("a.obj", kSquare + "f 1 2 99999999999999999999\n", "is not an index");
  expect_refused("a.obj", kSquare + "f 1//1 2//1 3//1\n", "line 5: refers to normal 1 of 0");
  expect_refused("a.obj", kSquare + "f 1 2\n", "line 5: a face has 2 corners");
  expect_refused("a.obj", kSquare + "f 1 2 x\n", "line 5: 'x' is not an index");
  expect_refused("a.obj", "v 1 2\n", "line 1: a vertex has 2 numbers");
  expect_refused("a.obj", "v 1 2 3 4 5\n", "a vertex has 5 numbers");
  expect_refused("a.obj", "v 1 2 3\nv 1 2 a\n", "line 2: 'a' is not a number");
  expect_refused("a.obj", "vn 1 2\nv 1 2 3\n", "line 1: a normal must have three numbers");
}

TEST(Off, KeywordAndCountsInAllForms) {
  const std::string body = "0 0 0\n1 0 0\n1 1 0 # corner\n\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5\n3 0 1 2\n";
  for (const std::string head :
       {"OFF\n4 2 0\n", "OFF 4 2 0\n", "# first\nOFF\n# counts\n\n4 2\n", "4 2 0\n", "OFF # mesh\n4 2 5\n"}) {
    SCOPED_TRACE(head);
    const Scan scan = scan_of("a.off", head + body);
    ASSERT_EQ(scan.points.size(), 4u);
    ASSERT_EQ(scan.faces.size(), 2u);
    EXPECT_EQ(corners(scan, 0), (std::vector<Index>{0, 1, 2, 3}));
    EXPECT_EQ(corners(scan, 1), (std::vector<Index>{0, 1, 2}));
  }
}

TEST(Off, NormalsAndColours) {
  const Scan scan = scan_of("a.off", "STCNOFF\n1 0 0\n1 2 3 0 0 1 10 20 30 255 0.5 0.5\n");
  EXPECT_EQ(position(scan, 0), Vec3(1, 2, 3));
  EXPECT_EQ(scan.normals[0], Vec3(0, 0, 1));
  ASSERT_NE(scan.field("blue"), nullptr);
  EXPECT_EQ(scan.field("blue")->values[0], 30);
}

TEST(Off, RefusedWithTheLine) {
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: a face refers to vertex 3 of 3");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "vertex -1 of 3");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "fewer corners than it says");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "begins with '2'");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n99999999999 0 1\n", "fewer corners than it says");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "ends before its last vertex");
  expect_refused("a.off", "OFF\n1 0 0\n0 0 0\n3 0 0 0\n", "line 4: follows the 0 faces");
  expect_refused("a.off", "OFF\n1000000000000 1 0\n0 0 0\n", "promises 1000000000000 vertices");
  expect_refused("a.off", "OFF\n-1 1 0\n0 0 0\n", "is '-1'");
  expect_refused("a.off", "OFF BINARY\n", "binary OFF is not read");
  expect_refused("a.off", "4OFF\n1 0 0\n0 0 0 1\n", "variant '4OFF'");
  expect_refused("a.off", "nOFF\n3\n1 0 0\n", "variant 'nOFF'");
  expect_refused("a.off", "hello\n", "not an OFF file");
}

std::string binary_stl(std::uint32_t count, int triangles) {
  std::string bytes = "solid in spite of its name";
  bytes.resize(80, ' ');
  bytes += bytes_of({count});
  for (int i = 0; i < triangles; ++i) {
    const float z = static_cast<float>(i);
    bytes += bytes_of({0.f, 0.f, 1.f, 0.f, 0.f, z, 1.f, -0.f, z, 0.f, 1.f, 0.f}) + std::string(2, '\0');
  }
  return bytes;
}

TEST(Stl, BinaryVerticesAreMerged) {
  const Scan scan = scan_of("a.stl", binary_stl(2, 2));
  ASSERT_EQ(scan.faces.size(), 2u);
  EXPECT_EQ(scan.points.size(), 5u);  // (0,1,0) is shared
  EXPECT_EQ(corners(scan, 0)[2], corners(scan, 1)[2]);
  EXPECT_EQ(position(scan, corners(scan, 1)[1]), Vec3(1, 0, 1));
}

TEST(Stl, AsciiKeepsDoubles) {
  const Scan scan = scan_of("a.stl",
                            "solid part of mine\n FACET NORMAL 0 0 1\n outer loop\n vertex 512700.123456789 0 0\n"
                            "vertex 1 0 0\nvertex 0 1 -0.0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                            "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid part\n");
  ASSERT_EQ(scan.faces.size(), 2u);
  EXPECT_EQ(scan.points.size(), 4u);
  EXPECT_EQ(position(scan, 0).x(), 512700.123456789);
}

TEST(Stl, Refused) {
  std::string named = binary_stl(3, 2);
  named[0] = 'S';
  named[1] = '?';
  expect_refused("a.stl", named, "promises 3 triangles (234 bytes) but has 184 bytes");
  named.replace(80, 4, bytes_of({0xffffffffu}));
  expect_refused("a.stl", named, "promises 4294967295 triangles");
  expect_refused("a.stl", named.substr(0, 50), "too short");
  expect_refused("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n",
                 "line 7: a facet has 2 vertices");
  expect_refused("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "line 4: a vertex has fewer");
  expect_refused("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "ends before 'endsolid'");
  expect_refused("a.stl", "solid a\nvertex 0 0 0\n", "outside of a facet");
  expect_refused("a.stl", "solid a\nhello\n", "'hello' is no word of an ascii STL");
  expect_refused("a.stl", "solid a\nendsolid a\n", "holds no point");
}

}  // namespace
}  // namespace kappa
