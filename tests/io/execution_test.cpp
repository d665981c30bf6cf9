// SPDX-License-Identifier: BSD-3-Clause
// Progress and cancellation of every reader and writer.
#include <algorithm>
#include <functional>

#include "io/las/output.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/io/regions_table.hpp"
#include "las_files.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::TemporaryFolder;

constexpr std::size_t kSide = 150;  // points along a side of the mesh: every loop over them pauses

/// A square of triangles with normals, fields of several types and, as a cloud, without faces.
Scan square(bool with_faces) {
  Scan scan;
  for (std::size_t i = 0; i < kSide * kSide; ++i) {
    scan.points.emplace_back(static_cast<double>(i % kSide) / 7, static_cast<double>(i / kSide) / 7, 0.5);
    scan.normals.emplace_back(0, 0.6, 0.8);
  }
  scan.width = scan.points.size();
  const std::vector<double> values(scan.points.size(), 3);
  scan.fields = {{"mean_curvature", Field::Type::Float64, values},
                 {"rgb", Field::Type::Float32, values},
                 {"intensity", Field::Type::UInt16, values},
                 {"label", Field::Type::UInt8, values}};
  for (Index i = 0; with_faces && i + kSide + 1 < kSide * kSide; ++i) scan.faces.add(i, i + 1, i + kSide);
  return scan;
}

/// A line a row of three numbers, each behind `key`; blanks stand between the numbers, and a normal if asked.
std::string rows(const std::vector<Vec3>& numbers, const std::string& key, const std::string& normal = "") {
  std::ostringstream text;
  for (const Vec3& row : numbers) text << key << row.x() << ' ' << row.y() << ' ' << row.z() << normal << '\n';
  return text.str();
}

std::string obj(const Scan& scan) {
  std::ostringstream faces;
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    faces << 'f';
    for (const Index corner : scan.faces[f]) faces << ' ' << corner + 1 << "//" << corner + 1;
    faces << '\n';
  }
  return rows(scan.points, "v ") + rows(scan.normals, "vn ") + faces.str();
}

std::string off(const Scan& scan) {
  std::ostringstream text;
  text << "OFF\n" << scan.points.size() << ' ' << scan.faces.size() << " 0\n" << rows(scan.points, "");
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    const Faces::View face = scan.faces[f];
    text << "3 " << face[0] << ' ' << face[1] << ' ' << face[2] << '\n';
  }
  return text.str();
}

std::string ascii_stl(const Scan& scan) {
  std::ostringstream text;
  text << "solid\n";
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const Index corner : scan.faces[f]) text << rows({scan.points[corner]}, "vertex ");
    text << "endloop\nendfacet\n";
  }
  text << "endsolid\n";
  return text.str();
}

std::string binary_stl(const Scan& scan) {
  std::string bytes(80, ' ');
  test::append(bytes, static_cast<std::uint32_t>(scan.faces.size()));
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    bytes.append(12, '\0');
    for (const Index corner : scan.faces[f]) {
      for (int axis = 0; axis < 3; ++axis) test::append(bytes, static_cast<float>(scan.points[corner][axis]));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string pcd_header(const Scan& scan, const std::string& data) {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(scan.points.size()) +
         "\nHEIGHT 1\nDATA " + data + "\n";
}

/// LZF that holds the bytes as they are, up to 32 behind each control byte.
std::string stored_lzf(const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string run = bytes.substr(at, 32);
    out += static_cast<char>(run.size() - 1);
    out += run;
  }
  return out;
}

std::string compressed_pcd(const Scan& scan) {
  std::string columns, sizes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3& p : scan.points) test::append(columns, p[axis]);
  }
  const std::string stored = stored_lzf(columns);
  test::append(sizes, static_cast<std::uint32_t>(stored.size()));
  test::append(sizes, static_cast<std::uint32_t>(columns.size()));
  return pcd_header(scan, "binary_compressed") + sizes + stored;
}

std::string ascii_ply(const Scan& scan) {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << scan.points.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << scan.faces.size()
       << "\nproperty list uchar int vertex_indices\nelement edge " << scan.points.size()
       << "\nproperty float a\nproperty float b\nproperty float c\nend_header\n"
       << rows(scan.points, "");
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    const Faces::View face = scan.faces[f];
    text << "3 " << face[0] << ' ' << face[1] << ' ' << face[2] << '\n';
  }
  return text.str() + rows(scan.points, "");
}

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at + 2 < bytes.size(); at += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | static_cast<unsigned char>(bytes[at + k]);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[bits >> shift & 63];
  }
  return text;
}

/// The points alone, in an array of that format.
std::string vtp(const Scan& scan, const std::string& format, const std::string& content) {
  return "<VTKFile type=\"PolyData\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
         std::to_string(scan.points.size()) +
         "\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"" + format + "\">\n" + content +
         "</DataArray>\n</Points>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string inline_vtp(const Scan& scan) {
  std::string bytes;
  for (const Vec3& p : scan.points) {
    for (int axis = 0; axis < 3; ++axis) test::append(bytes, p[axis]);
  }
  std::string size;
  test::append(size, static_cast<std::uint64_t>(bytes.size()));
  bytes = size + bytes;
  bytes.resize((bytes.size() + 2) / 3 * 3);  // or padding would have to follow
  return vtp(scan, "binary", base64(bytes));
}

std::string las() {
  test::LasSpec spec;
  spec.minor = 4;
  spec.format = 7;
  spec.points = kSide * kSide;
  return test::las_file(spec);
}

std::string written(const std::string& extension, const Scan& scan) {
  const TemporaryFolder folder;
  write_scan(folder.file("a" + extension), scan);
  return test::content_of(folder.file("a" + extension));
}

struct Sample {
  std::string name, content;
};

/// A file of every extension that is read, in every encoding.
std::vector<Sample> samples() {
  const Scan mesh = square(true), cloud = square(false);
  const std::string table = rows(cloud.points, "", " 0 0 1");
  std::vector<Sample> all = {{"mesh.obj", obj(mesh)},
                             {"mesh.off", off(mesh)},
                             {"ascii.stl", ascii_stl(mesh)},
                             {"binary.stl", binary_stl(mesh)},
                             {"cloud.xyz", table},
                             {"cloud.pts", table},
                             {"cloud.txt", table},
                             {"ascii.pcd", pcd_header(cloud, "ascii") + rows(cloud.points, "")},
                             {"compressed.pcd", compressed_pcd(cloud)},
                             {"ascii.ply", ascii_ply(mesh)},
                             {"ascii.vtp", vtp(cloud, "ascii", rows(cloud.points, ""))},
                             {"inline.vtp", inline_vtp(cloud)},
                             {"points.las", las()}};
  for (const std::string& extension : writable_extensions()) {
    const std::vector<std::string>& meshes = writable_mesh_extensions();
    const bool keeps_faces = std::find(meshes.begin(), meshes.end(), extension) != meshes.end();
    all.push_back({"written" + extension, written(extension, keeps_faces ? mesh : cloud)});
  }
  return all;
}

using Call = std::function<void(const Execution&)>;

struct Outcome {
  bool is_cancelled = false;
  std::vector<double> reported;
};

/// What comes of a call that is cancelled in its report number `last`, from 0.
Outcome cancelled_in(std::size_t last, const Call& call) {
  Outcome outcome;
  std::atomic<bool> stop{false};
  Execution run;
  run.cancel = &stop;
  run.progress = [&](double done) {
    if (outcome.reported.size() == last) stop = true;
    outcome.reported.push_back(done);
  };
  try {
    call(run);
  } catch (const Cancelled&) {
    outcome.is_cancelled = true;
  }
  return outcome;
}

constexpr std::size_t kNever = static_cast<std::size_t>(-1);

/// Progress begins with 0, never decreases, is reported in between, and ends with 1.
void expect_good_progress(const Call& call) {
  const std::vector<double> reported = cancelled_in(kNever, call).reported;
  ASSERT_GE(reported.size(), 3u);
  EXPECT_EQ(reported.front(), 0.0);
  EXPECT_EQ(reported.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end())) << testing::PrintToString(reported);
  EXPECT_GT(reported[1], 0.0);
  EXPECT_LT(reported[1], 1.0);
}

/// Whenever it is cancelled in a report before the last, the call throws Cancelled. `check` looks at what it has left.
void expect_cancelled(
    const Call& call, const std::function<void()>& check = [] {}) {
  std::size_t k = 0;
  for (;; ++k) {
    const Outcome outcome = cancelled_in(k, call);
    if (outcome.reported.size() <= k || outcome.reported[k] == 1.0) break;
    EXPECT_TRUE(outcome.is_cancelled) << "report " << k << " at " << outcome.reported[k];
    check();
  }
  EXPECT_GE(k, 2u) << "no report before the last but the first";
}

TEST(ReadScan, ReportsProgressAndStopsInEveryFormat) {
  const TemporaryFolder folder;
  std::vector<std::string> tried;
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const std::string path = folder.write(sample.name, sample.content);
    const Call call = [&](const Execution& run) { read_scan(path, run); };
    ASSERT_GE(read_scan(path).points.size(), kSide * kSide - 1);
    expect_good_progress(call);
    expect_cancelled(call);
    tried.push_back(std::filesystem::path(path).extension().string());
  }
  for (const std::string& extension : readable_extensions()) {
    EXPECT_EQ(std::count(tried.begin(), tried.end(), extension) > 0, true) << "no sample of " << extension;
  }
}

TEST(ReadScan, ReportsProgressOfTheSmallestFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.xyz", "1 2 3\n");
  const Outcome outcome = cancelled_in(kNever, [&](const Execution& run) { read_scan(path, run); });
  EXPECT_EQ(outcome.reported, (std::vector<double>{0.0, 1.0}));
  EXPECT_TRUE(cancelled_in(0, [&](const Execution& run) { read_scan(path, run); }).is_cancelled);
}

TEST(ReadMesh, PassesProgressAndCancellationOn) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.off", off(square(true)));
  const Call call = [&](const Execution& run) { read_mesh(path, run); };
  expect_good_progress(call);
  expect_cancelled(call);
}

/// Calls `write(path, run)`, cancelled in every report: what was there before stays, and nothing else.
void expect_untouched_if_cancelled(const std::string& name,
                                   const std::function<void(const std::string&, const Execution&)>& write) {
  SCOPED_TRACE(name);
  const TemporaryFolder folder;
  const std::string path = folder.write(name, "before");
  const Call call = [&](const Execution& run) { write(path, run); };
  const auto check = [&] {
    EXPECT_TRUE(test::content_of(path) == "before") << "the target is changed";
    EXPECT_EQ(folder.size(), 1u) << "a temporary file is left";
    folder.write(name, "before");
  };
  expect_cancelled(call, check);
  EXPECT_TRUE(test::content_of(path) != "before") << "the last report comes when all is done";
  expect_good_progress(call);
}

TEST(WriteScan, LeavesNothingIfCancelledInAnyFormat) {
  for (const std::string& extension : writable_extensions()) {
    for (const bool with_faces : {false, true}) {
      const Scan scan = square(with_faces);
      expect_untouched_if_cancelled(
          "a" + extension, [&](const std::string& path, const Execution& run) { write_scan(path, scan, run); });
    }
  }
}

/// A scan from a LAS file of which most attributes are changed.
Scan changed_las() {
  Scan scan = test::scan_of("a.las", las());
  for (Field& field : scan.fields) field.values.assign(scan.points.size(), 1);
  return scan;
}

TEST(WriteScan, LeavesNothingIfALasFileIsCancelled) {
  const Scan scan = changed_las();
  expect_untouched_if_cancelled("a.las",
                                [&](const std::string& path, const Execution& run) { write_scan(path, scan, run); });
}

TEST(PlanLas, StopsInEveryReport) {
  for (const Scan& scan : {changed_las(), square(false)}) {
    const Call call = [&](const Execution& run) { io::plan_las(scan, run); };
    const Outcome whole = cancelled_in(kNever, call);
    ASSERT_FALSE(whole.reported.empty());
    for (std::size_t k = 0; k < whole.reported.size(); ++k) EXPECT_TRUE(cancelled_in(k, call).is_cancelled) << k;
  }
}

TEST(WriteRegions, LeavesNothingIfCancelled) {
  Segmentation segmentation;
  segmentation.table.resize(kSide * kSide);
  expect_untouched_if_cancelled("a.csv", [&](const std::string& path, const Execution& run) {
    write_regions(path, segmentation, Vec3::Zero(), run);
  });
}

}  // namespace
}  // namespace kappa
