// SPDX-License-Identifier: BSD-3-Clause
// Units of length in the coordinate system of a LAS file.
#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"
#include "las_files.hpp"
#include "support.hpp"

namespace kappa {
namespace {

constexpr double kSurveyFoot = 12 / 39.37;

LengthUnits units_of(const std::vector<std::string>& records) {
  test::LasSpec spec;
  spec.records = records;
  return test::scan_of("a.las", test::las_file(spec)).units;
}

LengthUnits units_of_wkt(const std::string& text) {
  return units_of({test::las_record("LASF_Projection", 2112, text)});
}

std::string keys(const std::vector<std::array<std::uint16_t, 4>>& entries) {
  std::string bytes;
  for (const std::uint16_t value : {1, 1, 0, static_cast<int>(entries.size())})
    test::append(bytes, static_cast<std::uint16_t>(value));
  for (const auto& entry : entries) {
    for (const std::uint16_t value : entry) test::append(bytes, value);
  }
  return bytes;
}

const char* const kPlan =
    R"(PROJCS["NAD83 / UNIT[of a name]",GEOGCS["NAD83",DATUM["D",SPHEROID["GRS 1980",6378137,298.25]],PRIMEM["G",0],)"
    R"(UNIT["degree",0.0174532925199433]],PROJECTION["Lambert"],PARAMETER["false_easting",400000],UNIT["metre",1,)"
    R"(AUTHORITY["EPSG","9001"]],AXIS["E",EAST],AXIS["N",NORTH]])";

TEST(LasUnits, MixedUnitsOfWkt1) {
  const LengthUnits units = units_of_wkt(std::string("COMPD_CS[\"both\",") + kPlan +
                                         R"(,VERT_CS["NAVD88 ftUS",VERT_DATUM["NAVD",2005],)"
                                         R"(UNIT["US survey foot",0.304800609601219],AXIS["Up",UP]]])");
  EXPECT_EQ(units.horizontal, 1.0);
  EXPECT_EQ(units.vertical, 0.304800609601219);
  EXPECT_EQ(units.z_scale(), 0.304800609601219);
}

TEST(LasUnits, ASystemWithoutHeightsHasOneUnit) {
  const LengthUnits units = units_of_wkt(kPlan);
  EXPECT_EQ(units.horizontal, 1.0);
  EXPECT_FALSE(units.vertical);
  EXPECT_EQ(units.z_scale(), 1);
}

TEST(LasUnits, UnitsOfWkt2) {
  const LengthUnits units = units_of_wkt(
      R"(COMPOUNDCRS["both",PROJCRS["x",BASEGEOGCRS["y",DATUM["D",ELLIPSOID["E",6378137,298,LENGTHUNIT["metre",1]]],)"
      R"(PRIMEM["G",0,ANGLEUNIT["degree",0.017]]],CONVERSION["c",PARAMETER["p",5,LENGTHUNIT["kilometre",1000]]],)"
      R"(CS[Cartesian,2],AXIS["E",east,ORDER[1]],AXIS["N",north,ORDER[2]],LENGTHUNIT["foot", 0.3048 ]],)"
      R"(VERTCRS["z",VDATUM["v"],CS[vertical,1],AXIS["H",up,LENGTHUNIT["metre",1]]]])");
  EXPECT_EQ(units.horizontal, 0.3048);
  EXPECT_EQ(units.vertical, 1.0);
  EXPECT_EQ(units.z_scale(), 1 / 0.3048);
}

TEST(LasUnits, UnitsOfGeoKeys) {
  const auto user = [](std::uint16_t id, const std::string& data) {
    return test::las_record("LASF_Projection", id, data);
  };
  const LengthUnits feet = units_of({user(34735, keys({{1024, 0, 1, 1}, {3076, 0, 1, 9002}, {4099, 0, 1, 9001}}))});
  EXPECT_EQ(feet.horizontal, 0.3048);
  EXPECT_EQ(feet.vertical, 1.0);
  const LengthUnits same = units_of({user(34735, keys({{3076, 0, 1, 9003}, {4099, 0, 1, 9002}}))});
  EXPECT_EQ(same.horizontal, kSurveyFoot);
  EXPECT_EQ(same.z_scale(), 1) << "feet by two definitions";
  const LengthUnits own = units_of({user(34735, keys({{3076, 0, 1, 32767}, {3077, 34736, 1, 1}})),
                                    user(34736, test::bytes_of<double>({7.0, 0.25}))});
  EXPECT_EQ(own.horizontal, 0.25);
  EXPECT_FALSE(units_of({user(34735, keys({{3077, 34736, 1, 2}})), user(34736, "12345678")}).horizontal);
}

TEST(LasUnits, TextThatIsNoneIsNoUnit) {
  for (const std::string text :
       {"", "]]]", "PROJCS[UNIT[", "PROJCS[\"a\",UNIT[\"metre\"", "PROJCS[\"a\",UNIT[\"metre\",", "UNIT[\"metre\",1]",
        "PROJCS[\"a\",UNIT[\"metre\",x]]", "PROJCS[\"a\",UNIT[\"metre\",-1]]", "PROJCS[\"a\",UNIT[\"m\",0]]"}) {
    SCOPED_TRACE(text);
    const LengthUnits units = units_of_wkt(text);
    EXPECT_FALSE(units.horizontal || units.vertical);
  }
  EXPECT_FALSE(units_of({}).horizontal);
  EXPECT_EQ(Scan().units.z_scale(), 1);
}

TEST(LasUnits, OfRealFiles) {
  const std::string folder = std::string(KAPPA_SHARED_DATA) + "/lidar/airborne-las/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data";
  const LengthUnits mixed = read_scan(folder + "autzen-bmx-2010.las").units;
  EXPECT_EQ(mixed.horizontal, 1.0);
  EXPECT_NEAR(*mixed.vertical, kSurveyFoot, 1e-12);
  EXPECT_EQ(read_scan(folder + "hexbin-crop.las").units.horizontal, 1.0);
  EXPECT_EQ(read_scan(folder + "autzen_trim.las").units.horizontal, 0.3048);
}

}  // namespace
}  // namespace kappa
