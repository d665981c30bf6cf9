// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <exception>
#include <new>
#include <string>
#include <vector>

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

int fail(const char* what, int code = kappa::app::kFailed) {
  kappa::app::clear_progress();
  std::fprintf(stderr, "kappa: %s\n", what);
  return code;
}

/// Says which command does not exist, where that is what is wrong; CLI11 lists all words of the line, last first.
std::string unknown_command(const CLI::App& program) {
  const CLI::App* innermost = &program;
  while (!innermost->get_subcommands().empty()) innermost = innermost->get_subcommands().front();
  const std::vector<std::string> rest = innermost->remaining();
  std::string known;
  for (const CLI::App* command : innermost->get_subcommands([](const CLI::App*) { return true; }))
    known += (known.empty() ? "" : ", ") + command->get_name();
  if (rest.empty() || known.empty()) return {};
  return "'" + rest.front() + "' is none of " + known;
}

int fail_usage(const CLI::App& program, const CLI::ParseError& error) {
  const bool extra = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  const std::string message = extra ? unknown_command(program) : std::string();
  if (message.empty()) return program.exit(error) == 0 ? kappa::app::kDone : kappa::app::kUsage;
  std::fprintf(stderr, "%s\nRun with --help or --help-all for more information.\n", message.c_str());
  return kappa::app::kUsage;
}

int run(int argc, char** argv) {
  CLI::App program("Signed curvature of LIDAR scans, point clouds and meshes", "kappa");
  declare(program);
  try {
    program.parse(argc, argv);
    return kappa::app::kDone;
  } catch (const CLI::ParseError& error) {
    return fail_usage(program, error);
  } catch (const kappa::Cancelled&) {
    return fail("cancelled; nothing was written", kappa::app::kCancelled);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; give a smaller cloud, a smaller radius or fewer fields");
  }
}

/// What one stage frees the next one takes. Given back to the system in between, which the library does with whatever
/// is larger than 128 KiB, it comes back page by page and cleared: a third of the system time of a run.
void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kLargest = 32 << 20;  // the library allows no more; what is larger still goes back at once
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  try {
    keep_freed_memory();
    kappa::app::catch_interrupts();
    return run(argc, argv);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
