// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <optional>

#include "checks.hpp"
#include "command.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/segment/regions.hpp"
#include "pipeline.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

struct SegmentArguments {
  CurvatureArguments curvature;
  std::optional<double> kappa_max, flatness, min_region;
};

void declare_segment(CLI::App& command, SegmentArguments& arguments) {
  declare_files(command, arguments.curvature, ".ply .pcd .csv .vtp .las");
  declare_stages(command, arguments.curvature);
  command
      .add_option("--kappa-max", arguments.kappa_max,
                  "Curvature (1/length) that --flatness is a part of; default: 98th percentile of the principal ones")
      ->check(positive());
  command
      .add_option("--flatness", arguments.flatness,
                  "A curvature below this part of --kappa-max counts as 0; default: estimated from the data")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--min-region", arguments.min_region,
                  "Regions of a smaller area are merged into a neighbour; default: the disc of half the radius")
      ->check(not_negative());
}

double choose_threshold(const SegmentArguments& arguments, const Measured& m, const CurvatureField& field,
                        const Execution& run) {
  if (arguments.flatness || arguments.kappa_max) {
    constexpr double kFlatness = 0.05, kPercentile = 98;
    const double kappa_max = arguments.kappa_max ? *arguments.kappa_max : curvature_percentile(field, kPercentile);
    return arguments.flatness.value_or(kFlatness) * kappa_max;
  }
  const double threshold = estimate_threshold(*m.balls, m.surface.mesh.vertices, m.surface.u, field,
                                              arguments.curvature.measure.ball, m.surface.spacing, run);
  if (threshold >= 0) return threshold;
  throw Error(ErrorCode::InvalidData,
              arguments.curvature.input +
                  ": too few points have a curvature to tell flat from curved; give --kappa-max "
                  "and --flatness");
}

SegmentSummary segment(const SegmentArguments& arguments, const Measured& m, const CurvatureField& field,
                       const Execution& run) {
  SegmentSummary s;
  s.estimated = !arguments.flatness && !arguments.kappa_max;
  s.threshold = choose_threshold(arguments, m, field, run);
  const double half = 0.5 * typical_radius(field);  // a ball tells apart what is as large as its inner half
  const RegionOptions options{arguments.min_region.value_or(kPi * half * half)};
  s.segmentation = find_regions(m.surface.mesh, field, classify(field, s.threshold), options, m.surface.twins);
  for (Region& region : s.segmentation.table) region.centroid = m.filtered.heights.point_of_file(region.centroid);
  return s;
}

/// out.ply gives out.regions.csv, with several radii out.regions_r2.csv.
std::string regions_path(const std::string& output, const std::string& suffix) {
  return std::filesystem::path(output).replace_extension(".regions" + suffix + ".csv").string();
}

void write_results(const SegmentArguments& arguments, const Measured& m, const std::vector<SegmentSummary>& segments,
                   const Execution& run) {
  Scan out = output_scan(m);
  for (std::size_t r = 0; r < m.fields.size(); ++r) {
    const std::string suffix = field_suffix(m, r);
    for (Field& field : curvature_fields(m.fields[r], suffix)) out.fields.push_back(std::move(field));
    for (Field& field : segment_fields(segments[r].segmentation)) {
      field.name += suffix;
      out.fields.push_back(std::move(field));
    }
  }
  write_scan(arguments.curvature.output, out, run);
}

/// The tables first, so that the result is there only if all is; they go again if it cannot be written.
void write_all(const SegmentArguments& arguments, const Measured& m, const std::vector<SegmentSummary>& segments,
               const Execution& run) {
  std::vector<std::string> tables;
  try {
    for (std::size_t r = 0; r < segments.size(); ++r) {
      tables.push_back(regions_path(arguments.curvature.output, field_suffix(m, r)));
      write_regions(tables.back(), segments[r].segmentation, m.scan.origin);
    }
    write_results(arguments, m, segments, run);
  } catch (...) {
    std::error_code ignored;
    for (const std::string& table : tables) std::filesystem::remove(table, ignored);
    throw;
  }
}

void run_segment(const SegmentArguments& arguments) {
  const CurvatureArguments& common = arguments.curvature;
  need_faces(common.surface, "segment");
  check_writable(common.output);
  Stages stages(common.run.threads, common.run.seed, common.run.quiet);
  Measured m = measure_input(common, Keep::Everything, stages);
  const auto segments = stages.run("regions", [&](const Execution& run) {
    std::vector<SegmentSummary> all;
    for (const CurvatureField& field : m.fields) all.push_back(segment(arguments, m, field, run));
    return all;
  });
  m.balls.reset();  // half of the memory, before the output takes its own
  stages.run("write", [&](const Execution& run) { write_all(arguments, m, segments, run); });
  print_summary(common, m, segments, stages.timed());
}

}  // namespace

void add_segment(CLI::App& program) {
  add_command<SegmentArguments>(program, "segment",
                                "Curvature with a label and a region at every vertex or point, and a table of regions",
                                declare_segment, run_segment);
}

}  // namespace kappa::app
