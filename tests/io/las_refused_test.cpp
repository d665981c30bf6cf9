// SPDX-License-Identifier: BSD-3-Clause
// Damaged LAS files: refused with the entry at fault, whatever they promise.
#include <random>

#include "kappa/scan/scan.hpp"
#include "las_files.hpp"
#include "support.hpp"

namespace kappa {
namespace {

using test::expect_refused;
using test::LasSpec;

/// A file of LAS 1.4 with one number of its header changed.
template <class T>
std::string changed(std::size_t at, T value, const LasSpec& spec) {
  std::string file = test::las_file(spec);
  test::patch(file, at, value);
  return file;
}

LasSpec modern() {
  LasSpec spec;
  spec.minor = 4;
  spec.format = 6;
  spec.records = {test::las_record("someone", 1, "abc")};
  spec.extended = {test::las_extended("someone", 2, "defg")};
  return spec;
}

TEST(RefusedLas, Kinds) {
  expect_refused("a.las", "x y z\n1 2 3\n", "begins with 'x y ' in place of 'LASF'");
  expect_refused("a.las", "LASF", "has 4 bytes, fewer than the 227");
  expect_refused("a.las", changed<std::uint8_t>(25, 5, modern()), "LAS version 1.5");
  expect_refused("a.las", changed<std::uint8_t>(24, 2, modern()), "LAS version 2.4");
  expect_refused("a.las", changed<std::uint8_t>(104, 0x83, {}), "pdal translate");
  expect_refused("a.laz", test::las_file({}), "laszip -i");
  expect_refused("a.las", changed<std::uint8_t>(104, 11, modern()), "points of format 11");
  expect_refused("a.las", changed<std::uint16_t>(105, 29, modern()), "29 bytes where format 6 needs 30");
  LasSpec none;
  none.points = 0;
  expect_refused("a.las", test::las_file(none), "holds no point");
}

TEST(RefusedLas, CountsThatLie) {
  expect_refused("a.las", changed<std::uint64_t>(247, 1000000000000, modern()), "promises 1000000000000 points");
  expect_refused("a.las", changed<std::uint64_t>(247, ~0ull, modern()), "promises 18446744073709551615 points");
  expect_refused("a.las", changed<std::uint32_t>(107, 6, modern()), "promises 5 points and, in the field of older");
  expect_refused("a.las", changed<std::uint32_t>(107, 6, {}), "promises 6 points of 20 bytes but holds 100");
  expect_refused("a.las", changed<std::uint32_t>(100, 4000000000u, modern()), "record 2 of 4000000000 does not fit");
  expect_refused("a.las", changed<std::uint32_t>(243, 4000000000u, modern()), "record 2 of 4000000000 does not fit");
}

TEST(RefusedLas, PlacesThatLie) {
  const LasSpec spec = modern();
  const auto size = static_cast<std::uint32_t>(test::las_file(spec).size());
  expect_refused("a.las", changed<std::uint16_t>(94, 374, spec), "header of 374 bytes where LAS 1.4 needs 375");
  expect_refused("a.las", changed<std::uint16_t>(94, 65535, spec), "not between the 65535 bytes of the header");
  expect_refused("a.las", changed<std::uint32_t>(96, size + 1, spec),
                 "should begin at byte " + std::to_string(size + 1));
  expect_refused("a.las", changed<std::uint32_t>(96, 375, spec), "record 1 of 1 does not fit");
  expect_refused("a.las", changed<std::uint16_t>(375 + 20, 4, spec), "record 1 of 1 promises 4 bytes");
  expect_refused("a.las", changed<std::uint64_t>(235, 400, spec), "should begin at byte 400");
  expect_refused("a.las", changed<std::uint64_t>(235, ~0ull, spec), "should begin at byte 18446744073709551615");
  const std::size_t extended = size - 4 - 60;
  expect_refused("a.las", changed<std::uint64_t>(extended + 20, ~0ull, spec),
                 "record 1 of 1 promises 18446744073709551615");
}

TEST(RefusedLas, Waveforms) {
  LasSpec spec = modern();
  spec.format = 9;
  spec.waveform = true;
  expect_refused("a.las", changed<std::uint64_t>(227, 300, spec), "waveform packets should begin at byte 300");
  spec.format = 6;  // has no waveforms, so that what the header says of them does not matter
  EXPECT_EQ(test::scan_of("a.las", changed<std::uint64_t>(227, 300, spec)).points.size(), 5u);
}

TEST(RefusedLas, ScalesAndOffsets) {
  const double bad[] = {0.0, kNaN, std::numeric_limits<double>::infinity()};
  for (const double value : bad) expect_refused("a.las", changed(139, value, {}), "its scale of y is");
  expect_refused("a.las", changed(171, kNaN, {}), "its offset of z is nan");
  expect_refused("a.las", changed(131, 1e305, {}), "out of the range of a double");
}

std::string with_descriptors(const std::string& data, std::size_t extra) {
  LasSpec spec;
  spec.extra = extra;
  spec.records = {test::las_record("LASF_Spec", 4, data)};
  return test::las_file(spec);
}

TEST(RefusedLas, ExtraBytes) {
  expect_refused("a.las", with_descriptors(std::string(191, '\0'), 1), "191 bytes, no multiple of 192");
  expect_refused("a.las", with_descriptors(test::las_descriptor("a", 31), 9), "a value of type 31");
  expect_refused("a.las", with_descriptors(test::las_descriptor("a", 10), 7),
                 "describes 8 bytes a point where the points have 7");
  expect_refused("a.las", with_descriptors(test::las_descriptor("a", 30), 23), "describes 24 bytes");
  expect_refused("a.las", with_descriptors(test::las_descriptor("a", 0, 9), 8), "describes 9 bytes");
  expect_refused("a.las", with_descriptors(test::las_descriptor("a", 3, 8), 8), "a scale of 0.000000");
}

TEST(RefusedLas, EveryCutThroughThePointsOrBefore) {
  const std::string file = test::las_file(modern());
  const test::TemporaryFolder folder;
  for (std::size_t size = 1; size < file.size(); ++size) {
    const std::string path = folder.write("cut.las", file.substr(0, size));
    EXPECT_THROW(read_scan(path), Error) << size;
  }
}

TEST(RefusedLas, NoFlippedBitDoesHarm) {
  std::size_t read = 0, refused = 0;
  const test::TemporaryFolder folder;
  for (const LasSpec& spec : test::las_matrix()) {
    const std::string file = test::las_file(spec);
    std::mt19937 random(99u + spec.format);
    for (int round = 0; round < 60; ++round) {
      std::string flipped = file;
      const std::size_t at = random() % file.size();
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << random() % 8));
      const std::string path = folder.write("flipped.las", flipped);
      try {
        const Scan scan = read_scan(path);
        ++read;
        write_scan(folder.file("again.las"), scan);
      } catch (const Error& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find("'"), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace kappa
