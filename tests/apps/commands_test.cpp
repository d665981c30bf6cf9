// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "kappa/core/spatial_order.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/compare.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"
#include "program.hpp"

namespace kappa::apps {
namespace {

void generate(const Arguments& arguments) {
  Arguments all = {"generate"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome made = run(all);
  ASSERT_EQ(made.exit_code, 0) << made.err;
}

double rms_of(const std::vector<ErrorStatistics>& all, const std::string& field) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.field == field; });
  return found == all.end() ? kNaN : found->rms;
}

TEST(Commands, CurvatureOfATorusMeshComesCloseToTheTruth) {
  const Folder f;
  generate({"torus", f.file("torus.ply"), "--slices", "120", "--sides", "80"});
  const Outcome done = run({"curvature", f.file("torus.ply"), f.file("out.ply"), "--radius", "0"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("9600"), std::string::npos) << done.out;
  const auto errors = compare_scans(read_scan(f.file("out.ply")), read_scan(f.file("torus.ply")));
  EXPECT_LT(rms_of(errors, "mean_curvature"), 2e-4);
  EXPECT_LT(rms_of(errors, "k_min"), 1e-3);
  EXPECT_LT(rms_of(errors, "k_max"), 2e-3);
  EXPECT_LT(rms_of(errors, "dir_max"), 1.0);
  const Outcome table = run({"compare", f.file("out.ply"), f.file("torus.ply")});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("mean_curvature"), std::string::npos);
}

TEST(Commands, EveryOutputFormatHoldsTheSameResult) {
  const Folder f;
  generate({"torus", f.file("torus.ply"), "--slices", "24", "--sides", "16", "--origin", "512000,5403000,300"});
  std::vector<Scan> results;
  for (const std::string extension : {"ply", "csv", "pcd", "vtp"}) {
    const std::string out = f.file("out." + extension);
    const Outcome done = run({"segment", f.file("torus.ply"), out, "--radius", "0.5", "--quiet"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.out + done.err, "");
    results.push_back(read_scan(out));
  }
  const Scan truth = read_scan(f.file("torus.ply"));
  for (const Scan& result : results) {
    ASSERT_EQ(result.points.size(), truth.points.size());
    for (std::size_t i = 0; i < truth.points.size(); ++i)
      EXPECT_EQ((result.points[i] + result.origin).eval(), (truth.points[i] + truth.origin).eval());
    for (const Field& field : results.front().fields) {
      const Field* same = result.field(field.name);
      ASSERT_TRUE(same) << field.name;
      for (std::size_t i = 0; i < field.values.size(); ++i)
        EXPECT_TRUE(same->values[i] == field.values[i] || (std::isnan(same->values[i]) && std::isnan(field.values[i])))
            << field.name << ' ' << i;
    }
  }
  for (const char* name : {"mean_curvature", "dir_max_z", "mu2", "coverage", "face_count", "status", "label", "region"})
    EXPECT_TRUE(results.front().field(name)) << name;
  EXPECT_NE(contents(f.file("out.vtp")).find("Mean_Curvature"), std::string::npos);
  EXPECT_NE(contents(f.file("out.regions.csv")).find("convex"), std::string::npos);
}

TEST(Commands, SeveralRadiiGiveFieldsWithSuffixes) {
  const Folder f;
  generate({"sphere", f.file("s.ply"), "--radius", "2"});
  ASSERT_EQ(run({"segment", f.file("s.ply"), f.file("o.ply"), "--radius", "0,0.5,0.25"}).exit_code, 0);
  const Scan out = read_scan(f.file("o.ply"));
  for (const char* suffix : {"_r0", "_r0.5", "_r0.25"}) {
    const Field* mean = out.field(std::string("mean_curvature") + suffix);
    ASSERT_TRUE(mean) << suffix;
    for (const double value : mean->values) EXPECT_NEAR(value, 0.5, 1e-6);
    EXPECT_TRUE(out.field(std::string("label") + suffix));
    EXPECT_TRUE(std::filesystem::exists(f.file(std::string("o.regions") + suffix + ".csv")));
  }
  EXPECT_EQ(run({"compare", f.file("o.ply"), f.file("s.ply"), "--suffix", "_r0.5"}).exit_code, 0);
  EXPECT_EQ(run({"compare", f.file("o.ply"), f.file("s.ply")}).exit_code, 1);
}

TEST(Commands, HigherOrdersCancelBiasAndTellTheirError) {
  const Folder f;
  generate({"torus", f.file("torus.ply"), "--slices", "60", "--sides", "40"});
  const Scan truth = read_scan(f.file("torus.ply"));
  std::vector<double> errors;
  for (const std::string order : {"1", "2", "3"}) {
    const Outcome done = run({"curvature", f.file("torus.ply"), f.file("o.ply"), "--radius", "0.8", "--order", order});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const Scan out = read_scan(f.file("o.ply"));
    errors.push_back(rms_of(compare_scans(out, truth), "k_max"));
    EXPECT_EQ(out.field("std_error") != nullptr, order != "1");
    EXPECT_EQ(done.out.find("std_error") != std::string::npos, order != "1");
  }
  EXPECT_LT(errors[1], errors[0] / 10);
  EXPECT_LT(errors[2], errors[1]);
}

TEST(Commands, RadiusAndOrderOfEveryPoint) {
  const Folder f;
  generate({"torus", f.file("torus.ply"), "--slices", "60", "--sides", "40"});
  const Outcome done = run({"segment", f.file("torus.ply"), f.file("o.ply"), "--radius", "auto-per-point"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("chosen for every point"), std::string::npos) << done.out;
  const Scan out = read_scan(f.file("o.ply"));
  for (const char* name : {"radius", "order", "std_error", "label"}) ASSERT_TRUE(out.field(name)) << name;
  EXPECT_LT(rms_of(compare_scans(out, read_scan(f.file("torus.ply"))), "k_max"), 2e-3);
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    EXPECT_GT(out.field("radius")->values[i], 0);
    EXPECT_GE(out.field("order")->values[i], 1);
  }
}

TEST(Commands, BordersOfSmoothTerrainAreMeasuredAtTheirPoints) {
  const Folder f;
  generate({"waves", f.file("terrain.ply"), "--points", "20000", "--width", "150", "--depth", "150"});
  const Scan truth = read_scan(f.file("terrain.ply"));
  std::vector<double> errors;
  for (const std::string border : {"ball", "centre"}) {
    const Outcome done =
        run({"curvature", f.file("terrain.ply"), f.file("o.ply"), "--radius", "8", "--border", border});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    errors.push_back(rms_of(compare_scans(read_scan(f.file("o.ply")), truth), "mean_curvature"));
  }
  EXPECT_LT(errors[1], errors[0] / 2);
  const Outcome usual = run({"curvature", f.file("terrain.ply"), f.file("o.ply"), "--radius", "8"});
  ASSERT_EQ(usual.exit_code, 0) << usual.err;
  EXPECT_EQ(rms_of(compare_scans(read_scan(f.file("o.ply")), truth), "mean_curvature"), errors[0]);
}

TEST(Commands, RefiningWarnsOfNoise) {
  const Folder f;
  generate({"torus", f.file("torus.ply"), "--slices", "40", "--sides", "30"});
  const Outcome clean = run({"curvature", f.file("torus.ply"), f.file("o.ply"), "--refine", "2"});
  ASSERT_EQ(clean.exit_code, 0) << clean.err;
  EXPECT_EQ(clean.out.find("warning"), std::string::npos) << clean.out;
  generate({"torus", f.file("noisy.ply"), "--slices", "40", "--sides", "30", "--noise", "0.3"});
  const Outcome noisy = run({"curvature", f.file("noisy.ply"), f.file("o.ply"), "--normals", "max", "--refine", "1"});
  ASSERT_EQ(noisy.exit_code, 0) << noisy.err;
  EXPECT_NE(noisy.out.find("warning"), std::string::npos) << noisy.out;
}

TEST(Commands, OrdersThatMakeNoSenseAreRefused) {
  const Folder f;
  generate({"sphere", f.file("s.ply")});
  const auto code = [&](const Arguments& more) {
    Arguments all = {"curvature", f.file("s.ply"), f.file("o.ply")};
    all.insert(all.end(), more.begin(), more.end());
    const Outcome done = run(all);
    EXPECT_NE(done.err, "");
    return done.exit_code;
  };
  EXPECT_EQ(code({"--order", "0"}), 2);
  EXPECT_EQ(code({"--order", "4"}), 2);
  EXPECT_EQ(code({"--order", "2", "--radius", "0,0.5"}), 2);
  EXPECT_EQ(code({"--order", "2", "--radius", "auto-per-point"}), 2);
  EXPECT_EQ(code({"--order", "2", "--surface", "hexagram"}), 2);
  EXPECT_EQ(code({"--refine", "1", "--quads", "bilinear"}), 2);
  EXPECT_EQ(code({"--refine", "7"}), 2);
  EXPECT_EQ(code({"--radius", "auto-per-point,0.5"}), 2);
  EXPECT_TRUE(f.names().size() == 1) << "no file is left";
}

TEST(Commands, EstimatesAtTheCentreNeedBallsOfPlainFaces) {
  const Folder f;
  generate({"sphere", f.file("s.ply")});
  const auto outcome = [&](const Arguments& more) {
    Arguments all = {"curvature", f.file("s.ply"), f.file("o.ply"), "--border", "centre"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  const std::vector<std::pair<Arguments, std::string>> refused = {{{"--radius", "0.5", "--refine", "1"}, "--refine 1"},
                                                                  {{"--radius", "auto-per-point"}, "auto-per-point"},
                                                                  {{"--radius", "0.5,0"}, "--radius 0"},
                                                                  {{"--surface", "hexagram"}, "hexagram"}};
  for (const auto& [options, named] : refused) {
    const Outcome done = outcome(options);
    EXPECT_EQ(done.exit_code, 2) << named;
    EXPECT_NE(done.err.find("--border"), std::string::npos) << done.err;
    EXPECT_NE(done.err.find(named), std::string::npos) << done.err;
    EXPECT_NE(done.err.find("leave"), std::string::npos) << done.err;
  }
  EXPECT_EQ(f.names().size(), 1u) << "no file is left";
  EXPECT_EQ(outcome({"--radius", "0.5"}).exit_code, 0);
}

TEST(Commands, FlippingTurnsTheSigns) {
  const Folder f;
  generate({"torus", f.file("t.ply"), "--slices", "40", "--sides", "24"});
  ASSERT_EQ(run({"curvature", f.file("t.ply"), f.file("a.csv"), "--radius", "0.4"}).exit_code, 0);
  ASSERT_EQ(run({"curvature", f.file("t.ply"), f.file("b.csv"), "--radius", "0.4", "--flip"}).exit_code, 0);
  const Scan a = read_scan(f.file("a.csv")), b = read_scan(f.file("b.csv"));
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_NEAR(a.field("mean_curvature")->values[i], -b.field("mean_curvature")->values[i], 1e-12);
    EXPECT_NEAR(a.field("k_min")->values[i], -b.field("k_max")->values[i], 1e-12);
    EXPECT_NEAR(a.field("gaussian_curvature")->values[i], b.field("gaussian_curvature")->values[i], 1e-12);
  }
}

TEST(Commands, CloudWithoutNormalsOrFacesIsMeasured) {
  const Folder f;
  generate({"sphere", f.file("s.pcd"), "--points", "4000", "--radius", "5", "--no-normals"});
  const Outcome done = run(
      {"curvature", f.file("s.pcd"), f.file("o.pcd"), "--orient", "viewpoint", "0,0,0", "--radius", "1.5", "--flip"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("umbrella"), std::string::npos);
  const Scan out = read_scan(f.file("o.pcd"));
  for (const double mean : out.field("mean_curvature")->values) EXPECT_NEAR(mean, 0.2, 0.02);
}

TEST(Commands, GenerateWritesEveryShape) {
  const Folder f;
  const std::vector<Arguments> shapes = {{"sphere"},
                                         {"icosphere"},
                                         {"torus"},
                                         {"cylinder", "--caps"},
                                         {"quadric"},
                                         {"saddle"},
                                         {"plane"},
                                         {"goursat", "--step", "1.5"},
                                         {"lantern"},
                                         {"airborne", "--width", "60", "--depth", "60"},
                                         {"waves", "--points", "500"}};
  for (const Arguments& shape : shapes) {
    Arguments arguments = shape;
    arguments.insert(arguments.begin() + 1, f.file(shape.front() + ".ply"));
    generate(arguments);
    const Scan scan = read_scan(f.file(shape.front() + ".ply"));
    for (const char* name : {"mean_curvature", "gaussian_curvature", "k_min", "k_max", "dir_min_x", "dir_max_z"})
      EXPECT_TRUE(scan.field(name)) << shape.front() << ' ' << name;
  }
}

TEST(Commands, SeedsDecideNoiseAndNothingElseDoes) {
  const Folder f;
  for (const char* name : {"a.csv", "b.csv"}) generate({"airborne", f.file(name), "--seed", "3", "--width", "40"});
  generate({"airborne", f.file("c.csv"), "--seed", "4", "--width", "40"});
  EXPECT_EQ(contents(f.file("a.csv")), contents(f.file("b.csv")));
  EXPECT_NE(contents(f.file("a.csv")), contents(f.file("c.csv")));
}

TEST(Commands, InfoTellsWhatIsThere) {
  const Folder f;
  generate({"torus", f.file("t.ply"), "--slices", "30", "--sides", "20", "--faces", "quads"});
  const Outcome info = run({"info", f.file("t.ply")});
  ASSERT_EQ(info.exit_code, 0) << info.err;
  for (const char* expected : {"600", "600 quads", "Euler number 0", "1 component", "suggested"})
    EXPECT_NE(info.out.find(expected), std::string::npos) << expected << "\n" << info.out;
  const Outcome json = run({"info", f.file("t.ply"), "--json"});
  EXPECT_NE(json.out.find("\"euler\": 0"), std::string::npos) << json.out;
}

TEST(Commands, JsonSummaryIsOneObject) {
  const Folder f;
  generate({"sphere", f.file("s.ply")});
  const Outcome done = run({"segment", f.file("s.ply"), f.file("o.ply"), "--radius", "0.3", "--json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.out.front(), '{');
  EXPECT_EQ(std::count(done.out.begin(), done.out.end(), '\n'), 1);
  EXPECT_EQ(std::count(done.out.begin(), done.out.end(), '{'), std::count(done.out.begin(), done.out.end(), '}'));
  EXPECT_NE(done.out.find("\"radius\": 0.3"), std::string::npos);
}

TEST(Commands, MeshAndNormalsWriteTheirStages) {
  const Folder f;
  generate({"torus", f.file("t.pcd"), "--points", "3000"});
  ASSERT_EQ(run({"mesh", f.file("t.pcd"), f.file("m.ply")}).exit_code, 0);
  // Two a point where all stars agree (the Euler number of a torus is 0), more where they do not; no more than the
  // library makes of the points in spatial order, in which the program takes them.
  const std::size_t faces = read_scan(f.file("m.ply")).faces.size();
  EXPECT_GE(faces, 6000U);
  const Scan file = read_scan(f.file("t.pcd"));
  Scan ordered = file;
  const std::vector<Index> order = spatial_order(file.points);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ordered.points[i] = file.points[order[i]];
    ordered.normals[i] = file.normals[order[i]];
  }
  EXPECT_EQ(faces, make_surface(ordered, {}).mesh.faces.size());
  ASSERT_EQ(run({"normals", f.file("m.ply"), f.file("n.ply"), "--normals", "geometric"}).exit_code, 0);
  const Scan truth = read_scan(f.file("t.pcd")), normals = read_scan(f.file("n.ply"));
  double sum = 0;
  for (std::size_t i = 0; i < truth.normals.size(); ++i) sum += truth.normals[i].dot(normals.normals[i]);
  EXPECT_GT(sum / static_cast<double>(truth.normals.size()), 0.99);
}

TEST(Commands, RenderDrawsWithoutADisplay) {
  const Folder f;
  generate({"torus", f.file("t.ply"), "--slices", "40", "--sides", "24"});
  ASSERT_EQ(run({"segment", f.file("t.ply"), f.file("o.ply"), "--radius", "0.4"}).exit_code, 0);
  const Outcome scalar = run({"render", f.file("o.ply"), f.file("mean.png"), "--size", "400,300"});
  ASSERT_EQ(scalar.exit_code, 0) << scalar.err;
  ASSERT_EQ(run({"render", f.file("o.ply"), f.file("labels.png"), "--labels", "--size", "400,300"}).exit_code, 0);
  for (const char* name : {"mean.png", "labels.png"}) {
    const std::string png = contents(f.file(name));
    ASSERT_GT(png.size(), 2000u);
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]), 400);
  }
  EXPECT_NE(contents(f.file("mean.png")), contents(f.file("labels.png")));
  const Outcome missing = run({"render", f.file("o.ply"), f.file("x.png"), "--field", "temperature"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("mean_curvature"), std::string::npos) << "the message lists the fields there are";
}

}  // namespace
}  // namespace kappa::apps
