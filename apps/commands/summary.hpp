// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "json.hpp"
#include "kappa/pipeline/measure_scan.hpp"
#include "progress.hpp"
#include "scan_command.hpp"

namespace kappa::app {

/// Prints what was done: text for people, or one JSON object, or nothing, as the options say.
void print_summary(const ScanCommand& arguments, const ScanResult& result, const std::vector<Stages::Timed>& timed);

/// What the filters did, for people; empty if nothing.
std::string describe(const FilteredScan& filtered);
Json to_json(const FilteredScan& filtered);

/// A number with four significant digits, for people.
std::string short_number(double value);

}  // namespace kappa::app
