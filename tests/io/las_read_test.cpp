// SPDX-License-Identifier: BSD-3-Clause
// Reading of LAS: real files with what their publisher or an independent program says, every version and format,
// the local origin, degrees.
#include <set>

#include "kappa/core/bounds.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"
#include "las_files.hpp"
#include "support.hpp"

namespace kappa {
namespace {

namespace fs = std::filesystem;
using test::LasSpec;
using test::scan_of;

struct Expected {
  const char* path;
  std::size_t points;
  Vec3 min, max;     ///< as published, to the digits that are given
  double tolerance;  ///< half of the last digit given
};

const std::vector<Expected>& expectations() {
  const Vec3 utm_min(493994.87, 4877429.62, 123.93), utm_max(494993.68, 4878817.02, 178.73);
  const Vec3 one(470692.44, 4602888.90, 16);
  static const std::vector<Expected> table = {
      {"airborne-las/hexbin-crop.las", 38367, {393775.82, 3689071.94, 3107.86}, {394069.24, 3689273.10, 3209.32}, 6e-3},
      {"airborne-las/autzen_trim.las", 110000, {636001.76, 848935.20, 406.26}, {637179.22, 849497.90, 520.51}, 1e-9},
      {"airborne-las/sample_c.las", 14408, {674521.92, 1206740.08, 627.5}, {674605.32, 1206814.96, 656.2}, 0.06},
      {"airborne-las/warsaw_small.las", 3000, {639913.26, 485143.14, 84.7}, {639946.75, 485175.91, 104.55}, 1e-9},
      {"airborne-las/epsg_4326.las", 5380, {-94.6834654, 31.0367341, 39.081}, {-94.6606311, 31.0473291, 78.119}, 1e-6},
      {"airborne-las/autzen-bmx-2010.las", 829, {194472.82, 259222.19, 422.93}, {194506.92, 259264.09, 434.51}, 1e-9},
      {"airborne-las/wontcompress3.las",
       1000,
       {768321.06, 2028734.533, 104.98},
       {768376.937, 2028768.078, 113.03},
       1e-9},
      {"airborne-las/test_data_77060_627760_LA93_IGN69.expanded.las",
       59606,
       {770600, 6277550, 20.39},
       {770650, 6277600, 34.94},
       1e-9},
      {"las-formats/point10.las", 1065, utm_min, utm_max, 1e-9},
      {"las-formats/point-time.las", 1065, utm_min, utm_max, 1e-9},
      {"las-formats/point-color.las", 1065, utm_min, utm_max, 1e-9},
      {"las-formats/point-color-time.las", 1065, utm_min, utm_max, 1e-9},
      {"las-formats/1.0_0.las", 1, one, one, 1e-9},
      {"las-formats/1.0_1.las", 1, one, one, 1e-9},
      {"las-formats/1.1_0.las", 1, one, one, 1e-9},
      {"las-formats/1.2_2.las", 1, one, one, 1e-9},
      {"las-formats/simple1_1.las", 1065, {635619.85, 848899.70, 406.59}, {638982.55, 853535.43, 586.38}, 1e-9},
      {"las-formats/vegetation_1_3.las",
       10683,
       {-98451.205, -55975.417, -81460.091},
       {-98447.447, -55969.405, -81455.203},
       1e-9},
      {"las-formats/pdrf4-1.3.las", 1024, {-70, -22.53, -10}, {103.91, 90, 12.08}, 1e-9},
      {"las-formats/pdrf7-v4-1.4.las", 1024, {-1500.01, 250, -350.04}, {498.09, 1748.94, 449.38}, 1e-9},
      {"terrestrial/lone-star-split-1.expanded.las",
       122893,
       {515393.00, 4918340.364, 2323.09975},
       {515400.00175, 4918364.99975, 2338.482},
       2e-9}};
  return table;
}

class RealLas : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(KAPPA_SHARED_DATA "/lidar")) GTEST_SKIP() << "no real data at " << KAPPA_SHARED_DATA;
  }
  static Scan read(const std::string& name) { return read_scan(KAPPA_SHARED_DATA "/lidar/" + name); }
};

TEST_F(RealLas, CountsAndExtentsAreThosePublished) {
  for (const Expected& expected : expectations()) {
    SCOPED_TRACE(expected.path);
    const Scan scan = read(expected.path);
    EXPECT_EQ(scan.points.size(), expected.points);
    const Bounds box = bounds(scan.points);
    EXPECT_LE((scan.origin + box.min - expected.min).cwiseAbs().maxCoeff(), expected.tolerance);
    EXPECT_LE((scan.origin + box.max - expected.max).cwiseAbs().maxCoeff(), expected.tolerance);
    for (const Field& field : scan.fields) EXPECT_EQ(field.values.size(), expected.points) << field.name;
  }
}

TEST_F(RealLas, AllFilesAreInTheTable) {
  std::set<std::string> listed;
  for (const Expected& expected : expectations()) listed.insert(expected.path);
  for (const std::string folder : {"airborne-las", "las-formats", "terrestrial"}) {
    for (const auto& entry : fs::directory_iterator(KAPPA_SHARED_DATA "/lidar/" + folder)) {
      if (entry.path().extension() != ".las") continue;
      EXPECT_EQ(listed.count(folder + "/" + entry.path().filename().string()), 1u) << entry.path();
    }
  }
}

TEST_F(RealLas, OnePointSetInFourFormatsIsTheSame) {
  const Scan first = read("las-formats/point10.las");
  for (const char* name : {"point-time.las", "point-color.las", "point-color-time.las"}) {
    SCOPED_TRACE(name);
    const Scan scan = read(std::string("las-formats/") + name);
    EXPECT_EQ(scan.origin, first.origin);
    EXPECT_EQ(scan.points, first.points);
    for (const char* field : {"intensity", "return_number", "number_of_returns", "classification", "scan_angle"}) {
      ASSERT_NE(scan.field(field), nullptr) << field;
      EXPECT_EQ(scan.field(field)->values, first.field(field)->values) << field;
    }
  }
}

TEST_F(RealLas, AgreesWithTheSamePointsAsPcd) {
  // An independent program made the PCD of the same points.
  const Scan las = read("las-formats/point-color-time.las");
  const Scan pcd = read_scan(KAPPA_SHARED_DATA "/clouds/autzen-utm.pcd");
  ASSERT_EQ(las.points.size(), pcd.points.size());
  for (std::size_t i = 0; i < las.points.size(); ++i) {
    ASSERT_LE((test::position(las, i) - test::position(pcd, i)).cwiseAbs().maxCoeff(), 2e-9) << i;
  }
  const std::pair<const char*, const char*> names[] = {{"intensity", "Intensity"},
                                                       {"return_number", "ReturnNumber"},
                                                       {"number_of_returns", "NumberOfReturns"},
                                                       {"classification", "Classification"},
                                                       {"scan_angle", "ScanAngleRank"},
                                                       {"point_source_id", "PointSourceId"},
                                                       {"gps_time", "GpsTime"},
                                                       {"red", "Red"},
                                                       {"green", "Green"},
                                                       {"blue", "Blue"},
                                                       {"user_data", "UserData"}};
  for (const auto& [ours, theirs] : names) {
    ASSERT_NE(las.field(ours), nullptr) << ours;
    EXPECT_EQ(las.field(ours)->values, pcd.field(theirs)->values) << ours;
  }
}

TEST_F(RealLas, DegreesAreSeen) {
  for (const Expected& expected : expectations()) {
    const bool degrees = std::string(expected.path) == "airborne-las/epsg_4326.las";
    EXPECT_EQ(looks_geographic(read(expected.path)), degrees) << expected.path;
  }
  Scan bare = read("airborne-las/epsg_4326.las");
  bare.records = nullptr;
  bare.geographic.reset();
  EXPECT_TRUE(looks_geographic(bare)) << "by the extents alone";
}

/// The value at bits [first, first + bits) of the record, by the tables of the standard.
double bits_of(const std::string& record, std::size_t at, unsigned first, unsigned bits) {
  return (static_cast<unsigned char>(record[at]) >> first) % (1 << bits);
}

void expect_value(const Scan& scan, const char* name, std::size_t i, double value) {
  const Field* field = scan.field(name);
  if (!field) {
    EXPECT_EQ(value, 0) << name << " is left out, though not 0";
    return;
  }
  EXPECT_TRUE(test::same_bits(field->values[i], value)) << name << " " << field->values[i] << " != " << value;
}

void expect_point_of_first_formats(const Scan& scan, std::size_t i, const std::string& r) {
  expect_value(scan, "return_number", i, bits_of(r, 14, 0, 3));
  expect_value(scan, "number_of_returns", i, bits_of(r, 14, 3, 3));
  expect_value(scan, "scan_direction", i, bits_of(r, 14, 6, 1));
  expect_value(scan, "edge_of_flight_line", i, bits_of(r, 14, 7, 1));
  expect_value(scan, "classification", i, bits_of(r, 15, 0, 5));
  expect_value(scan, "synthetic", i, bits_of(r, 15, 5, 1));
  expect_value(scan, "key_point", i, bits_of(r, 15, 6, 1));
  expect_value(scan, "withheld", i, bits_of(r, 15, 7, 1));
  expect_value(scan, "scan_angle", i, test::number_at<std::int8_t>(r, 16));
  expect_value(scan, "user_data", i, test::number_at<std::uint8_t>(r, 17));
  expect_value(scan, "point_source_id", i, test::number_at<std::uint16_t>(r, 18));
}

void expect_point_of_formats_14(const Scan& scan, std::size_t i, const std::string& r) {
  expect_value(scan, "return_number", i, bits_of(r, 14, 0, 4));
  expect_value(scan, "number_of_returns", i, bits_of(r, 14, 4, 4));
  expect_value(scan, "overlap", i, bits_of(r, 15, 3, 1));
  expect_value(scan, "scanner_channel", i, bits_of(r, 15, 4, 2));
  expect_value(scan, "edge_of_flight_line", i, bits_of(r, 15, 7, 1));
  expect_value(scan, "classification", i, test::number_at<std::uint8_t>(r, 16));
  expect_value(scan, "user_data", i, test::number_at<std::uint8_t>(r, 17));
  expect_value(scan, "scan_angle", i, test::number_at<std::int16_t>(r, 18) * 0.006);
  expect_value(scan, "point_source_id", i, test::number_at<std::uint16_t>(r, 20));
}

void expect_optional_parts(const Scan& scan, std::size_t i, const std::string& r, int format) {
  constexpr int kTime[] = {0, 20, 0, 20, 20, 20, 22, 22, 22, 22, 22}, kRed[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30},
                kWave[] = {0, 0, 0, 0, 28, 34, 0, 0, 0, 30, 38};
  const auto at = [](const int* table, int f) { return static_cast<std::size_t>(table[f]); };
  EXPECT_EQ(scan.field("gps_time") != nullptr, kTime[format] != 0);
  EXPECT_EQ(scan.field("blue") != nullptr, kRed[format] != 0);
  EXPECT_EQ(scan.field("nir") != nullptr, format == 8 || format == 10);
  EXPECT_EQ(scan.field("wave_dz") != nullptr, kWave[format] != 0);
  if (kTime[format]) expect_value(scan, "gps_time", i, test::number_at<double>(r, at(kTime, format)));
  if (kRed[format]) expect_value(scan, "blue", i, test::number_at<std::uint16_t>(r, at(kRed, format) + 4));
  if (format == 8 || format == 10) expect_value(scan, "nir", i, test::number_at<std::uint16_t>(r, 36));
  if (!kWave[format]) return;
  const std::size_t wave = at(kWave, format);
  expect_value(scan, "wave_descriptor", i, test::number_at<std::uint8_t>(r, wave));
  expect_value(scan, "wave_offset", i, static_cast<double>(test::number_at<std::uint64_t>(r, wave + 1)));
  expect_value(scan, "wave_size", i, test::number_at<std::uint32_t>(r, wave + 9));
  expect_value(scan, "wave_location", i, static_cast<double>(test::number_at<float>(r, wave + 13)));
  expect_value(scan, "wave_dz", i, static_cast<double>(test::number_at<float>(r, wave + 25)));
}

TEST(LasFormats, EveryVersionAndFormatIsReadByTheTables) {
  for (const LasSpec& spec : test::las_matrix()) {
    SCOPED_TRACE("LAS 1." + std::to_string(spec.minor) + " format " + std::to_string(spec.format));
    const Scan scan = scan_of("a.las", test::las_file(spec));
    ASSERT_EQ(scan.points.size(), spec.points);
    const std::string records = test::las_points(spec);
    const std::size_t size = test::kLasPointSize[spec.format], length = size + spec.extra;
    for (std::size_t i = 0; i < spec.points; ++i) {
      const std::string record = records.substr(i * length, length);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        EXPECT_NEAR(test::position(scan, i)[axis], test::las_stored(i)[a] * spec.scale[a] + spec.offset[a], 2e-9);
      }
      expect_value(scan, "intensity", i, test::number_at<std::uint16_t>(record, 12));
      (spec.format < 6 ? expect_point_of_first_formats : expect_point_of_formats_14)(scan, i, record);
      expect_optional_parts(scan, i, record, spec.format);
      expect_value(scan, "height", i, static_cast<double>(test::number_at<float>(record, size)));
    }
    ASSERT_EQ(las_of(scan)->records.size(), 2u);
    EXPECT_EQ(las_of(scan)->records[1].data, "abc");
    EXPECT_EQ(las_of(scan)->extended.size(), spec.extended.size());
    EXPECT_EQ(las_of(scan)->waveform.has_value(), spec.waveform);
  }
}

TEST(LasOrigin, TheOffsetOfTheFileDoesNotTouchLocalPoints) {
  LasSpec spec;
  spec.points = 50;
  const Scan near = scan_of("a.las", test::las_file(spec));
  for (double& offset : spec.offset) offset += 5e6;
  const Scan far = scan_of("a.las", test::las_file(spec));
  spec.offset = {0, 0, 0};
  const Scan none = scan_of("a.las", test::las_file(spec));
  EXPECT_EQ(near.points, far.points);
  EXPECT_EQ(near.points, none.points);
  EXPECT_LE((far.origin - near.origin - Vec3::Constant(5e6)).cwiseAbs().maxCoeff(), 2e-9);
}

TEST_F(RealLas, TheOffsetOfATerrestrialScanDoesNotTouchLocalPoints) {
  std::string bytes = test::content_of(KAPPA_SHARED_DATA "/lidar/terrestrial/lone-star-split-1.expanded.las");
  const Scan before = scan_of("a.las", bytes);
  for (std::size_t at = 155; at < 179; at += 8) test::patch(bytes, at, test::number_at<double>(bytes, at) + 5e6);
  EXPECT_EQ(scan_of("a.las", bytes).points, before.points);
}

TEST(LasOrigin, IsARoundNumberAmongThePoints) {
  LasSpec spec;
  spec.points = 1000;  // 2107.89 m in x, so the origin is a multiple of 1000 m from the offset
  const Scan scan = scan_of("a.las", test::las_file(spec));
  EXPECT_EQ(scan.origin.x(), 513000.0);
  EXPECT_LE(bounds(scan.points).max.x(), 2200);
  EXPECT_GE(bounds(scan.points).min.x(), -2200);
  spec.points = 1;
  EXPECT_EQ(scan_of("a.las", test::las_file(spec)).points[0], Vec3::Zero().eval());
}

std::string with_extra_bytes(const std::vector<std::string>& descriptors, const std::string& values) {
  LasSpec spec;
  spec.points = 1;
  spec.extra = values.size();
  spec.records = {test::las_record("LASF_Spec", 4, test::joined(descriptors))};
  std::string file = test::las_file(spec);
  return file.replace(file.size() - values.size(), values.size(), values);
}

TEST(LasExtraBytes, AreFieldsByTheirDescriptors) {
  std::string scaled = test::las_descriptor("scaled", 6, 8 | 16), absent = test::las_descriptor("absent", 3, 1);
  test::patch(scaled, 112, 0.25);
  test::patch(scaled, 136, 1000.0);
  test::patch(absent, 40, std::uint64_t{9999});
  std::string values;
  test::append<std::int32_t>(values, -6);
  test::append<std::uint16_t>(values, 9999);
  test::append<std::uint16_t>(values, 0xabcd);  // two bytes that nothing describes
  test::append<std::int16_t>(values, -2);
  test::append<std::int16_t>(values, 3);
  test::append<std::uint64_t>(values, 1ull << 40);
  const Scan scan =
      scan_of("a.las", with_extra_bytes({scaled, absent, test::las_descriptor("what", 0, 2),
                                         test::las_descriptor("pair", 14), test::las_descriptor("big", 7)},
                                        values));
  expect_value(scan, "scaled", 0, 998.5);
  expect_value(scan, "absent", 0, kNaN);
  expect_value(scan, "pair_0", 0, -2);
  expect_value(scan, "pair_1", 0, 3);
  expect_value(scan, "big", 0, 1099511627776.0);
  EXPECT_EQ(scan.field("what"), nullptr);
  EXPECT_EQ(scan.field("pair_0")->type, Field::Type::Int32);
}

TEST(LasExtraBytes, NamesAreMadeUnique) {
  const Scan scan =
      scan_of("a.las", with_extra_bytes({test::las_descriptor("x", 1), test::las_descriptor("intensity", 1),
                                         test::las_descriptor("intensity", 1), test::las_descriptor("", 1)},
                                        "\x01\x02\x03\x04"));
  expect_value(scan, "x_extra", 0, 1);
  expect_value(scan, "intensity_extra", 0, 2);
  expect_value(scan, "intensity_extra_extra", 0, 3);
  expect_value(scan, "extra3", 0, 4);
}

LasSpec spec_of(std::vector<std::string> records) {
  LasSpec spec;
  spec.records = std::move(records);
  return spec;
}

std::string geo_keys(std::uint16_t key, std::uint16_t value) {
  std::string data;
  for (const std::uint16_t word : {1, 1, 0, 1, int{key}, 0, 1, int{value}}) test::append(data, word);
  return test::las_record("LASF_Projection", 34735, data);
}

TEST(Geographic, TheCoordinateSystemDecides) {
  const auto degrees = [](const std::vector<std::string>& records) {
    return looks_geographic(scan_of("a.las", test::las_file(spec_of(records))));
  };
  const auto wkt = [](const std::string& text) { return test::las_record("LASF_Projection", 2112, text); };
  EXPECT_FALSE(degrees({}));
  EXPECT_TRUE(degrees({geo_keys(1024, 2)}));
  EXPECT_FALSE(degrees({geo_keys(1024, 1)}));
  EXPECT_TRUE(degrees({geo_keys(2048, 4326)}));
  EXPECT_FALSE(degrees({geo_keys(3072, 32610)}));
  EXPECT_TRUE(degrees({wkt("GEOGCS[\"WGS 84\"]")}));
  EXPECT_TRUE(degrees({wkt("COMPD_CS[\"a\",GEOGCS[\"WGS 84\"],VERT_CS[\"b\"]]")}));
  EXPECT_FALSE(degrees({wkt("PROJCS[\"UTM\",GEOGCS[\"WGS 84\"]]"), geo_keys(1024, 2)}));
}

TEST(Geographic, WithoutOneTheExtentsDecide) {
  Scan scan;
  scan.origin = Vec3(7, 46, 0);
  scan.points = {{0, 0, 400}, {0.01, 0.02, 440}};
  EXPECT_TRUE(looks_geographic(scan));
  scan.points[1].z() = 401;  // a lamp post
  EXPECT_FALSE(looks_geographic(scan));
  scan.points[1] = Vec3(3, 0.02, 4400);
  EXPECT_FALSE(looks_geographic(scan));
  scan.origin.x() = 500000;
  scan.points[1] = Vec3(0.01, 0.02, 440);
  EXPECT_FALSE(looks_geographic(scan));
}

}  // namespace
}  // namespace kappa
