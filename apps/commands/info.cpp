// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "command.hpp"
#include "json.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/io/read.hpp"
#include "kappa/mesh/topology.hpp"
#include "kappa/pipeline/filter_scan.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/search/fitted_normals.hpp"
#include "kappa/surface/surface.hpp"
#include "progress.hpp"
#include "summary.hpp"

namespace kappa::app {
namespace {

struct InfoArguments {
  std::string input;
  FilterOptions filters;
  bool json = false;
};

struct Info {
  Scan scan;
  FilteredScan filtered;
  LengthUnits units;
  std::size_t invalid = 0, duplicates = 0;
  Bounds extent;  ///< in the coordinates of the file
  double spacing = kNaN, edge = kNaN, radius = kNaN, noise = kNaN;
  std::string reason;   ///< of the radius
  std::string surface;  ///< what `auto` would make of it, and why; empty if nothing
  Topology topology;
};

Info gather(const std::string& input, const FilterOptions& filters) {
  Info info;
  info.scan = read_scan(input);
  info.units = info.scan.units;
  info.filtered = filter_scan(info.scan, input, filters, {});
  const std::vector<Index> representative = find_duplicates(info.scan.points);
  for (Index i = 0; i < representative.size(); ++i) {
    info.invalid += representative[i] == kNoIndex;
    info.duplicates += representative[i] != kNoIndex && representative[i] != i;
  }
  info.extent = bounds(info.scan.points);
  info.extent.min = info.filtered.heights.point_of_file(info.extent.min + info.scan.origin);
  info.extent.max = info.filtered.heights.point_of_file(info.extent.max + info.scan.origin);
  info.spacing = median_spacing(info.scan.points);
  Surface surface;
  if (info.scan.is_mesh()) {
    const Mesh mesh = mesh_of(info.scan);
    info.topology = topology(mesh);
    info.edge = median_edge_length(mesh);
    surface.spacing = info.edge;
  } else if (info.scan.points.size() - info.invalid - info.duplicates > 3) {
    surface = make_surface(info.scan, {});
    info.surface = std::string(name(surface.kind)) + " (" + surface.reason + ")";
  }
  info.radius = automatic_radius(surface);
  info.reason = automatic_radius_reason(surface);
  info.noise = surface.scale.noise;
  info.filtered.restore(info.scan);
  return info;
}

std::string field_names(const Scan& scan) {
  std::string names;
  for (const Field& field : scan.fields) names += (names.empty() ? "" : " ") + field.name;
  return names.empty() ? "none" : names;
}

void print_topology(const Topology& t, double edge) {
  std::printf("faces       %zu: %zu triangles, %zu quads, %zu larger; median edge %s\n", t.faces, t.triangles, t.quads,
              t.polygons, short_number(edge).c_str());
  std::printf(
      "edges       %zu: %zu on a border, %zu in more than two faces, %zu with faces turned against each other\n",
      t.edges, t.border_edges, t.nonmanifold_edges, t.inconsistent_edges);
  std::printf("topology    %zu component%s, Euler number %ld, %zu vertices in no face\n", t.components,
              t.components == 1 ? "" : "s", t.euler, t.isolated_vertices);
}

void print_units(const LengthUnits& units) {
  if (!units.horizontal && !units.vertical) return;
  const auto text = [](std::optional<double> metres) { return metres ? short_number(*metres) + " m" : "not stated"; };
  std::printf("units       x and y %s, heights %s (coordinate system of the file)\n", text(units.horizontal).c_str(),
              text(units.vertical).c_str());
}

void print_text(const std::string& input, const Info& info) {
  const Scan& s = info.scan;
  std::printf("file        %s (%s)\n", input.c_str(), s.is_mesh() ? "mesh" : "cloud");
  const std::string filtered = describe(info.filtered);
  if (!filtered.empty()) std::printf("filter      %s\n", filtered.c_str());
  std::printf("points      %zu", s.points.size());
  if (s.is_organised()) std::printf(" (%zu x %zu)", s.width, s.height);
  std::printf(", %zu without a position, %zu at the position of another\n", info.invalid, info.duplicates);
  for (int axis = 0; axis < 3; ++axis)
    std::printf("%-11s %c %.6f ... %.6f\n", axis == 0 ? "extent" : "", "xyz"[axis], info.extent.min[axis],
                info.extent.max[axis]);
  print_units(info.units);
  std::printf("spacing     %s (median distance to the nearest other point)\n", short_number(info.spacing).c_str());
  std::printf("normals     %s\n", s.normals.empty() ? "none" : "one a point");
  std::printf("fields      %s\n", field_names(s).c_str());
  if (s.viewpoint) std::printf("viewpoint   %g %g %g\n", s.viewpoint->x(), s.viewpoint->y(), s.viewpoint->z());
  if (s.is_mesh()) print_topology(info.topology, info.edge);
  if (!info.surface.empty()) std::printf("surface     %s\n", info.surface.c_str());
  if (info.noise >= 0) std::printf("noise       %s (across the surface)\n", short_number(info.noise).c_str());
  std::printf("suggested   --radius %s (%s%s)\n", short_number(info.radius).c_str(), info.reason.c_str(),
              s.is_mesh() ? "; 0 for the finest scale" : "");
}

void print_json(const std::string& input, const Info& info) {
  const Scan& s = info.scan;
  const auto numbers = [](const Vec3& v) {
    return std::vector<std::string>{json_number(v.x()), json_number(v.y()), json_number(v.z())};
  };
  Json json;
  json.add("input", input)
      .add("filter", to_json(info.filtered))
      .add("points", s.points.size())
      .add("invalid_points", info.invalid);
  json.add("duplicate_points", info.duplicates).add("width", s.width).add("height", s.height);
  json.add_list("min", numbers(info.extent.min)).add_list("max", numbers(info.extent.max));
  json.add("spacing", info.spacing).add("normals", s.normals.size());
  std::vector<std::string> names;
  for (const Field& field : s.fields) names.push_back(json_string(field.name));
  json.add_list("fields", names);
  const Topology& t = info.topology;
  json.add("faces", t.faces).add("triangles", t.triangles).add("quads", t.quads).add("polygons", t.polygons);
  json.add("edges", t.edges).add("border_edges", t.border_edges).add("nonmanifold_edges", t.nonmanifold_edges);
  json.add("inconsistent_edges", t.inconsistent_edges).add("isolated_vertices", t.isolated_vertices);
  json.add("components", t.components).add("euler", static_cast<double>(t.euler)).add("median_edge", info.edge);
  json.add("metres_per_unit", info.units.horizontal.value_or(kNaN));
  json.add("metres_per_unit_of_height", info.units.vertical.value_or(kNaN));
  json.add("surface", info.surface).add("suggested_radius", info.radius).add("noise", info.noise);
  std::printf("%s\n", json.text().c_str());
}

}  // namespace

void add_info(CLI::App& program) {
  add_command<InfoArguments>(
      program, "info", "What is in a file: counts, extents, spacing, normals, topology, suggested radius",
      [](CLI::App& command, InfoArguments& arguments) {
        command.add_option("input", arguments.input, "Scan or mesh")->required();
        declare_filters(command, arguments.filters);
        command.add_flag("--json", arguments.json, "As one JSON object on standard output");
      },
      [](const InfoArguments& arguments) {
        const Info info = gather(arguments.input, arguments.filters);
        warn_user(unit_warning(info.scan, arguments.input, arguments.filters));
        if (arguments.json) {
          print_json(arguments.input, info);
        } else {
          print_text(arguments.input, info);
        }
      });
}

}  // namespace kappa::app
