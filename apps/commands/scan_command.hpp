// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "kappa/pipeline/measure_scan.hpp"
#include "kappa/scan/scan.hpp"
#include "progress.hpp"

namespace kappa::app {

/// Options that every command with a computation has.
struct RunOptions {
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

/// A command that reads a scan, computes with it and writes: the pipeline's options are what it was told.
struct ScanCommand {
  std::string input, output;
  RunOptions run;
  ScanOptions scan;
};

/// Input and output; `outputs` says what can be written.
void declare_files(CLI::App& command, ScanCommand& arguments, const std::string& outputs);

/// Options of each part of the pipeline. Words and numbers become values here; what options mean together is checked by
/// `check`.
void declare_filters(CLI::App& command, FilterOptions& options);
void declare_surface(CLI::App& command, ScanOptions& options);
void declare_curvature(CLI::App& command, ScanOptions& options);
void declare_run(CLI::App& command, ScanCommand& arguments);

/// Tells of options that do not go together before any work is done, by the names that the options have here.
/// @throws CLI::ValidationError.
void check(const ScanOptions& options);

/// The same for a command that needs faces.
void check_faces(const ScanOptions& options);

/// Reads the input as the stage "read", and names the scan after it.
Scan read_input(ScanCommand& arguments, Stages& stages);

}  // namespace kappa::app
