// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "checks.hpp"
#include "command.hpp"
#include "json.hpp"
#include "kappa/io/read.hpp"
#include "kappa/scan/compare.hpp"
#include "kappa/scan/scan.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

struct CompareArguments {
  std::string result, truth, suffix;
  double tolerance = 0;
  bool json = false;
};

void declare_compare(CLI::App& command, CompareArguments& arguments) {
  command.add_option("result", arguments.result, "File with curvature fields")->required();
  command.add_option("truth", arguments.truth, "File with the true fields for the same points")->required();
  command.add_option("--suffix", arguments.suffix, "Suffix of the fields of the result, such as _r0.5");
  command
      .add_option("--tolerance", arguments.tolerance,
                  "Distance by which points of the two may differ, for noisy results")
      ->check(not_negative());
  command.add_flag("--json", arguments.json, "As one JSON object on standard output");
}

void print_table(const std::vector<ErrorStatistics>& all) {
  std::printf("%-20s %9s %9s %10s %10s %10s %10s %10s %10s %10s\n", "field", "compared", "missing", "rms", "max",
              "50 %", "90 %", "99 %", "bias", "truth rms");
  for (const ErrorStatistics& s : all) {
    std::printf("%-20s %9zu %9zu", s.field.c_str(), s.compared, s.missing);
    for (const double value : {s.rms, s.max, s.p50, s.p90, s.p99, s.mean, s.truth_rms})
      std::printf(" %10s", short_number(value).c_str());
    std::printf("\n");
  }
  std::printf("errors are |result - truth|, of directions the angle in degrees; bias is the mean of result - truth\n");
}

void print_json(const std::vector<ErrorStatistics>& all) {
  Json json;
  for (const ErrorStatistics& s : all) {
    json.add(s.field, Json()
                          .add("compared", s.compared)
                          .add("missing", s.missing)
                          .add("rms", s.rms)
                          .add("max", s.max)
                          .add("p50", s.p50)
                          .add("p90", s.p90)
                          .add("p99", s.p99)
                          .add("bias", s.mean)
                          .add("truth_rms", s.truth_rms));
  }
  std::printf("%s\n", json.text().c_str());
}

void run_compare(const CompareArguments& arguments) {
  const Scan result = read_scan(arguments.result), truth = read_scan(arguments.truth);
  const auto all = compare_scans(result, truth, arguments.suffix, arguments.tolerance);
  if (arguments.json) {
    print_json(all);
  } else {
    print_table(all);
  }
}

}  // namespace

void add_compare(CLI::App& program) {
  add_command<CompareArguments>(program, "compare", "Errors between a result and the truth", declare_compare,
                                run_compare);
}

}  // namespace kappa::app
