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
  declare_files(command, arguments, "mesh with corrected normals, " + writable_meshes());
  declare_filters(command, arguments.scan.filter);
  declare_surface(command, arguments.scan);
  declare_run(command, arguments);
}

void run(ScanCommand arguments) {
  check(arguments.scan);
  check_faces(arguments.scan);
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.quiet);
  const SurfacedScan surfaced = surface_scan(read_input(arguments, stages), arguments.scan, stages);
  stages.run("write", [&](const Execution& execution) {
    Scan out = output_scan(surfaced, stage(execution, 0.0, 0.2));
    out.faces = surfaced.surface.mesh.faces;
    write_scan(arguments.output, out, stage(execution, 0.2, 1.0));
  });
  if (arguments.run.quiet) return;
  const Surface& s = surfaced.surface;
  std::printf("%s: %zu points, %zu faces (%s), normals %s\n", arguments.output.c_str(), surfaced.scan.points.size(),
              s.mesh.faces.size(), name(s.kind), name(s.normals));
}

}  // namespace

void add_mesh(CLI::App& program) {
  add_command<ScanCommand>(program, "mesh", "Triangulate a scan", declare, run);
}

}  // namespace kappa::app
