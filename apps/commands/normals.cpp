// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "extensions.hpp"
#include "kappa/io/write.hpp"
#include "kappa/pipeline/output.hpp"
#include "kappa/scan/scan.hpp"
#include "scan_command.hpp"

namespace kappa::app {
namespace {

void declare(CLI::App& command, ScanCommand& arguments) {
  declare_files(command, arguments, "the same with corrected normals, " + writable());
  declare_filters(command, arguments.scan.filter);
  declare_surface(command, arguments.scan);
  declare_run(command, arguments);
}

void run(ScanCommand arguments) {
  check(arguments.scan);
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.quiet);
  const SurfacedScan surfaced = surface_scan(read_input(arguments, stages), arguments.scan, stages);
  stages.run("write", [&](const Execution& execution) {
    Scan out = output_scan(surfaced, stage(execution, 0.0, 0.2));
    out.fields = surfaced.scan.fields;
    write_scan(arguments.output, out, stage(execution, 0.2, 1.0));
  });
  if (arguments.run.quiet) return;
  const Surface& s = surfaced.surface;
  std::printf("%s: %zu points, normals %s, sign by %s, %zu without a normal\n", arguments.output.c_str(),
              surfaced.scan.points.size(), name(s.normals), name(s.orientation),
              s.invalid_points + s.normalless_points);
}

}  // namespace

void add_normals(CLI::App& program) {
  add_command<ScanCommand>(program, "normals", "Corrected normals only", declare, run);
}

}  // namespace kappa::app
