// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <new>

#include "commands/command.hpp"
#include "commands/progress.hpp"
#include "kappa/core/error.hpp"

namespace {

void declare(CLI::App& program) {
  kappa::app::require_one(program, "a command");
  program.set_version_flag("--version", std::string("kappa ") + KAPPA_VERSION);
  program.set_help_all_flag("--help-all", "Help on every command");
  program.get_formatter()->column_width(34);
  kappa::app::add_curvature(program);
  kappa::app::add_segment(program);
  kappa::app::add_mesh(program);
  kappa::app::add_normals(program);
  kappa::app::add_generate(program);
  kappa::app::add_compare(program);
  kappa::app::add_render(program);
  kappa::app::add_view(program);
  kappa::app::add_info(program);
}

int fail(const char* what) {
  kappa::app::clear_progress();
  std::fprintf(stderr, "kappa: %s\n", what);
  return kappa::app::kFailed;
}

int run(int argc, char** argv) {
  CLI::App program("Signed curvature of LIDAR scans, point clouds and meshes", "kappa");
  declare(program);
  try {
    program.parse(argc, argv);
    return kappa::app::kDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kappa::app::kDone : kappa::app::kUsage;
  } catch (const kappa::Cancelled&) {
    return fail("cancelled; nothing was written");
  } catch (const std::bad_alloc&) {
    return fail("out of memory; give a smaller cloud, a smaller radius or fewer fields");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    kappa::app::catch_interrupts();
    return run(argc, argv);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
