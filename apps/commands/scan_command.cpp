// SPDX-License-Identifier: BSD-3-Clause
#include "scan_command.hpp"

#include <utility>

#include "extensions.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa::app {
namespace {

/// What members of the pipeline's options are called here, where that is not the name of the member.
std::string option_of(const std::string& member) {
  const std::pair<const char*, const char*> names[] = {{"radii", "--radius"},
                                                       {"ground.max_rise", "--ground-max"},
                                                       {"ground.method", "--ground"},
                                                       {"surface.surface", "--surface"}};
  for (const auto& [path, option] : names) {
    if (member.size() >= std::string(path).size() &&
        member.compare(member.size() - std::string(path).size(), std::string::npos, path) == 0)
      return option;
  }
  const bool of_ground = member.find("ground.") != std::string::npos;
  std::string name = member.substr(member.rfind('.') + 1);
  for (char& c : name) c = c == '_' ? '-' : c;
  return (of_ground ? "--ground-" : "--") + name;
}

}  // namespace

void declare_files(CLI::App& command, ScanCommand& arguments, const std::string& outputs) {
  command.add_option("input", arguments.input, "Scan or mesh: " + readable())->required();
  command.add_option("output", arguments.output, "Result: " + outputs)->required();
}

void declare_run(CLI::App& command, ScanCommand& arguments) {
  RunOptions& options = arguments.run;
  command.add_option("--threads", options.threads, "Threads, 0 for all; the result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  command
      .add_option("--seed", arguments.scan.surface.seed, "Seed of the random numbers of --surface uniform, independent")
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "No progress bar and no summary");
  command.add_flag("--json", options.json, "Summary as one JSON object on standard output");
}

/// The members in backticks by the names that they have here.
std::string with_options(std::string reason) {
  for (std::size_t open; (open = reason.find('`')) != std::string::npos;) {
    const std::size_t close = reason.find('`', open + 1);
    if (close == std::string::npos) break;
    reason.replace(open, close + 1 - open, option_of(reason.substr(open + 1, close - open - 1)));
  }
  return reason;
}

/// Calls `check` and tells of its OptionError by the name that the option has here.
template <class Check>
void check_options(const Check& check) {
  try {
    check();
  } catch (const OptionError& e) {
    throw CLI::ValidationError(option_of(e.option()), with_options(e.reason()));
  }
}

void check(const ScanOptions& options) {
  check_options([&] { validate(options); });
}

void check_faces(const ScanOptions& options) {
  check_options([&] { need_faces(options); });
}

Scan read_input(ScanCommand& arguments, Stages& stages) {
  arguments.scan.name = arguments.input;
  return stages.run("read", [&](const Execution& run) { return read_scan(arguments.input, run); });
}

}  // namespace kappa::app
