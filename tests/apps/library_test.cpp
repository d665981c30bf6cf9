// SPDX-License-Identifier: BSD-3-Clause
// The program computes nothing of its own: the library gives the same bits.
#include <gtest/gtest.h>

#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/pipeline/measure_scan.hpp"
#include "kappa/pipeline/output.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

/// Writes what the library makes of the file, and compares the bytes with what the program has written.
void expect_program_equals_library(const Folder& f, const std::string& in, ScanOptions options,
                                   const Arguments& arguments) {
  Arguments all = {options.labels ? "segment" : "curvature", f.file(in), f.file("program.ply")};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome done = run(all);
  ASSERT_EQ(done.exit_code, 0) << in << ": " << done.err;
  write_scan(f.file("library.ply"), output_scan(measure_scan(read_scan(f.file(in)), options)));
  EXPECT_TRUE(contents(f.file("program.ply")) == contents(f.file("library.ply"))) << in;
}

TEST(Library, GivesTheBytesOfTheProgram) {
  const Folder f;
  const std::vector<Arguments> inputs = {
      {"torus", f.file("mesh.ply"), "--slices", "40", "--sides", "30"},
      {"torus", f.file("cloud.ply"), "--points", "3000", "--seed", "3"},
      {"sphere", f.file("bare.csv"), "--points", "2000", "--no-normals", "--no-truth"},
      {"airborne", f.file("airborne.las"), "--width", "40", "--depth", "40"},
      {"waves", f.file("waves.pcd"), "--points", "4000", "--range-noise", "0.1", "--no-normals"}};
  for (const Arguments& input : inputs) {
    Arguments all = {"generate"};
    all.insert(all.end(), input.begin(), input.end());
    ASSERT_EQ(run(all).exit_code, 0);
  }
  for (const char* in : {"mesh.ply", "cloud.ply", "bare.csv", "airborne.las", "waves.pcd"}) {
    expect_program_equals_library(f, in, {}, {});
    ScanOptions labelled;
    labelled.labels.emplace();
    labelled.curvature.order = 2;
    expect_program_equals_library(f, in, labelled, {"--order", "2"});
  }
}

}  // namespace
}  // namespace kappa::apps
