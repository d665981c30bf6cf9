// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "extensions.hpp"
#include "kappa/io/write.hpp"
#include "kappa/pipeline/output.hpp"
#include "kappa/scan/scan.hpp"
#include "scan_command.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

void declare(CLI::App& command, ScanCommand& arguments) {
  declare_files(command, arguments, writable());
  declare_filters(command, arguments.scan.filter);
  declare_curvature(command, arguments.scan);
  declare_surface(command, arguments.scan);
  declare_run(command, arguments);
}

void run(ScanCommand arguments) {
  check(arguments.scan);
  check_writable(arguments.output);
  arguments.scan.keep = Keep::Curvatures;
  Stages stages(arguments.run.threads, arguments.run.quiet);
  const ScanResult result = measure_scan(read_input(arguments, stages), arguments.scan, stages);
  stages.run("write", [&](const Execution& execution) {
    const Scan out = output_scan(result, stage(execution, 0.0, 0.2));
    write_scan(arguments.output, out, stage(execution, 0.2, 1.0));
  });
  print_summary(arguments, result, stages.timed());
}

}  // namespace

void add_curvature(CLI::App& program) {
  add_command<ScanCommand>(program, "curvature", "Signed curvature at every vertex or point", declare, run);
}

}  // namespace kappa::app
