// SPDX-License-Identifier: BSD-3-Clause
// The corpus as it is and with seeded damage: refused or read, and if read, written and read again without loss.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "las_check.hpp"

namespace kappa::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> corpus() {
  std::vector<fs::path> files(fs::directory_iterator(KAPPA_LAS_CORPUS), fs::directory_iterator{});
  std::sort(files.begin(), files.end());
  std::vector<std::string> contents;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    contents.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return contents;
}

/// A few flipped bits, bytes of extreme value, or an end cut off; the header is hit most often.
std::string damaged(std::string bytes, std::mt19937& random) {
  constexpr std::size_t kHeader = 400;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (std::size_t i = 1 + below(4); i-- > 0;) {
    const std::size_t at = below(below(4) ? std::min(bytes.size(), kHeader) : bytes.size());
    const char extremes[] = {0, 1, '\x7f', '\x80', '\xff'};
    bytes[at] = below(2) ? static_cast<char>(bytes[at] ^ (1 << below(8))) : extremes[below(5)];
  }
  if (below(8) == 0) bytes.resize(1 + below(bytes.size()));
  return bytes;
}

TEST(LasFuzz, EveryFileOfTheCorpusIsRead) {
  const std::vector<std::string> files = corpus();
  ASSERT_GE(files.size(), 35u);
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_TRUE(check_las(files[i])) << "file " << i << " by name";
}

TEST(LasFuzz, DamageIsRefusedOrHarmless) {
  constexpr unsigned kSeed = 20230, kRounds = 400;
  const std::vector<std::string> files = corpus();
  std::size_t accepted = 0, refused = 0;
  for (std::size_t f = 0; f < files.size(); ++f) {
    for (unsigned round = 0; round < kRounds; ++round) {
      std::mt19937 random(kSeed + 1000 * static_cast<unsigned>(f) + round);
      SCOPED_TRACE("file " + std::to_string(f) + ", round " + std::to_string(round));
      try {
        ++(check_las(damaged(files[f], random)) ? accepted : refused);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
  }
  EXPECT_GT(accepted, files.size() * kRounds / 20) << "the damage is too heavy to test what is behind the header";
  EXPECT_GT(refused, files.size() * kRounds / 20) << "the damage is too light to be noticed";
}

TEST(LasFuzz, EveryCutIsRefusedOrHarmless) {
  for (const std::string& bytes : corpus()) {
    for (std::size_t size = 0; size < bytes.size(); size += 3)
      EXPECT_NO_THROW(check_las(bytes.substr(0, size))) << size;
  }
}

}  // namespace
}  // namespace kappa::fuzz
