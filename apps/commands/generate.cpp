// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <optional>

#include "checks.hpp"
#include "command.hpp"
#include "kappa/io/write.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/analytic.hpp"
#include "kappa/shapes/noise.hpp"
#include "kappa/shapes/scanner.hpp"

namespace kappa::app {
namespace {

/// Options that every shape has. `seed` is that of the noise, and of the shape where it draws numbers.
struct OutputArguments {
  std::string output, origin;
  std::uint64_t seed = 0;
  std::optional<double> noise_ball, noise_normal;
  bool drop_normals = false, drop_faces = false, drop_truth = false, quiet = false;
};

void declare_output(CLI::App& shape, OutputArguments& o) {
  shape.add_option("output", o.output, "File with points, normals, faces and true curvature: .ply .pcd .csv .vtp .las")
      ->required();
  shape.add_option("--seed", o.seed, "Seed of whatever is random")->capture_default_str();
  shape.add_option("--origin", o.origin, "X,Y,Z that is added to the coordinates");
  shape.add_option("--noise", o.noise_ball, "Moves vertices within a ball of this part of their mean edge");
  shape.add_option("--noise-normal", o.noise_normal,
                   "Moves points along their normals, standard deviation as a length");
  shape.add_flag("--no-normals", o.drop_normals, "Leave the normals out");
  shape.add_flag("--no-faces", o.drop_faces, "Leave the faces out: a cloud");
  shape.add_flag("--no-truth", o.drop_truth, "Leave out true curvature and every other field: a small file");
  shape.add_flag("--quiet", o.quiet, "Say nothing");
}

void add_noise_as_asked(Scan& scan, const OutputArguments& o) {
  NoiseOptions noise;
  noise.seed = o.seed;
  if (o.noise_ball) {
    noise.kind = NoiseKind::Ball;
    noise.amount = *o.noise_ball;
    add_noise(scan, noise);
  }
  if (o.noise_normal) {
    noise.kind = NoiseKind::Normal;
    noise.amount = *o.noise_normal;
    add_noise(scan, noise);
  }
}

void finish(Scan scan, const OutputArguments& o) {
  add_noise_as_asked(scan, o);
  if (o.drop_normals) scan.normals.clear();
  if (o.drop_faces) scan.faces.clear();
  if (o.drop_truth) scan.fields.clear();
  if (!o.origin.empty()) {
    const std::vector<double> v = parse_numbers("--origin", o.origin, 3);
    scan.origin += Vec3(v[0], v[1], v[2]);
  }
  write_scan(o.output, scan);
  if (!o.quiet) std::printf("%s: %zu points, %zu faces\n", o.output.c_str(), scan.points.size(), scan.faces.size());
}

/// Adds the sub-command of one shape: `declare` binds its options, `make(options, seed)` makes the scan.
template <class Options, class Declare, class Make>
void add_shape(CLI::App& generate, const std::string& name, const std::string& description, Declare declare,
               Make make) {
  CLI::App* shape = generate.add_subcommand(name, description);
  const auto output = std::make_shared<OutputArguments>();
  const auto options = std::make_shared<Options>();
  declare_output(*shape, *output);
  declare(*shape, *options);
  shape->callback([=] {
    check_writable(output->output);
    finish(make(*options, output->seed), *output);
  });
}

void add_grid_faces(CLI::App& shape, GridFaces& faces) {
  shape.add_option("--faces", faces, "triangles, other-diagonal, quads")
      ->transform(choice<GridFaces>({{"triangles", GridFaces::Triangles},
                                     {"other-diagonal", GridFaces::OtherDiagonal},
                                     {"quads", GridFaces::Quads}}))
      ->option_text("KIND=triangles");
}

template <class T>
void add_value(CLI::App& shape, const std::string& option, T& value, const std::string& description) {
  shape.add_option(option, value, description)->capture_default_str();
}

/// Random points in place of the vertices, if asked for.
void add_samples(CLI::App& shape, std::size_t& points) {
  shape.add_option("--points", points, "Random points instead of a mesh, uniform by area");
}

template <class Options>
struct Sampled {
  Options shape;
  std::size_t points = 0;
};

void add_sphere(CLI::App& generate) {
  using O = Sampled<SphereOptions>;
  add_shape<O>(
      generate, "sphere", "Sphere along parallels and meridians",
      [](CLI::App& c, O& o) {
        add_value(c, "--radius", o.shape.radius, "Radius");
        add_value(c, "--slices", o.shape.slices, "Meridians");
        add_value(c, "--rings", o.shape.rings, "Bands between parallels");
        add_grid_faces(c, o.shape.faces);
        add_samples(c, o.points);
      },
      [](const O& o, std::uint64_t seed) {
        return o.points ? sample_sphere(o.shape.radius, {o.points, seed}) : sphere(o.shape);
      });
  add_shape<IcosphereOptions>(
      generate, "icosphere", "Sphere from an icosahedron, nearly even",
      [](CLI::App& c, IcosphereOptions& o) {
        add_value(c, "--radius", o.radius, "Radius");
        add_value(c, "--subdivisions", o.subdivisions, "Times each triangle is split in four");
      },
      [](const IcosphereOptions& o, std::uint64_t) { return icosphere(o); });
}

void add_torus(CLI::App& generate) {
  using O = Sampled<TorusOptions>;
  add_shape<O>(
      generate, "torus", "Torus around the z axis, with a twist if asked",
      [](CLI::App& c, O& o) {
        add_value(c, "--major", o.shape.major_radius, "Radius of the axis");
        add_value(c, "--minor", o.shape.minor_radius, "Radius of the tube");
        add_value(c, "--slices", o.shape.slices, "Vertices around the axis");
        add_value(c, "--sides", o.shape.sides, "Vertices around the tube");
        add_value(c, "--twist", o.shape.twist, "Turns of the edges around the tube");
        add_grid_faces(c, o.shape.faces);
        add_samples(c, o.points);
      },
      [](const O& o, std::uint64_t seed) {
        return o.points ? sample_torus(o.shape.major_radius, o.shape.minor_radius, {o.points, seed}) : torus(o.shape);
      });
}

void add_cylinder(CLI::App& generate) {
  using O = Sampled<CylinderOptions>;
  add_shape<O>(
      generate, "cylinder", "Cylinder around the z axis",
      [](CLI::App& c, O& o) {
        add_value(c, "--radius", o.shape.radius, "Radius");
        add_value(c, "--height", o.shape.height, "Height");
        add_value(c, "--slices", o.shape.slices, "Vertices around the axis");
        add_value(c, "--rings", o.shape.rings, "Bands along the axis");
        c.add_flag_callback(
            "--caps", [&o] { o.shape.caps = CylinderCaps::Flat; }, "Close the ends with discs");
        add_grid_faces(c, o.shape.faces);
        add_samples(c, o.points);
      },
      [](const O& o, std::uint64_t seed) {
        return o.points ? sample_cylinder(o.shape.radius, o.shape.height, {o.points, seed}) : cylinder(o.shape);
      });
  add_shape<LanternOptions>(
      generate, "lantern", "Schwarz lantern with the normals of its cylinder",
      [](CLI::App& c, LanternOptions& o) {
        add_value(c, "--radius", o.radius, "Radius");
        add_value(c, "--height", o.height, "Height");
        add_value(c, "--slices", o.slices, "Corners of each ring");
        add_value(c, "--rings", o.rings, "Bands");
      },
      [](const LanternOptions& o, std::uint64_t) { return lantern(o); });
}

void add_height_fields(CLI::App& generate) {
  using O = Sampled<QuadricOptions>;
  add_shape<O>(
      generate, "quadric", "z = (a x^2 + b y^2) / 2: domes, bowls, troughs",
      [](CLI::App& c, O& o) {
        add_value(c, "--a", o.shape.a, "1/length");
        add_value(c, "--b", o.shape.b, "1/length");
        add_value(c, "--size", o.shape.size, "Side of the square in plan");
        add_value(c, "--cells", o.shape.cells, "Quads along a side");
        add_grid_faces(c, o.shape.faces);
        add_samples(c, o.points);
      },
      [](const O& o, std::uint64_t seed) {
        return o.points ? sample_quadric(o.shape.a, o.shape.b, o.shape.size, {o.points, seed}) : quadric(o.shape);
      });
  add_shape<SaddleOptions>(
      generate, "saddle", "z = (x^2 - y^2) / (2 a)",
      [](CLI::App& c, SaddleOptions& o) {
        add_value(c, "--a", o.a, "Radius of curvature at the centre");
        add_value(c, "--size", o.size, "Side of the square in plan");
        add_value(c, "--cells", o.cells, "Quads along a side");
        add_grid_faces(c, o.faces);
      },
      [](const SaddleOptions& o, std::uint64_t) { return saddle(o); });
  add_shape<PlaneOptions>(
      generate, "plane", "Square in z = 0",
      [](CLI::App& c, PlaneOptions& o) {
        add_value(c, "--size", o.size, "Side");
        add_value(c, "--cells", o.cells, "Quads along a side");
        add_grid_faces(c, o.faces);
      },
      [](const PlaneOptions& o, std::uint64_t) { return plane(o); });
}

void add_goursat(CLI::App& generate) {
  using O = Sampled<GoursatOptions>;
  add_shape<O>(
      generate, "goursat", "3 (x^4 + y^4 + z^4) - 200 (x^2 + y^2 + z^2) = 800",
      [](CLI::App& c, O& o) {
        add_value(c, "--step", o.shape.step, "Step of the grid the mesh is extracted from");
        c.add_option("--extraction", o.shape.extraction, "marching-cubes, surface-nets")
            ->transform(choice<Extraction>(
                {{"marching-cubes", Extraction::MarchingCubes}, {"surface-nets", Extraction::SurfaceNets}}))
            ->option_text("KIND=marching-cubes");
        add_samples(c, o.points);
      },
      [](const O& o, std::uint64_t seed) {
        return o.points ? sample_goursat({o.points, seed}) : goursat(o.shape);
      });
}

void add_scans(CLI::App& generate) {
  add_shape<AirborneOptions>(
      generate, "airborne", "Simulated airborne LIDAR scan of a terrain with houses, without normals",
      [](CLI::App& c, AirborneOptions& o) {
        add_value(c, "--width", o.width, "Extent in x, m");
        add_value(c, "--depth", o.depth, "Extent in y, m");
        add_value(c, "--density", o.density, "Points per square metre");
        add_value(c, "--range-noise", o.range_noise, "Standard deviation along the beam, m");
        add_value(c, "--duplicates", o.duplicates, "Share of points stored twice");
        c.add_flag_callback(
            "--true-normals", [&o] { o.normals = ScanNormals::True; }, "Write the true normals");
      },
      [](AirborneOptions o, std::uint64_t seed) {
        o.seed = seed;
        return airborne_scan(o);
      });
  add_shape<WavesOptions>(
      generate, "waves", "Random points on z = A sin(x/a) cos(y/b)",
      [](CLI::App& c, WavesOptions& o) {
        add_value(c, "--points", o.points, "Number of points");
        add_value(c, "--width", o.width, "Extent in x");
        add_value(c, "--depth", o.depth, "Extent in y");
        add_value(c, "--amplitude", o.amplitude, "A");
        add_value(c, "--x-length", o.x_length, "a");
        add_value(c, "--y-length", o.y_length, "b");
        add_value(c, "--range-noise", o.range_noise, "Standard deviation along z");
      },
      [](WavesOptions o, std::uint64_t seed) {
        o.seed = seed;
        return waves_scan(o);
      });
}

}  // namespace

void add_generate(CLI::App& program) {
  CLI::App* generate = program.add_subcommand("generate", "Analytic shapes and simulated scans with true curvature");
  require_one(*generate, "a shape");
  add_sphere(*generate);
  add_torus(*generate);
  add_cylinder(*generate);
  add_height_fields(*generate);
  add_goursat(*generate);
  add_scans(*generate);
}

}  // namespace kappa::app
