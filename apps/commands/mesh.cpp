// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "pipeline.hpp"

namespace kappa::app {
namespace {

void declare_mesh(CLI::App& command, SurfaceCommand& arguments) {
  declare_files(command, arguments, "mesh with corrected normals, .ply .vtp");
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

void run_mesh(const SurfaceCommand& arguments) {
  need_faces(arguments.surface, "mesh");
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.seed, arguments.run.quiet);
  const SurfaceResult result = read_and_make_surface(arguments, stages);
  Scan out = output_scan(result);
  out.faces = result.surface.mesh.faces;
  stages.run("write", [&](const Execution& run) { write_scan(arguments.output, out, run); });
  if (arguments.run.quiet) return;
  std::printf("%s: %zu points, %zu faces (%s), normals %s\n", arguments.output.c_str(), out.points.size(),
              out.faces.size(), name(result.surface.kind), name(result.surface.normals));
}

}  // namespace

void add_mesh(CLI::App& program) {
  add_command<SurfaceCommand>(program, "mesh", "Triangulate a scan", declare_mesh, run_mesh);
}

}  // namespace kappa::app
