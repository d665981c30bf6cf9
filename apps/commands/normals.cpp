// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "progress.hpp"
#include "surface_options.hpp"

namespace kappa::app {
namespace {

struct NormalsArguments {
  std::string input, output;
  RunOptions run;
  SurfaceArguments surface;
};

void declare_normals(CLI::App& command, NormalsArguments& arguments) {
  command.add_option("input", arguments.input, "Scan or mesh")->required();
  command.add_option("output", arguments.output, "The same with corrected normals: .ply .pcd .csv .vtp")->required();
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

void run_normals(const NormalsArguments& arguments) {
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.seed, arguments.run.quiet);
  Scan scan = stages.run("read", [&](const Execution&) { return read_scan(arguments.input); });
  const SurfaceOptions options = surface_options(arguments.surface);
  const Surface s = stages.run("surface", [&](const Execution& run) { return make_surface(scan, options, run); });
  scan.normals = arguments.surface.flip ? flipped(s.u) : s.u;
  for (Vec3& u : scan.normals) {
    if (u.isZero(0)) u.setConstant(kNaN);
  }
  stages.run("write", [&](const Execution& run) { write_scan(arguments.output, scan, run); });
  if (arguments.run.quiet) return;
  std::printf("%s: %zu points, normals %s, sign by %s, %zu without a normal\n", arguments.output.c_str(),
              scan.points.size(), name(s.normals), name(s.orientation), s.invalid_points + s.normalless_points);
}

}  // namespace

void add_normals(CLI::App& program) {
  add_command<NormalsArguments>(program, "normals", "Corrected normals only", declare_normals, run_normals);
}

}  // namespace kappa::app
