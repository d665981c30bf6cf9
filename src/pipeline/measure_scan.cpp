// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/measure_scan.hpp"

#include <algorithm>
#include <utility>

#include "kappa/balls/splitting.hpp"
#include "kappa/core/decimal.hpp"
#include "kappa/core/error.hpp"
#include "kappa/curvature/shape_operators.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/pipeline/ball_sum.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"
#include "point_order.hpp"

namespace kappa {
namespace {

/// A scan with its surface, whose points stand in `order`.
struct SortedSurface {
  SurfacedScan surfaced;
  PointOrder order;
};

/// Curvature needs one unit of length: degrees are none.
void refuse_degrees(const Scan& scan, const std::string& name) {
  if (!looks_geographic(scan)) return;
  throw Error(ErrorCode::InvalidData, name +
                                          ": its x and y are degrees, in which no curvature can be measured; "
                                          "project it first, for instance with 'pdal translate' and "
                                          "--filters.reprojection.out_srs=EPSG:32632 (your UTM zone)");
}

/// The options of a surface whose smallest ball is known, where it is.
SurfaceOptions surface_options(const ScanOptions& options, const HeightUnit& heights) {
  SurfaceOptions surface = options.surface;
  if (surface.viewpoint) surface.viewpoint->z() *= heights.z_scale();
  for (const double radius : options.curvature.radii) {
    if (radius > 0) surface.measured_radius = std::min(radius, surface.measured_radius.value_or(radius));
  }
  return surface;
}

SortedSurface sorted_surface(Scan scan, const ScanOptions& options, StageWatch& watch) {
  SortedSurface s;
  SurfacedScan& r = s.surfaced;
  r.scan = std::move(scan);
  refuse_degrees(r.scan, options.name);
  const std::string warning = unit_warning(r.scan, options.name, options.filter);
  if (!warning.empty()) watch.warn(warning);
  r.filtered = run_stage(watch, "filter",
                         [&](const Execution& run) { return filter_scan(r.scan, options.name, options.filter, run); });
  const SurfaceOptions surface = surface_options(options, r.filtered.heights);
  r.surface = run_stage(watch, "surface", [&](const Execution& run) {
    if (!triangle_scheme(surface.surface)) s.order = PointOrder(r.scan, stage(run, 0.0, 0.0));
    return make_surface(s.order.changes() ? s.order.sorted(r.scan) : r.scan, surface, run);
  });
  r.filtered.restore(r.scan);
  if (options.flip) r.surface.u = flipped(r.surface.u);
  return s;
}

/// Whether faces are refined in vain: the normals are not those of a smooth surface through the points.
bool are_rough(const Surface& surface, const MeasureOptions& options, const Execution& run) {
  return options.refine > 0 && normal_roughness(surface.mesh, surface.u, run) > kRoughNormals;
}

/// The balls of a surface. With Keep::Curvatures gives up what is needed no more as early as can be.
PreparedScan with_balls(SurfacedScan surfaced, const ScanOptions& options, StageWatch& watch) {
  PreparedScan p;
  p.surfaced = std::move(surfaced);
  p.surfaced.scan.fields = {};  // not written with the curvatures, and large
  Surface& surface = p.surfaced.surface;
  p.faces = surface.mesh.faces.size();
  p.balls = run_stage(watch, "measures", [&](const Execution& run) {
    p.rough_normals = are_rough(surface, options.measure, stage(run, 0.0, 0.0));
    Triangles triangles = triangles_of(surface.mesh, surface.u, options.measure, stage(run, 0.0, 0.3));
    if (options.keep == Keep::Curvatures) {
      surface.mesh = {};
      surface.twins = {};
    }
    return make_ball_sum(std::move(triangles), options.measure, stage(run, 0.3, 1.0));
  });
  p.dropped_faces = p.balls->triangles().dropped_faces;
  return p;
}

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
std::vector<CurvatureField> measure_points(const SurfacedScan& surfaced, TriangleScheme scheme,
                                           const SurfaceOptions& options, const Execution& run) {
  std::vector<CurvatureField> fields = {random_triangle_curvatures(surfaced.surface.mesh.vertices, surfaced.surface.u,
                                                                   random_triangle_options(scheme, options), run)};
  turn_directions(surfaced.filtered.heights, fields);
  return fields;
}

void check_fields(const std::string& name, const std::vector<CurvatureField>& fields) {
  for (const CurvatureField& field : fields) {
    const auto valid = [](const CurvatureSample& s) { return s.k.status == PointStatus::Valid; };
    if (std::any_of(field.samples.begin(), field.samples.end(), valid)) continue;
    if (field.own_scales())
      throw Error(ErrorCode::InvalidData, name + ": no point has a curvature at any radius; give other normals");
    throw Error(ErrorCode::InvalidData, name + ": no point has a curvature at radius " + decimal(field.radius) +
                                            "; give a larger radius, or other normals");
  }
}

/// What has no meaning where each point is measured alone.
void check_alone(const ScanOptions& options, TriangleScheme scheme) {
  const auto refuse = [&](const char* option) {
    throw OptionError(option, std::string("has no meaning for ") + kappa::name(scheme) +
                                  ", which measures triangles of each point alone; leave it out");
  };
  const CurvatureOptions& c = options.curvature;
  if (c.scale != ScaleChoice::Automatic) refuse("curvature.radii");
  if (c.order) refuse("curvature.order");
  if (c.min_coverage > 0) refuse("curvature.min_coverage");
  if (c.border != BorderEstimate::InBall) refuse("curvature.border");
  if (options.measure.refine > 0) refuse("measure.refine");
  if (options.labels) need_faces(options);
}

/// Calls `check`, whose OptionError names a member of the struct `owner`.
template <class Check>
void check_member(const std::string& owner, const Check& check) {
  try {
    check();
  } catch (const OptionError& e) {
    throw OptionError(owner + "." + e.option(), e.reason());
  }
}

void measure_surface(ScanResult& result, const ScanOptions& options, StageWatch& watch) {
  const CurvatureOptions curvature = with_radii(options.curvature, result.prepared.surfaced.surface, options.name);
  result.automatic_radius = options.curvature.scale == ScaleChoice::Automatic;
  result.fields =
      run_stage(watch, "curvatures", [&](const Execution& run) { return measure(result.prepared, curvature, run); });
}

void restore_order(const PointOrder& order, ScanResult& result) {
  order.restore(result.prepared.surfaced.surface);
  for (CurvatureField& field : result.fields) order.restore(field);
}

void add_labels(ScanResult& result, const ScanOptions& options, StageWatch& watch) {
  result.labels = run_stage(watch, "regions", [&](const Execution& run) {
    std::vector<LabelledScan> all;
    for (std::size_t r = 0; r < result.fields.size(); ++r) {
      const double share = 1.0 / static_cast<double>(result.fields.size()), from = share * static_cast<double>(r);
      all.push_back(label(result.prepared, result.fields[r], options, stage(run, from, from + share)));
    }
    return all;
  });
}

ScanResult measure_alone(Scan scan, const ScanOptions& options, TriangleScheme scheme, StageWatch& watch) {
  ScanResult result;
  result.has_faces = false;
  result.prepared.surfaced = sorted_surface(std::move(scan), options, watch).surfaced;
  result.fields = run_stage(watch, "curvatures", [&](const Execution& run) {
    return measure_points(result.prepared.surfaced, scheme, options.surface, run);
  });
  check_fields(options.name, result.fields);
  return result;
}

}  // namespace

void need_faces(const ScanOptions& options) {
  if (!triangle_scheme(options.surface.surface)) return;
  throw OptionError("surface.surface",
                    std::string(name(options.surface.surface)) +
                        " measures each point alone, for curvatures; what is asked for needs faces, as of umbrella");
}

void validate(const ScanOptions& options) {
  check_member("filter", [&] { validate(options.filter); });
  if (const auto scheme = triangle_scheme(options.surface.surface)) check_alone(options, *scheme);
  check_member("measure", [&] { validate(options.measure); });
  check_member("curvature", [&] { validate(options.curvature, options.measure); });
}

SurfacedScan surface_scan(Scan scan, const ScanOptions& options, StageWatch& watch) {
  validate(options);
  SortedSurface s = sorted_surface(std::move(scan), options, watch);
  s.order.restore(s.surfaced.surface);
  return std::move(s.surfaced);
}

SurfacedScan surface_scan(Scan scan, const ScanOptions& options, const Execution& run) {
  EvenStages stages(run, 2);
  return surface_scan(std::move(scan), options, stages);
}

PreparedScan prepare_scan(Scan scan, const ScanOptions& options, StageWatch& watch) {
  validate(options);
  need_faces(options);
  ScanOptions everything = options;
  everything.keep = Keep::Everything;
  return with_balls(surface_scan(std::move(scan), everything, watch), everything, watch);
}

PreparedScan prepare_scan(Scan scan, const ScanOptions& options, const Execution& run) {
  EvenStages stages(run, 3);
  return prepare_scan(std::move(scan), options, stages);
}

CurvatureOptions with_radii(const CurvatureOptions& options, const Surface& surface, const std::string& name) {
  CurvatureOptions chosen = options;
  if (options.scale == ScaleChoice::PerPoint) return chosen;
  const double automatic = automatic_radius(surface);
  if (options.scale == ScaleChoice::Automatic) {
    chosen.scale = ScaleChoice::Given;
    chosen.radii = {automatic};
    if (!(automatic >= 0))
      throw Error(ErrorCode::InvalidData,
                  name + ": no edge has a length, so no radius can be chosen; give one with --radius");
  }
  const bool zero = std::find(chosen.radii.begin(), chosen.radii.end(), 0.0) != chosen.radii.end();
  if (zero && surface.kind != SurfaceKind::Faces)
    throw Error(ErrorCode::InvalidArgument,
                "radius 0 is for meshes: a cloud has no faces of its own; give a radius of a few spacings (" +
                    decimal(automatic) + ")");
  return chosen;
}

std::vector<CurvatureField> measure(const PreparedScan& prepared, const CurvatureOptions& options,
                                    const Execution& run) {
  std::vector<CurvatureField> fields = estimate_curvatures(*prepared.balls, prepared.surfaced.surface.u, options, run);
  turn_directions(prepared.surfaced.filtered.heights, fields);
  return fields;
}

LabelledScan label(const PreparedScan& prepared, const CurvatureField& field, const ScanOptions& options,
                   const Execution& run) {
  const Surface& surface = prepared.surfaced.surface;
  const LabelOptions how = options.labels.value_or(LabelOptions());
  LabelledScan s;
  s.estimated = how.estimates_threshold();
  s.threshold = label_threshold(how, *prepared.balls, surface.mesh.vertices, surface.u, field, options.curvature.ball,
                                surface.spacing, stage(run, 0.0, 0.5));
  if (!(s.threshold >= 0))
    throw Error(
        ErrorCode::InvalidData,
        options.name + ": too few points have a curvature to tell flat from curved; give --kappa-max and --flatness");
  const std::vector<Label> labels = classify(field, s.threshold, stage(run, 0.5, 0.6));
  const RegionOptions regions{least_region(how, field)};
  s.segmentation = find_regions(surface.mesh, field, labels, regions, surface.twins, stage(run, 0.6, 1.0));
  for (Region& region : s.segmentation.table)
    region.centroid = prepared.surfaced.filtered.heights.point_of_file(region.centroid);
  return s;
}

ScanResult measure_scan(Scan scan, const ScanOptions& options, StageWatch& watch) {
  validate(options);
  if (const auto scheme = triangle_scheme(options.surface.surface))
    return measure_alone(std::move(scan), options, *scheme, watch);
  ScanOptions how = options;
  if (options.labels) how.keep = Keep::Everything;
  SortedSurface sorted = sorted_surface(std::move(scan), how, watch);
  ScanResult result;
  result.prepared = with_balls(std::move(sorted.surfaced), how, watch);
  measure_surface(result, how, watch);
  if (how.keep == Keep::Curvatures) {
    result.prepared.balls.reset();
    result.places = sorted.order.places();
  } else {
    restore_order(sorted.order, result);
  }
  check_fields(how.name, result.fields);
  if (how.labels) add_labels(result, how, watch);
  return result;
}

ScanResult measure_scan(Scan scan, const ScanOptions& options, const Execution& run) {
  EvenStages stages(run, options.labels ? 5 : 4);
  return measure_scan(std::move(scan), options, stages);
}

}  // namespace kappa
