// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.hpp"

#include <algorithm>

#include "kappa/core/error.hpp"
#include "kappa/io/read.hpp"
#include "kappa/io/write.hpp"

namespace kappa::app {

void declare_input_output(CLI::App& command, CurvatureArguments& arguments) {
  command.add_option("input", arguments.input, "Scan or mesh: .pcd .ply .obj .off .stl .vtp .xyz .pts .txt .csv")
      ->required();
  command.add_option("output", arguments.output, "Result: .ply .pcd .csv .vtp")->required();
}

void declare_stages(CLI::App& command, CurvatureArguments& arguments) {
  declare(command, arguments.measure);
  declare(command, arguments.surface);
  declare(command, arguments.run);
}

Measured prepare(const CurvatureArguments& arguments, Stages& stages) {
  const SurfaceOptions options = surface_options(arguments.surface);
  Measured m;
  m.scan = stages.run("read", [&](const Execution&) { return read_scan(arguments.input); });
  m.surface = stages.run("surface", [&](const Execution& run) { return make_surface(m.scan, options, run); });
  if (arguments.surface.flip) m.surface.u = flipped(m.surface.u);
  m.balls = stages.run("measures", [&](const Execution& run) {
    return std::make_unique<FlannBallSum>(
        measure_triangles(m.surface.mesh, m.surface.u, arguments.measure.quads, run));
  });
  return m;
}

std::vector<double> choose_radii(const CurvatureArguments& arguments, Measured& measured) {
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
  const Surface& s = measured.surface;
  std::vector<double> positive;
  std::copy_if(radii.begin(), radii.end(), std::back_inserter(positive), [](double r) { return r > 0; });
  std::vector<CurvatureField> of_balls =
      estimate_curvatures(*measured.balls, s.mesh.vertices, s.u, positive, arguments.ball, run);
  std::vector<CurvatureField> fields;
  auto next = of_balls.begin();
  for (const double radius : radii)
    fields.push_back(radius > 0 ? std::move(*next++)
                                : estimate_at_vertices(measured.balls->triangles(), s.u, arguments.limit, run));
  return fields;
}

Measured measure_input(const CurvatureArguments& arguments, Stages& stages) {
  parse_radii(arguments.measure.radii);  // a wrong use is told before any work
  Measured m = prepare(arguments, stages);
  const std::vector<double> radii = choose_radii(arguments, m);
  m.fields = stages.run("curvatures",
                        [&](const Execution& run) { return measure(m, arguments.measure, radii, run); });
  for (const CurvatureField& field : m.fields) {
    if (summarise(field).valid == 0)
      throw Error(ErrorCode::InvalidData, arguments.input + ": no point has a curvature at radius " +
                                              radius_suffix(field.radius).substr(2) +
                                              "; give a larger radius, or other normals");
  }
  return m;
}

Scan output_scan(const Measured& measured) {
  const Scan& in = measured.scan;
  Scan out;
  out.origin = in.origin;
  out.points = in.points;
  out.normals = measured.surface.u;
  out.faces = in.faces;
  out.width = in.width;
  out.height = in.height;
  out.viewpoint = in.viewpoint;
  for (Vec3& u : out.normals) {
    if (u.isZero(0)) u.setConstant(kNaN);
  }
  return out;
}

std::string field_suffix(const Measured& measured, std::size_t radius) {
  return measured.fields.size() > 1 ? radius_suffix(measured.fields[radius].radius) : "";
}

}  // namespace kappa::app
