// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "checks.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/pcl/ground.hpp"
#include "scan_command.hpp"

namespace kappa::app {
namespace {

Bounds parse_bounds(const std::string& text) {
  const char* const option = "--bounds";
  const auto commas = std::count(text.begin(), text.end(), ',');
  if (commas != 3 && commas != 5)
    throw CLI::ValidationError(option, "'" + text + "' is not XMIN,YMIN,XMAX,YMAX or ...,ZMIN,ZMAX");
  const std::vector<double> v = parse_numbers(option, text, static_cast<std::size_t>(commas) + 1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{v[0], v[1], -kInfinity}, {v[2], v[3], kInfinity}};
  if (commas == 5) {
    bounds.min.z() = v[4];
    bounds.max.z() = v[5];
  }
  if ((bounds.min.array() <= bounds.max.array()).all()) return bounds;
  throw CLI::ValidationError(option, "'" + text + "' has a least coordinate above the greatest");
}

/// The ground filter that is asked for, made at the first of its options.
GroundFilter& ground_of(FilterOptions& options) {
  if (!options.ground) {
    options.ground.emplace();
    options.ground->progressive = progressive_ground;
  }
  return *options.ground;
}

void take_ground(const std::string& word, FilterOptions& options) {
  for (const Named<GroundMethod>& named : names_of(GroundMethod{})) {
    if (word == named.name) ground_of(options).method = named.value;
  }
}

void declare_ground(CLI::App& command, FilterOptions& options) {
  const auto known = [](std::string& word) {
    for (const Named<GroundMethod>& named : names_of(GroundMethod{})) {
      if (word == named.name) return std::string();
    }
    return "'" + word + "' is none of " + words_of<GroundMethod>();
  };
  const auto word = std::make_shared<std::string>();
  command
      .add_flag("--ground{smrf}", *word,
                "Leave the ground of an airborne scan; --ground=pmf: by PCL's progressive morphological filter")
      ->check(CLI::Validator(known, ""))
      ->each([&options, word](const std::string& given) { take_ground(given, options); });
  const auto add = [&](const char* name, std::optional<double> GroundFilter::*member, const char* help) {
    command
        .add_option_function<double>(
            name, [&options, member](double value) { ground_of(options).*member = value; }, help)
        ->check(not_negative())
        ->needs("--ground");
  };
  const GroundOptions d;
  const ProgressiveGroundOptions p;
  const auto text = [](double value) { return CLI::detail::to_string(value); };
  add("--ground-cell", &GroundFilter::cell, ("Cell of the ground filter; default " + text(d.cell) + " m").c_str());
  add("--ground-slope", &GroundFilter::slope,
      ("Rise over run above which it is an object; default " + text(d.slope) + ", pmf " + text(p.slope)).c_str());
  add("--ground-window", &GroundFilter::window,
      ("Half the width of the largest object; default " + text(d.window) + " m, pmf largest window " + text(p.window) +
       " m")
          .c_str());
  add("--ground-threshold", &GroundFilter::threshold,
      ("Distance of ground from its surface; default " + text(d.threshold) + " m").c_str());
  add("--ground-scaling", &GroundFilter::scaling,
      ("Growth of that with the slope; default " + text(d.scaling) + ", not for pmf").c_str());
  add("--ground-max", &GroundFilter::max_rise,
      ("Greatest rise in a window, for pmf alone; default " + text(p.max_distance) + " m").c_str());
}

}  // namespace

void declare_filters(CLI::App& command, FilterOptions& options) {
  command.add_option("--class", options.points.classes, "Only points of these classes, as 2 for the ground of a LAS")
      ->delimiter(',')
      ->check(CLI::Range(0, 255))
      ->option_text("N[,N...]");
  add_choice(command, "--returns", options.points.returns, "Which returns of each pulse", "WHICH");
  command
      .add_option_function<std::string>(
          "--bounds", [&options](const std::string& text) { options.points.bounds = parse_bounds(text); },
          "Only points within XMIN,YMIN,XMAX,YMAX[,ZMIN,ZMAX] in the coordinates of the file")
      ->option_text("X,Y,X,Y[,Z,Z]");
  command.add_flag_callback(
      "--withheld", [&options] { options.withheld = Withheld::Measured; },
      "Measure points that are flagged as withheld, too");
  command.add_option("--voxel", options.voxel, "Thin to one point (nearest to the mean) in each cube of this size")
      ->check(positive())
      ->option_text("SIZE");
  command.add_option("--z-scale", options.z_scale, "Units of x and y in a unit of height, where they differ")
      ->check(positive())
      ->option_text("S=1");
  declare_ground(command, options);
}

}  // namespace kappa::app
