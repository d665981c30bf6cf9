// SPDX-License-Identifier: BSD-3-Clause
#include "summary.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "kappa/core/percentiles.hpp"

namespace kappa::app {
namespace {

std::size_t size_of(const std::optional<SetAside>& points) {
  return points ? points->size() : 0;
}

std::array<std::pair<const char*, std::size_t>, 6> counts_of(const FilteredScan& f) {
  return {{{"unplaced", f.selected.unplaced},
           {"class", f.selected.by_class},
           {"return", f.selected.by_returns},
           {"bounds", f.selected.by_bounds},
           {"ground", f.objects},
           {"voxel", f.thinned}}};
}

using Percentiles = FieldSummary::Percentiles;

struct NamedPercentiles {
  const char* name;
  const Percentiles& p;
};

std::array<NamedPercentiles, 4> percentiles_of(const FieldSummary& s) {
  return {{{"mean_curvature", s.mean}, {"gaussian_curvature", s.gaussian}, {"k_min", s.k_min}, {"k_max", s.k_max}}};
}

std::array<std::size_t, kLabelCount> count_labels(const std::vector<Label>& labels) {
  std::array<std::size_t, kLabelCount> counts{};
  for (const Label label : labels) ++counts[static_cast<std::size_t>(label)];
  return counts;
}

/// What planes or quadrics were fitted to.
std::string extent_of_fits(const Surface& s) {
  if (s.normal_neighbours == 0 || from_faces(s.normals)) return "";
  const std::string nearest = std::to_string(s.normal_neighbours) + " nearest";
  return s.normal_radius > 0 ? " of all points within " + short_number(s.normal_radius) + " or the " + nearest
                             : " of the " + nearest;
}

void print_points(const ScanResult& m) {
  const Surface& s = m.prepared.surfaced.surface;
  const std::string filtered = describe(m.prepared.surfaced.filtered);
  if (!filtered.empty()) std::printf("filter      %s\n", filtered.c_str());
  std::printf("points      %zu", m.prepared.surfaced.scan.points.size());
  if (s.duplicate_points) std::printf(", %zu at the position of another", s.duplicate_points);
  if (s.invalid_points) std::printf(", %zu without a position", s.invalid_points);
  if (s.normalless_points) std::printf(", %zu without a normal", s.normalless_points);
  if (s.starless_points) std::printf(", %zu without faces (isolated or on a line)", s.starless_points);
  if (s.at_sensor) std::printf(", %zu at the scanner (no return)", s.at_sensor);
  std::printf("\nsurface     %s (%s): ", name(s.kind), s.reason.c_str());
  if (m.has_faces) {
    std::printf("%zu faces, median edge %s", m.prepared.faces, short_number(s.spacing).c_str());
  } else {
    std::printf("triangles of each point alone, median spacing %s", short_number(s.spacing).c_str());
  }
  if (s.cut_faces) std::printf(", %zu cut (gap, depth edge or grazing)", s.cut_faces);
  const std::size_t dropped = m.prepared.dropped_faces;
  if (dropped) std::printf(", %zu left out (a corner lacks position or normal)", dropped);
  std::printf("\nnormals     %s%s, sign by %s\n", name(s.normals), extent_of_fits(s).c_str(), name(s.orientation));
}

void warn_of_disagreement(const NormalAgreement& agreement) {
  if (agreement.opposed_share() < kSuspiciousDisagreement) return;
  std::printf(
      "warning     %.1f %% of neighbouring normals point to opposite sides, so the sign of the curvature is in "
      "doubt; try --orient mst, or viewpoint X,Y,Z\n",
      100 * agreement.opposed_share());
}

template <class Value>
FieldSummary::Percentiles percentiles_of_valid(const CurvatureField& field, Value value) {
  std::vector<double> values;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status == PointStatus::Valid && !std::isnan(value(s))) values.push_back(value(s));
  }
  return percentiles(values);
}

FieldSummary::Percentiles errors_of(const CurvatureField& field) {
  return percentiles_of_valid(field, [](const CurvatureSample& s) { return s.std_error; });
}

void print_own_scales(const CurvatureField& field) {
  const auto radii = percentiles_of_valid(field, [](const CurvatureSample& s) { return s.radius; });
  std::printf("radius      chosen for every point: median %s, 98 %% of them %s to %s\n",
              short_number(radii.p50).c_str(), short_number(radii.p1).c_str(), short_number(radii.p99).c_str());
}

void warn_of_rough_normals(const ScanResult& m) {
  if (!m.prepared.rough_normals) return;
  std::printf(
      "warning     the normals are not those of a smooth surface through the points, so --refine gains nothing; "
      "leave it out\n");
}

Execution execution_of(const ScanCommand& arguments) {
  Execution run;
  run.threads = arguments.run.threads;
  return run;
}

void print_field(const ScanResult& m, const CurvatureField& field, const Execution& run) {
  const FieldSummary s = summarise(field, run);
  if (field.own_scales()) {
    print_own_scales(field);
    std::printf("curvatures  %zu valid", s.valid);
  } else if (m.has_faces) {
    const std::string why =
        m.automatic_radius ? " (automatic: " + automatic_radius_reason(m.prepared.surfaced.surface) + ")" : "";
    std::printf("radius      %s%s: %zu valid", short_number(field.radius).c_str(), why.c_str(), s.valid);
  } else {
    std::printf("curvatures  %zu valid", s.valid);
  }
  if (s.empty) std::printf(", %zu with no face in the ball", s.empty);
  if (s.degenerate) std::printf(", %zu with vanishing area", s.degenerate);
  if (s.border) std::printf(", %zu at a border", s.border);
  if (s.invalid) std::printf(", %zu without position or normal", s.invalid);
  std::printf("\n  %-20s %12s %12s %12s\n", "percentile", "1 %", "50 %", "99 %");
  for (const NamedPercentiles& n : percentiles_of(s))
    std::printf("  %-20s %12s %12s %12s\n", n.name, short_number(n.p.p1).c_str(), short_number(n.p.p50).c_str(),
                short_number(n.p.p99).c_str());
  if (field.order == 1) return;
  const auto errors = errors_of(field);
  std::printf("  %-20s %12s %12s %12s\n", "std_error", short_number(errors.p1).c_str(),
              short_number(errors.p50).c_str(), short_number(errors.p99).c_str());
}

void print_segments(const LabelledScan& s) {
  std::printf("labels      a curvature below %s counts as 0 (%s)\n", short_number(s.threshold).c_str(),
              s.estimated ? "estimated" : "given");
  const auto counts = count_labels(s.segmentation.labels);
  const double total = static_cast<double>(s.segmentation.labels.size());
  std::array<std::size_t, kLabelCount> regions{};
  for (const Region& region : s.segmentation.table) ++regions[static_cast<std::size_t>(region.label)];
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    std::printf("  %-20s %11.1f %% %8zu regions\n", name(static_cast<Label>(i)),
                100 * static_cast<double>(counts[i]) / total, regions[i]);
  }
}

void print_text(const ScanCommand& arguments, const ScanResult& m, const std::vector<Stages::Timed>& timed) {
  print_points(m);
  warn_of_disagreement(m.prepared.surfaced.surface.agreement);
  warn_of_rough_normals(m);
  for (std::size_t r = 0; r < m.fields.size(); ++r) {
    print_field(m, m.fields[r], execution_of(arguments));
    if (r < m.labels.size()) print_segments(m.labels[r]);
  }
  std::printf("seconds    ");
  for (const auto& stage : timed) std::printf(" %s %.2f", stage.name.c_str(), stage.seconds);
  std::printf("\nwritten     %s\n", arguments.output.c_str());
}

Json percentiles_json(const FieldSummary& s) {
  Json json;
  for (const NamedPercentiles& n : percentiles_of(s))
    json.add(n.name, Json().add("p1", n.p.p1).add("p50", n.p.p50).add("p99", n.p.p99));
  return json;
}

Json segments_json(const LabelledScan& s) {
  Json labels;
  const auto counts = count_labels(s.segmentation.labels);
  for (std::size_t i = 0; i < counts.size(); ++i) labels.add(name(static_cast<Label>(i)), counts[i]);
  return Json()
      .add("threshold", s.threshold)
      .add("estimated", s.estimated ? std::size_t{1} : std::size_t{0})
      .add("regions", s.segmentation.table.size())
      .add("labels", labels);
}

Json field_json(const CurvatureField& field, const Execution& run) {
  const FieldSummary s = summarise(field, run);
  return Json()
      .add("radius", field.radius)
      .add("typical_radius", typical_radius(field))
      .add("order", static_cast<std::size_t>(field.order))
      .add("median_std_error", errors_of(field).p50)
      .add("valid", s.valid)
      .add("empty", s.empty)
      .add("degenerate", s.degenerate)
      .add("border", s.border)
      .add("invalid", s.invalid)
      .add("percentiles", percentiles_json(s));
}

void print_json(const ScanCommand& arguments, const ScanResult& m, const std::vector<Stages::Timed>& timed) {
  std::vector<std::string> fields;
  for (std::size_t r = 0; r < m.fields.size(); ++r) {
    Json field = field_json(m.fields[r], execution_of(arguments));
    if (r < m.labels.size()) field.add("segments", segments_json(m.labels[r]));
    fields.push_back(field.text());
  }
  Json seconds;
  for (const auto& stage : timed) seconds.add(stage.name, stage.seconds);
  const Surface& s = m.prepared.surfaced.surface;
  std::printf("%s\n", Json()
                          .add("input", arguments.input)
                          .add("output", arguments.output)
                          .add("points", m.prepared.surfaced.scan.points.size())
                          .add("filter", to_json(m.prepared.surfaced.filtered))
                          .add("faces", m.prepared.faces)
                          .add("dropped_faces", m.prepared.dropped_faces)
                          .add("cut_faces", s.cut_faces)
                          .add("at_sensor", s.at_sensor)
                          .add("opposed_normals", s.agreement.opposed_share())
                          .add("duplicate_points", s.duplicate_points)
                          .add("invalid_points", s.invalid_points)
                          .add("normalless_points", s.normalless_points)
                          .add("starless_points", s.starless_points)
                          .add("surface", name(s.kind))
                          .add("reason", s.reason)
                          .add("normals", name(s.normals))
                          .add("orientation", name(s.orientation))
                          .add("spacing", s.spacing)
                          .add("radius_reason", m.automatic_radius ? automatic_radius_reason(s) : std::string())
                          .add("noise", s.scale.noise)
                          .add("normal_neighbours", static_cast<std::size_t>(s.normal_neighbours))
                          .add("normal_radius", s.normal_radius)
                          .add_list("fields", fields)
                          .add("seconds", seconds)
                          .text()
                          .c_str());
}

}  // namespace

std::string short_number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

void print_summary(const ScanCommand& arguments, const ScanResult& result, const std::vector<Stages::Timed>& timed) {
  if (arguments.run.json) {
    print_json(arguments, result, timed);
  } else if (!arguments.run.quiet) {
    print_text(arguments, result, timed);
  }
}

std::string describe(const FilteredScan& f) {
  std::string text;
  for (const auto& [name, count] : counts_of(f)) {
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) +
            (std::string(name) == "unplaced" ? " without a position" : std::string(" by ") + name);
  }
  if (!text.empty()) text = std::to_string(f.points) + " points read; taken away: " + text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(size_of(f.no_returns), " points at (0, 0, 0) are taken for no returns");
  add(size_of(f.withheld), " points are flagged as withheld and not measured (--withheld measures them)");
  return text;
}

Json to_json(const FilteredScan& f) {
  Json json;
  json.add("points_read", f.points).add("no_returns", size_of(f.no_returns)).add("withheld", size_of(f.withheld));
  for (const auto& [name, count] : counts_of(f)) json.add(name, count);
  return json.add("z_scale", f.heights.z_scale());
}

}  // namespace kappa::app
