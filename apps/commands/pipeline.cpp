// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.hpp"

#include <algorithm>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/curvature/refine.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"
#include "kappa/search/flann_ball_sum.hpp"

namespace kappa::app {

namespace {

std::unique_ptr<BallSum> make_engine(MeasuredTriangles triangles, const MeasureArguments& arguments,
                                     const Execution& run) {
  if (arguments.engine == "flann") return std::make_unique<FlannBallSum>(std::move(triangles));
  return std::make_unique<MeasureTree>(std::move(triangles), arguments.precision, run);
}

/// Curvature needs one unit of length: degrees are none.
void refuse_degrees(const std::string& input, const Scan& scan) {
  if (!looks_geographic(scan)) return;
  throw Error(ErrorCode::InvalidData, input +
                                          ": its x and y are degrees, in which no curvature can be measured; "
                                          "project it first, for instance with 'pdal translate' and "
                                          "--filters.reprojection.out_srs=EPSG:32632 (your UTM zone)");
}

}  // namespace

/// Directions as the coordinates are, in those of the file.
void turn_directions(const HeightUnit& heights, std::vector<CurvatureField>& fields) {
  if (heights.z_scale() == 1) return;
  for (CurvatureField& field : fields) {
    for (CurvatureSample& s : field.samples) {
      s.k.dir_min = heights.direction_of_file(s.k.dir_min);
      s.k.dir_max = heights.direction_of_file(s.k.dir_max);
    }
  }
}

/// Curvatures of each point's own triangles, for a surface without faces.
std::vector<CurvatureField> measure_points(const SurfaceResult& result, TriangleScheme scheme,
                                           const SurfaceOptions& options, const Execution& run) {
  RandomTriangleOptions triangles;
  triangles.scheme = scheme;
  triangles.neighbours = options.neighbours.value_or(triangles.neighbours);
  triangles.triangles = options.triangles;
  std::vector<CurvatureField> fields = {
      random_triangle_curvatures(result.surface.mesh.vertices, result.surface.u, triangles, run)};
  turn_directions(result.filtered.heights, fields);
  return fields;
}

void check_fields(const std::string& input, const std::vector<CurvatureField>& fields) {
  for (const CurvatureField& field : fields) {
    const auto valid = [](const CurvatureSample& s) { return s.k.status == PointStatus::Valid; };
    if (std::any_of(field.samples.begin(), field.samples.end(), valid)) continue;
    if (field.own_scales())
      throw Error(ErrorCode::InvalidData, input + ": no point has a curvature at any radius; give other normals");
    throw Error(ErrorCode::InvalidData, input + ": no point has a curvature at radius " +
                                            radius_suffix(field.radius).substr(2) +
                                            "; give a larger radius, or other normals");
  }
}

void declare_files(CLI::App& command, SurfaceCommand& arguments, const std::string& outputs) {
  command.add_option("input", arguments.input, "Scan or mesh: .pcd .ply .obj .off .stl .vtp .las .xyz .pts .txt .csv")
      ->required();
  command.add_option("output", arguments.output, "Result: " + outputs)->required();
  declare(command, arguments.filters);
}

void declare_stages(CLI::App& command, CurvatureArguments& arguments) {
  declare(command, arguments.measure);
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

namespace {

/// The same with everything but the scan in the order `r.order`.
SurfaceResult make_sorted_surface(const SurfaceCommand& arguments, Stages& stages) {
  SurfaceOptions options = surface_options(arguments.surface);
  check(arguments.filters);
  SurfaceResult r;
  r.scan = stages.run("read", [&](const Execution&) { return read_scan(arguments.input); });
  refuse_degrees(arguments.input, r.scan);
  if (!arguments.run.quiet) warn(unit_warning(r.scan, arguments.input, arguments.filters));
  r.filtered = stages.run(
      "filter", [&](const Execution& run) { return filter(r.scan, arguments.input, arguments.filters, run); });
  if (options.viewpoint) options.viewpoint->z() *= r.filtered.heights.z_scale();
  r.surface = stages.run("surface", [&](const Execution& run) {
    if (!triangle_scheme(options.surface)) r.order = PointOrder(r.scan, run);
    return make_surface(r.order.changes() ? r.order.sorted(r.scan) : r.scan, options, run);
  });
  r.filtered.restore(r.scan);
  if (arguments.surface.flip) r.surface.u = flipped(r.surface.u);
  return r;
}

}  // namespace

SurfaceResult read_and_make_surface(const SurfaceCommand& arguments, Stages& stages) {
  SurfaceResult r = make_sorted_surface(arguments, stages);
  std::exchange(r.order, {}).restore(r.surface);
  return r;
}

void need_faces(const SurfaceArguments& arguments, const std::string& command) {
  if (!triangle_scheme(arguments.surface.surface)) return;
  throw CLI::ValidationError("--surface", std::string(name(arguments.surface.surface)) +
                                              " measures each point alone, for 'kappa curvature'; " + command +
                                              " needs faces, as of umbrella");
}

namespace {

/// The command with the smallest radius that is asked for, if any.
SurfaceCommand with_measured_radius(const CurvatureArguments& arguments) {
  SurfaceCommand command = arguments;
  for (const double radius : parse_radii(arguments.measure.radii)) {
    std::optional<double>& smallest = command.surface.surface.measured_radius;
    if (radius > 0) smallest = std::min(radius, smallest.value_or(radius));
  }
  return command;
}

MeasuredTriangles measure_faces(const Surface& surface, const MeasureArguments& how, const Execution& run) {
  if (how.refine > 0) return measure_refined(surface.mesh, surface.u, how.refine, run);
  const auto triangles_of = how.engine == "flann" ? measure_triangles : triangles_for_tree;
  return triangles_of(surface.mesh, surface.u, how.quads, run);
}

Measured make_balls(SurfaceResult surface, const CurvatureArguments& arguments, Keep keep, Stages& stages) {
  Measured m;
  static_cast<SurfaceResult&>(m) = std::move(surface);
  m.scan.fields = {};  // not written with the curvatures, and large
  m.faces = m.surface.mesh.faces.size();
  m.balls = stages.run("measures", [&](const Execution& run) {
    MeasuredTriangles triangles = measure_faces(m.surface, arguments.measure, stage(run, 0.0, 0.3));
    // The summary looks at the mesh again if it was refined.
    if (keep == Keep::Curvatures && arguments.measure.refine == 0) m.surface.mesh = {};
    if (keep == Keep::Curvatures) m.surface.twins = {};
    return make_engine(std::move(triangles), arguments.measure, stage(run, 0.3, 1.0));
  });
  m.has_faces = true;
  m.dropped_faces = m.balls->triangles().dropped_faces;
  return m;
}

}  // namespace

Measured prepare(const CurvatureArguments& arguments, Stages& stages) {
  return make_balls(read_and_make_surface(with_measured_radius(arguments), stages), arguments, Keep::Everything,
                    stages);
}

std::vector<double> choose_radii(const CurvatureArguments& arguments, Measured& measured) {
  if (arguments.measure.own_scales()) return {};
  std::vector<double> radii = parse_radii(arguments.measure.radii);
  measured.automatic = radii.empty();
  if (measured.automatic) radii = {automatic_radius(measured.surface)};
  if (!(radii.front() >= 0))
    throw Error(ErrorCode::InvalidData,
                arguments.input + ": no edge has a length, so no radius can be chosen; give one with --radius");
  const bool zero = std::find(radii.begin(), radii.end(), 0.0) != radii.end();
  if (zero && measured.surface.kind != SurfaceKind::Faces)
    throw Error(ErrorCode::InvalidArgument,
                "radius 0 is for meshes: a cloud has no faces of its own; give a radius of a few spacings (" +
                    radius_suffix(automatic_radius(measured.surface)).substr(2) + ")");
  return radii;
}

std::vector<CurvatureField> measure(const Measured& measured, const MeasureArguments& arguments,
                                    const std::vector<double>& radii, const Execution& run) {
  CurvatureOptions options;
  options.scale = arguments.own_scales() ? ScaleChoice::PerPoint : ScaleChoice::Given;
  options.radii = radii;
  options.order = arguments.order.value_or(1);
  options.ball = arguments.ball;
  options.border = arguments.border;
  options.vertex_limit = arguments.limit;
  std::vector<CurvatureField> fields = estimate_curvatures(*measured.balls, measured.surface.u, options, run);
  if (arguments.min_coverage > 0) {
    for (CurvatureField& field : fields) mark_borders(field, arguments.min_coverage);
  }
  turn_directions(measured.filtered.heights, fields);
  return fields;
}

namespace {

/// The first option given that has no meaning where each point is measured alone, or null.
const char* meaningless_for_points(const MeasureArguments& arguments) {
  if (!arguments.radii.empty()) return "--radius";
  if (arguments.order) return "--order";
  if (arguments.min_coverage > 0) return "--min-coverage";
  if (arguments.border != BorderEstimate::InBall) return "--border";
  return arguments.refine > 0 ? "--refine" : nullptr;
}

void restore_order(Measured& m) {
  const PointOrder order = std::exchange(m.order, {});
  order.restore(m.surface);
  for (CurvatureField& field : m.fields) order.restore(field);
}

}  // namespace

Measured measure_input(const CurvatureArguments& arguments, Keep keep, Stages& stages) {
  check_measure(arguments.measure);
  Measured m;
  if (const auto scheme = triangle_scheme(arguments.surface.surface.surface)) {
    const char* const option = meaningless_for_points(arguments.measure);
    if (option)
      throw CLI::ValidationError(option, std::string("has no meaning for ") + name(*scheme) +
                                             ", which measures triangles of each point alone; leave it out");
    static_cast<SurfaceResult&>(m) = read_and_make_surface(arguments, stages);
    const SurfaceOptions options = surface_options(arguments.surface);
    m.fields = stages.run("curvatures", [&](const Execution& run) { return measure_points(m, *scheme, options, run); });
  } else {
    m = make_balls(make_sorted_surface(with_measured_radius(arguments), stages), arguments, keep, stages);
    const std::vector<double> radii = choose_radii(arguments, m);
    m.fields =
        stages.run("curvatures", [&](const Execution& run) { return measure(m, arguments.measure, radii, run); });
    if (keep == Keep::Curvatures) m.balls.reset();
    if (keep == Keep::Everything) restore_order(m);
  }
  check_fields(arguments.input, m.fields);
  return m;
}

Scan output_scan(const SurfaceResult& result, const std::vector<Index>& places, const Execution& run) {
  const Scan& in = result.scan;
  Scan out;
  out.origin = in.origin;
  out.points = in.points;
  out.normals.resize(in.points.size());
  out.faces = in.faces;
  out.width = in.width;
  out.height = in.height;
  out.viewpoint = in.viewpoint;
  out.units = in.units;
  out.geographic = in.geographic;
  out.records = in.records;
  constexpr std::size_t kBlock = 4096;
  parallel_for(out.normals.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& u = result.surface.u[places.empty() ? i : places[i]];
      out.normals[i] = u.isZero(0) ? Vec3::Constant(kNaN) : result.filtered.heights.normal_of_file(u);
    }
  });
  return out;
}

std::string field_suffix(const Measured& measured, std::size_t radius) {
  return measured.fields.size() > 1 ? radius_suffix(measured.fields[radius].radius) : "";
}

}  // namespace kappa::app
