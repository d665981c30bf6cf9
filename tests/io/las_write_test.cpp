// SPDX-License-Identifier: BSD-3-Clause
// Writing of LAS 1.4: what came in leaves bit for bit, curvatures and labels as extra bytes, other scans as LAS.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "kappa/core/bounds.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"
#include "las_files.hpp"
#include "support.hpp"

namespace kappa {
namespace {

namespace fs = std::filesystem;
using test::LasSpec;
using test::scan_of;

std::string written(const Scan& scan) {
  const test::TemporaryFolder folder;
  write_scan(folder.file("out.las"), scan);
  return test::content_of(folder.file("out.las"));
}

/// Equal but for trailing extra bytes that `after` may have.
void expect_same_points(const LasFile& before, const LasFile& after) {
  ASSERT_EQ(before.point_count(), after.point_count());
  ASSERT_LE(before.record_length, after.record_length);
  for (std::size_t i = 0; i < before.point_count(); ++i) {
    ASSERT_EQ(before.points.compare(i * before.record_length, before.record_length, after.points,
                                    i * after.record_length, before.record_length),
              0)
        << "point " << i;
  }
}

void expect_same_records(const std::vector<LasRecord>& before, const std::vector<LasRecord>& after) {
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].reserved, after[i].reserved);
    EXPECT_EQ(before[i].user_id, after[i].user_id);
    EXPECT_EQ(before[i].id, after[i].id);
    EXPECT_EQ(before[i].description, after[i].description);
    EXPECT_EQ(before[i].data, after[i].data);
  }
}

void expect_same_fields(const Scan& before, const Scan& after) {
  ASSERT_EQ(before.fields.size(), after.fields.size());
  for (std::size_t k = 0; k < before.fields.size(); ++k) {
    EXPECT_EQ(before.fields[k].name, after.fields[k].name);
    EXPECT_EQ(before.fields[k].type, after.fields[k].type);
    const auto& a = before.fields[k].values;
    EXPECT_TRUE(std::equal(a.begin(), a.end(), after.fields[k].values.begin(), test::same_bits))
        << before.fields[k].name;
  }
}

/// File source, GUID, system identifier, generating software, day and year.
void expect_same_identity(const std::string& before, const std::string& after) {
  EXPECT_EQ(before.substr(4, 2), after.substr(4, 2));
  EXPECT_EQ(before.substr(8, 16), after.substr(8, 16));
  EXPECT_EQ(before.substr(26, 68), after.substr(26, 68));
  EXPECT_EQ(before.substr(131, 48), after.substr(131, 48)) << "scale and offset";
}

void expect_round_trip(const std::string& bytes) {
  const Scan before = scan_of("a.las", bytes);
  const std::string out = written(before);
  const Scan after = scan_of("a.las", out);
  EXPECT_EQ(test::number_at<std::uint16_t>(out, 24), 0x0401) << "version 1.4";
  EXPECT_EQ(las_of(before)->points, las_of(after)->points);
  expect_same_records(las_of(before)->records, las_of(after)->records);
  expect_same_records(las_of(before)->extended, las_of(after)->extended);
  EXPECT_EQ(las_of(before)->waveform, las_of(after)->waveform);
  EXPECT_EQ(las_of(before)->gap, las_of(after)->gap);
  EXPECT_EQ(las_of(before)->format, las_of(after)->format);
  expect_same_identity(bytes, out);
  EXPECT_EQ(before.origin, after.origin);
  EXPECT_EQ(before.points, after.points);
  expect_same_fields(before, after);
  EXPECT_EQ(written(after), out) << "writing is not idempotent";
}

TEST(LasRoundTrip, EveryVersionAndFormat) {
  for (const LasSpec& spec : test::las_matrix()) {
    SCOPED_TRACE("LAS 1." + std::to_string(spec.minor) + " format " + std::to_string(spec.format));
    expect_round_trip(test::las_file(spec));
  }
}

TEST(LasRoundTrip, RealFiles) {
  if (!fs::exists(KAPPA_SHARED_DATA "/lidar")) GTEST_SKIP() << "no real data at " << KAPPA_SHARED_DATA;
  std::size_t files = 0;
  for (const char* folder : {"airborne-las", "las-formats", "terrestrial"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(KAPPA_SHARED_DATA "/lidar") / folder)) {
      if (entry.path().extension() != ".las") continue;
      SCOPED_TRACE(entry.path());
      expect_round_trip(test::content_of(entry.path()));
      ++files;
    }
  }
  EXPECT_GE(files, 21u);
}

TEST(LasRoundTrip, BytesBehindTheHeaderOfItsVersionStay) {
  LasSpec spec;
  std::string file = test::las_file(spec);
  file.insert(227, "surplus");
  test::patch<std::uint16_t>(file, 94, 234);
  test::patch<std::uint32_t>(file, 96, 234);
  EXPECT_EQ(written(scan_of("a.las", file)).substr(375, 7), "surplus");
}

TEST(LasHeader, CountsReturnsAndBoundsFollowFromThePoints) {
  for (const LasSpec& spec : test::las_matrix()) {
    SCOPED_TRACE("LAS 1." + std::to_string(spec.minor) + " format " + std::to_string(spec.format));
    const std::string out = written(scan_of("a.las", test::las_file(spec)));
    const std::string points = test::las_points(spec);
    std::map<int, std::uint64_t> returns;
    for (std::size_t i = 0; i < spec.points; ++i) {
      ++returns[points[i * (points.size() / spec.points) + 14] & (spec.format < 6 ? 7 : 15)];
    }
    EXPECT_EQ(test::number_at<std::uint64_t>(out, 247), spec.points);
    EXPECT_EQ(test::number_at<std::uint32_t>(out, 107), spec.format < 6 ? spec.points : 0);
    for (int r = 1; r <= 15; ++r) {
      EXPECT_EQ(test::number_at<std::uint64_t>(out, 255 + 8 * static_cast<std::size_t>(r - 1)), returns[r]) << r;
    }
    EXPECT_EQ(test::number_at<std::uint32_t>(out, 111), spec.format < 6 ? returns[1] : 0);
    EXPECT_NEAR(test::number_at<double>(out, 179), (1234567 + 211 * 4) * 0.01 + 500000, 1e-8) << "largest x";
    EXPECT_NEAR(test::number_at<double>(out, 187), 1234567 * 0.01 + 500000, 1e-8) << "least x";
  }
}

TEST(LasHeader, TheWaveformsAreWhereItSays) {
  LasSpec spec;
  spec.minor = 3;
  spec.format = 4;
  spec.waveform = true;
  spec.extended = {test::las_extended("LASF_Spec", 65535, "packets")};
  const std::string out = written(scan_of("a.las", test::las_file(spec)));
  const auto start = test::number_at<std::uint64_t>(out, 227);
  EXPECT_EQ(out.substr(start), test::las_extended("LASF_Spec", 65535, "packets"));
  EXPECT_EQ(test::number_at<std::uint64_t>(out, 235), start);
}

TEST(LasHeader, EncodingBitsThatTheVersionDidNotDefineAreLeftOut) {
  const std::uint16_t defined[] = {0, 0, 1, 15, 0xffff};
  for (std::uint8_t minor = 0; minor <= 4; ++minor) {
    LasSpec spec;
    spec.minor = minor;
    spec.encoding = 0xffff;
    EXPECT_EQ(test::number_at<std::uint16_t>(written(scan_of("a.las", test::las_file(spec))), 6), defined[minor]);
  }
}

/// Fields of the kinds that a measurement adds: reals without a value at some point, and small and large integers.
std::vector<Field> some_curvatures(std::size_t points) {
  std::vector<Field> fields = {{"mean_curvature", Field::Type::Float64, {}},
                               {"face_count", Field::Type::UInt32, std::vector<double>(points, 70000)},
                               {"status", Field::Type::UInt8, std::vector<double>(points, 0)}};
  for (std::size_t i = 0; i < points; ++i)
    fields[0].values.push_back(i == 0 ? kNaN : 1.0 / 3.0 / static_cast<double>(i));
  fields[2].values[0] = 1;
  return fields;
}

/// The scan with normals, curvatures, labels and regions.
Scan measured(Scan scan) {
  const std::size_t points = scan.points.size();
  scan.normals.assign(points, Vec3(0.6, 0, 0.8));
  scan.normals[0].setConstant(kNaN);
  for (Field& field : some_curvatures(points)) scan.fields.push_back(std::move(field));
  scan.fields.push_back({"label", Field::Type::UInt8, std::vector<double>(points, 6)});
  scan.fields.push_back({"region", Field::Type::UInt32, std::vector<double>(points, 4e9)});
  return scan;
}

TEST(LasCurvatures, AreNamedExtraBytesBehindAllThatCameIn) {
  for (const LasSpec& spec : test::las_matrix()) {
    SCOPED_TRACE("LAS 1." + std::to_string(spec.minor) + " format " + std::to_string(spec.format));
    const Scan in = scan_of("a.las", test::las_file(spec)), out = measured(in);
    const Scan again = scan_of("a.las", written(out));
    expect_same_points(*las_of(in), *las_of(again));
    ASSERT_EQ(again.normals.size(), out.normals.size());
    EXPECT_TRUE(again.normals[0].hasNaN());
    EXPECT_EQ(again.normals[1], out.normals[1]);
    expect_same_fields(out, again);
    EXPECT_EQ(again.field("status")->type, Field::Type::UInt8);
    EXPECT_EQ(again.field("mean_curvature")->type, Field::Type::Float64);
  }
}

TEST(LasCurvatures, AreDescribedAsTheStandardHasIt) {
  LasSpec spec;
  spec.extra = 300;  // more undescribed bytes than one descriptor can cover
  Scan scan = scan_of("a.las", test::las_file(spec));
  scan.fields.push_back({"region", Field::Type::UInt32, {1, 2, 3, 4, 5}});
  const std::string out = written(scan);
  ASSERT_EQ(test::number_at<std::uint32_t>(out, 100), 1u);
  EXPECT_EQ(out.substr(375 + 2, 10), std::string("LASF_Spec\0", 10));
  EXPECT_EQ(test::number_at<std::uint16_t>(out, 375 + 18), 4);
  ASSERT_EQ(test::number_at<std::uint16_t>(out, 375 + 20), 3 * 192);
  const std::size_t first = 375 + 54;
  EXPECT_EQ(test::number_at<std::uint16_t>(out, first + 2), 255 << 8) << "type 0, 255 bytes";
  EXPECT_EQ(test::number_at<std::uint16_t>(out, first + 192 + 2), 45 << 8) << "type 0, 45 bytes";
  EXPECT_EQ(test::number_at<std::uint16_t>(out, first + 384 + 2), 5) << "unsigned long";
  EXPECT_EQ(out.substr(first + 384 + 4, 7), std::string("region\0", 7));
  EXPECT_EQ(test::number_at<std::uint16_t>(out, 105), 20 + 300 + 4);
}

TEST(LasCurvatures, OfASecondRunTakeThePlaceOfTheFirst) {
  LasSpec spec;
  const Scan first = scan_of("a.las", written(measured(scan_of("a.las", test::las_file(spec)))));
  Scan second = first;
  const auto mean = std::find_if(second.fields.begin(), second.fields.end(),
                                 [](const Field& f) { return f.name == "mean_curvature"; });
  std::iota(mean->values.begin(), mean->values.end(), 0.5);
  const Scan again = scan_of("a.las", written(second));
  EXPECT_EQ(las_of(again)->record_length, las_of(first)->record_length);
  EXPECT_EQ(again.field("mean_curvature")->values, mean->values);
  expect_same_fields(second, again);
}

TEST(LasFields, AChangedAttributeIsStoredInItsPlace) {
  LasSpec spec;
  Scan scan = scan_of("a.las", test::las_file(spec));
  const auto classes =
      std::find_if(scan.fields.begin(), scan.fields.end(), [](const Field& f) { return f.name == "classification"; });
  classes->values.assign(5, 2);
  const Scan again = scan_of("a.las", written(scan));
  EXPECT_EQ(again.field("classification")->values, classes->values);
  EXPECT_EQ(again.field("withheld")->values, scan.field("withheld")->values) << "in the same byte";
  classes->values[3] = 32;
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "'classification' holds 32.000000 at point 3");
}

TEST(LasFields, NamesAndSizesThatLasCannotHoldAreRefused) {
  Scan scan;
  scan.points = {{0, 0, 0}};
  scan.fields = {{std::string(33, 'n'), Field::Type::UInt8, {1}}};
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "at most 32 characters");
  scan.fields.clear();
  for (int i = 0; i < 342; ++i) scan.fields.push_back({"f" + std::to_string(i), Field::Type::UInt8, {1}});
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "more attributes than LAS can hold");
  scan.fields.pop_back();
  EXPECT_EQ(scan_of("a.las", written(scan)).field("f340")->values, std::vector<double>{1});
}

Scan cloud() {
  Scan scan;
  scan.origin = Vec3(512000, 5402000, 300);
  for (int i = 0; i < 200; ++i) scan.points.push_back(Vec3(0.37 * i, std::sin(i) * 80, std::sqrt(i)));
  scan.normals.assign(200, Vec3(0, 0, 1));
  return scan;
}

TEST(LasFromOtherScans, KeepsThePrecisionThatIsPromised) {
  const Scan scan = cloud(), again = scan_of("a.las", written(scan));
  ASSERT_EQ(again.points.size(), scan.points.size());
  const Bounds box = bounds(scan.points);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3 error = (again.origin - scan.origin) + again.points[i] - scan.points[i];
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LE(std::abs(error[axis]), 2.5e-9 * (box.max - box.min)[axis] + 1e-9) << i;
    }
  }
  EXPECT_EQ(las_of(again)->scale.x(), 1e-3) << "as all x are whole millimetres";
  EXPECT_LT(las_of(again)->scale.y(), 1e-6);
  EXPECT_EQ(again.normals, scan.normals);
  EXPECT_EQ(again.field("return_number")->values, std::vector<double>(200, 1));
}

TEST(LasFromOtherScans, AttributesOfLasTakeTheirPlaces) {
  Scan scan = cloud();
  for (const char* name : {"red", "green", "blue", "nir", "classification", "gps_time"}) {
    scan.fields.push_back({name, Field::Type::UInt16, std::vector<double>(200, 7)});
  }
  scan.fields.push_back({"intensity", Field::Type::Float32, std::vector<double>(200, 0.5)});
  const std::string out = written(scan);
  EXPECT_EQ(out[104], 8);
  const Scan again = scan_of("a.las", out);
  EXPECT_EQ(las_of(again)->record_length, 38u + 4 + 24) << "intensity, a float, and the normals are extra bytes";
  for (const Field& field : scan.fields) {
    ASSERT_NE(again.field(field.name), nullptr) << field.name;
    EXPECT_EQ(again.field(field.name)->values, field.values) << field.name;
  }
  scan.fields.clear();
  EXPECT_EQ(written(scan)[104], 6);
}

TEST(LasFromOtherScans, TinyHugeAndFlatOnes) {
  for (const double size : {1e-9, 1e-3, 1.0, 1e9}) {
    for (const Vec3& direction : {Vec3(1, 0.3, 0), Vec3(0, 0, 0)}) {
      Scan scan;
      for (int i = 0; i < 7; ++i) scan.points.push_back(size * i / 7.0 * direction + Vec3(size, -size, 0));
      const Scan again = scan_of("a.las", written(scan));
      for (std::size_t i = 0; i < scan.points.size(); ++i) {
        ASSERT_LE((test::position(again, i) - scan.points[i]).norm(), 1e-8 * size) << size;
      }
    }
  }
}

TEST(LasFromOtherScans, MissingPointsAreRefused) {
  Scan scan = cloud();
  scan.points[17].z() = kNaN;
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "z of point 17 is not finite");
}

TEST(LasPoints, MovedOnesAreStoredWhereTheyAre) {
  LasSpec spec;
  Scan scan = scan_of("a.las", test::las_file(spec));
  const Vec3 before = test::position(scan, 2);
  scan.points[2].x() += 12.34;
  const Scan again = scan_of("a.las", written(scan));
  EXPECT_LE((test::position(again, 2) - before - Vec3(12.34, 0, 0)).cwiseAbs().maxCoeff(), 2e-9);
  EXPECT_EQ(test::position(again, 3), test::position(scan, 3));
  scan.points[2].x() = 1e9;
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "x of point 2 is");
}

TEST(KeepPoints, TakesRecordsFieldsAndNormalsAlong) {
  LasSpec spec;
  const Scan all = scan_of("a.las", test::las_file(spec));
  Scan some = all;
  some.normals.assign(5, Vec3(0, 1, 0));
  keep_points(some, {4, 1});
  const Scan again = scan_of("a.las", written(some));
  ASSERT_EQ(again.points.size(), 2u);
  EXPECT_EQ(las_of(again)->points.substr(0, 20), las_of(all)->points.substr(80, 20));
  EXPECT_EQ(las_of(again)->points.substr(las_of(again)->record_length, 20), las_of(all)->points.substr(20, 20));
  EXPECT_EQ(test::position(again, 1), test::position(all, 1));
  EXPECT_EQ(again.field("intensity")->values[0], all.field("intensity")->values[4]);
  EXPECT_EQ(again.normals, some.normals);
}

TEST(KeepPoints, RefusesWhatItCannotDo) {
  Scan scan = scan_of("a.las", test::las_file({}));
  test::expect_error([&] { keep_points(scan, {5}); }, ErrorCode::InvalidArgument, "point 5 cannot be kept");
  scan.points.pop_back();
  for (Field& field : scan.fields) field.values.pop_back();
  test::expect_error([&] { keep_points(scan, {0}); }, ErrorCode::InvalidArgument, "4 points and 5 records");
  test::expect_error([&] { written(scan); }, ErrorCode::InvalidArgument, "4 points and 5 records");
  scan.records = nullptr;
  scan.faces.add(0, 1, 2);
  test::expect_error([&] { keep_points(scan, {0}); }, ErrorCode::InvalidArgument, "points of a mesh");
}

}  // namespace
}  // namespace kappa
