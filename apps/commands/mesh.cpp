// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "progress.hpp"
#include "surface_options.hpp"

namespace kappa::app {
namespace {

struct MeshArguments {
  std::string input, output;
  RunOptions run;
  SurfaceArguments surface;
};

void declare_mesh(CLI::App& command, MeshArguments& arguments) {
  command.add_option("input", arguments.input, "Scan or mesh")->required();
  command.add_option("output", arguments.output, "Mesh with corrected normals: .ply .vtp")->required();
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

void run_mesh(const MeshArguments& arguments) {
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.seed, arguments.run.quiet);
  Scan scan = stages.run("read", [&](const Execution&) { return read_scan(arguments.input); });
  const SurfaceOptions options = surface_options(arguments.surface);
  const Surface s = stages.run("surface", [&](const Execution& run) { return make_surface(scan, options, run); });
  scan.normals = arguments.surface.flip ? flipped(s.u) : s.u;
  scan.faces = s.mesh.faces;
  scan.fields.clear();
  stages.run("write", [&](const Execution& run) { write_scan(arguments.output, scan, run); });
  if (arguments.run.quiet) return;
  std::printf("%s: %zu points, %zu faces (%s), normals %s\n", arguments.output.c_str(), scan.points.size(),
              scan.faces.size(), name(s.kind), name(s.normals));
}

}  // namespace

void add_mesh(CLI::App& program) {
  add_command<MeshArguments>(program, "mesh", "Triangulate a scan", declare_mesh, run_mesh);
}

}  // namespace kappa::app
