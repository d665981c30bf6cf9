// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/segment/regions.hpp"
#include "pipeline.hpp"

namespace kappa::app {

/// A decomposition at one radius, as the summary shows it.
struct SegmentSummary {
  double threshold = 0;
  bool estimated = false;
  Segmentation segmentation;
};

/// Prints what was done: text for people, or one JSON object, or nothing, as the options say.
/// `segments` is empty or has one entry a radius.
void print_summary(const CurvatureArguments& arguments, const Measured& measured,
                   const std::vector<SegmentSummary>& segments, const std::vector<Stages::Timed>& timed);

/// A number with four significant digits, for people.
std::string short_number(double value);

}  // namespace kappa::app
