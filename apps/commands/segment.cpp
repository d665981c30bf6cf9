// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "checks.hpp"
#include "command.hpp"
#include "extensions.hpp"
#include "kappa/io/regions_table.hpp"
#include "kappa/io/write.hpp"
#include "kappa/pipeline/output.hpp"
#include "scan_command.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

void declare_labels(CLI::App& command, LabelOptions& options) {
  command
      .add_option("--kappa-max", options.kappa_max,
                  "Curvature (1/length) that --flatness is a part of; default: 98th percentile of the principal ones")
      ->check(positive());
  command
      .add_option("--flatness", options.flatness,
                  "A curvature below this part of --kappa-max counts as 0; default: estimated from the data")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--min-region", options.min_region,
                  "Regions of a smaller area are merged into a neighbour; default: the disc of half the radius")
      ->check(not_negative());
}

void declare(CLI::App& command, ScanCommand& arguments) {
  declare_files(command, arguments, writable());
  declare_filters(command, arguments.scan.filter);
  declare_curvature(command, arguments.scan);
  declare_surface(command, arguments.scan);
  declare_run(command, arguments);
  declare_labels(command, arguments.scan.labels.emplace());
}

/// out.ply gives out.regions.csv, with several radii out.regions_r2.csv.
std::string regions_path(const std::string& output, const std::string& suffix) {
  return std::filesystem::path(output).replace_extension(".regions" + suffix + ".csv").string();
}

/// The tables first, so that the result is there only if all is; they go again if it cannot be written.
void write_all(const std::string& output, const ScanResult& result, const Execution& execution) {
  std::vector<std::string> tables;
  try {
    for (std::size_t r = 0; r < result.labels.size(); ++r) {
      tables.push_back(regions_path(output, field_suffix(result, r)));
      write_regions(tables.back(), result.labels[r].segmentation, result.prepared.surfaced.scan.origin,
                    stage(execution, 0.0, 0.0));
    }
    write_scan(output, output_scan(result, stage(execution, 0.0, 0.2)), stage(execution, 0.2, 1.0));
  } catch (...) {
    std::error_code ignored;
    for (const std::string& table : tables) std::filesystem::remove(table, ignored);
    throw;
  }
}

void run(ScanCommand arguments) {
  check(arguments.scan);
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.quiet);
  ScanResult result = measure_scan(read_input(arguments, stages), arguments.scan, stages);
  result.prepared.balls.reset();  // half of the memory, before the output takes its own
  stages.run("write", [&](const Execution& execution) { write_all(arguments.output, result, execution); });
  print_summary(arguments, result, stages.timed());
}

}  // namespace

void add_segment(CLI::App& program) {
  add_command<ScanCommand>(program, "segment",
                           "Curvature with a label and a region at every vertex or point, and a table of regions",
                           declare, run);
}

}  // namespace kappa::app
