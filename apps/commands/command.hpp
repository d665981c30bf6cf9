// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace kappa::app {

/// What the program exits with.
/// Cancelled: 128 + SIGINT, as shells have it.
inline constexpr int kDone = 0, kFailed = 1, kUsage = 2, kCancelled = 130;

/// Each adds its sub-command to the program. The command runs when the sub-command has been parsed, throws
/// kappa::Error where it fails and CLI::ValidationError on a wrong use that only shows with all options known.
void add_curvature(CLI::App& program);
void add_segment(CLI::App& program);
void add_mesh(CLI::App& program);
void add_normals(CLI::App& program);
void add_generate(CLI::App& program);
void add_compare(CLI::App& program);
void add_render(CLI::App& program);
void add_view(CLI::App& program);
void add_info(CLI::App& program);

/// Asks for one of the sub-commands of `command`; `what` they are called, such as "a shape". Unlike CLI11's own check
/// this lets a misspelt one be named.
inline void require_one(CLI::App& command, const std::string& what) {
  command.require_subcommand(0, 1);
  command.callback([&command, what] {
    if (command.get_subcommands().empty()) throw CLI::ValidationError("give " + what);
  });
}

/// Adds a sub-command that owns its options: `declare(command, options)` binds them, `run(options)` does the work.
template <class Options>
void add_command(CLI::App& program, const std::string& name, const std::string& description,
                 const std::function<void(CLI::App&, Options&)>& declare, const std::function<void(Options)>& run) {
  CLI::App* command = program.add_subcommand(name, description);
  const auto options = std::make_shared<Options>();
  declare(*command, *options);
  command->callback([options, run] { run(*options); });
}

}  // namespace kappa::app
