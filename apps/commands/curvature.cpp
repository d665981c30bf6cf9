// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "pipeline.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

void declare_curvature(CLI::App& command, CurvatureArguments& arguments) {
  declare_files(command, arguments, ".ply .pcd .csv .vtp .las");
  declare_stages(command, arguments);
}

void run_curvature(const CurvatureArguments& arguments) {
  check_writable(arguments.output);
  Stages stages(arguments.run.threads, arguments.run.seed, arguments.run.quiet);
  const Measured m = measure_input(arguments, Keep::Curvatures, stages);
  stages.run("write", [&](const Execution& run) {
    const std::vector<Index> places = m.order.places();
    Scan out = output_scan(m, places, stage(run, 0.0, 0.1));
    for (std::size_t r = 0; r < m.fields.size(); ++r) {
      for (Field& field : curvature_fields(m.fields[r], field_suffix(m, r), places, stage(run, 0.1, 0.2)))
        out.fields.push_back(std::move(field));
    }
    write_scan(arguments.output, out, stage(run, 0.2, 1.0));
  });
  print_summary(arguments, m, {}, stages.timed());
}

}  // namespace

void add_curvature(CLI::App& program) {
  add_command<CurvatureArguments>(program, "curvature", "Signed curvature at every vertex or point", declare_curvature,
                                  run_curvature);
}

}  // namespace kappa::app
