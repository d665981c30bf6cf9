// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "pipeline.hpp"

namespace kappa::app {
namespace {

void declare_normals(CLI::App& command, SurfaceCommand& arguments) {
  declare_files(command, arguments, "the same with corrected normals, .ply .pcd .csv .vtp .las");
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

void run_normals(const SurfaceCommand& arguments) {
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.seed, arguments.run.quiet);
  const SurfaceResult result = read_and_make_surface(arguments, stages);
  Scan out = output_scan(result);
  out.fields = result.scan.fields;
  stages.run("write", [&](const Execution& run) { write_scan(arguments.output, out, run); });
  if (arguments.run.quiet) return;
  const Surface& s = result.surface;
  std::printf("%s: %zu points, normals %s, sign by %s, %zu without a normal\n", arguments.output.c_str(),
              out.points.size(), name(s.normals), name(s.orientation), s.invalid_points + s.normalless_points);
}

}  // namespace

void add_normals(CLI::App& program) {
  add_command<SurfaceCommand>(program, "normals", "Corrected normals only", declare_normals, run_normals);
}

}  // namespace kappa::app
