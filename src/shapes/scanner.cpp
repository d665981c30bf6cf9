// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "check.hpp"
#include "house.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/random.hpp"
#include "root.hpp"

namespace kappa {
namespace {

/// Codes of the LAS format.
constexpr double kGround = 2, kBuilding = 6;

/// A survey from so high that most beams miss the tile would take for ever.
constexpr double kMaxShots = 1e9;

/// Heights that the scene cannot leave over the tile; not the tightest ones.
struct HeightRange {
  double low, high;
};

HeightRange height_range(const Scene& scene, double width, double depth) {
  const Terrain& terrain = scene.terrain;
  const double dx = terrain.slope.x() * width, dy = terrain.slope.y() * depth;
  HeightRange range{terrain.base + std::min(dx, 0.0) + std::min(dy, 0.0),
                    terrain.base + std::max(dx, 0.0) + std::max(dy, 0.0)};
  for (const auto& wave : terrain.waves) {
    range.low -= std::abs(wave.amplitude);
    range.high += std::abs(wave.amplitude);
  }
  for (const auto& bump : terrain.bumps) (bump.height < 0 ? range.low : range.high) += bump.height;
  double roof = 0;
  for (const auto& house : scene.buildings) {
    roof = std::max(roof, house.eaves + 0.5 * house.width * house.pitch);
    range.low += std::min(house.eaves, 0.0);
  }
  range.high += roof;
  // The slope goes on a little beyond the tile, and the beams need room above and below.
  const double margin = 1 + 0.1 * (range.high - range.low);
  return {range.low - margin, range.high + margin};
}

/// A point x = from + t direction, with `from` above the scene and `direction` a downward unit vector.
struct Beam {
  Vec3 from, direction;
  Vec3 at(double t) const { return from + t * direction; }
};

/// Where a beam enters a house; infinity if it passes it by.
struct HouseHit {
  double t = std::numeric_limits<double>::infinity();
  detail::HousePlane::Kind kind = detail::HousePlane::Kind::Wall;
};

/// Clips the beam at each plane of the house.
HouseHit hit_house(const Beam& beam, const std::vector<detail::HousePlane>& planes) {
  HouseHit hit;
  double enter = -std::numeric_limits<double>::infinity(), leave = std::numeric_limits<double>::infinity();
  for (const auto& plane : planes) {
    const double rate = plane.normal.dot(beam.direction), room = plane.offset - plane.normal.dot(beam.from);
    if (rate == 0 && room < 0) return {};
    if (rate < 0 && room / rate > enter) {
      enter = room / rate;
      hit.kind = plane.kind;
    }
    if (rate > 0) leave = std::min(leave, room / rate);
  }
  if (enter > leave) return {};
  hit.t = enter;
  return hit;
}

/// Follows beams to the first surface of a scene.
class Tracer {
 public:
  Tracer(const Scene& scene, const HeightRange& range) : terrain_(scene.terrain), range_(range) {
    for (const auto& house : scene.buildings) houses_.push_back(detail::house_planes(scene, house));
  }

  /// Where the beam first meets ground or a roof; nothing if it ends on a wall.
  std::optional<Vec3> trace(const Beam& beam) const {
    HouseHit first;
    for (const auto& house : houses_) {
      const HouseHit hit = hit_house(beam, house);
      if (hit.t < first.t) first = hit;
    }
    const std::optional<double> ground = hit_ground(beam);
    if (ground && *ground < first.t) return beam.at(*ground);
    if (std::isinf(first.t) || first.kind == detail::HousePlane::Kind::Wall) return std::nullopt;
    return beam.at(first.t);
  }

 private:
  /// Goes down the beam by steps that are short in plan, so that no crest of any size is missed, up to the
  /// first one that ends below ground.
  std::optional<double> hit_ground(const Beam& beam) const {
    constexpr double kInPlan = 0.5, kTolerance = 1e-11;  // m
    const auto clearance = [&](double t) {
      const Vec3 x = beam.at(t), &d = beam.direction;
      const HeightJet height = height_at(terrain_, x.x(), x.y());
      return std::pair(x.z() - height.z, d.z() - height.zx * d.x() - height.zy * d.y());
    };
    const double last = (beam.from.z() - range_.low) / -beam.direction.z();
    double low = (beam.from.z() - range_.high) / -beam.direction.z();
    const double steps = std::ceil((last - low) * beam.direction.head<2>().norm() / kInPlan) + 1;
    const double step = (last - low) / steps;
    for (; low < last; low += step) {
      if (clearance(low + step).first <= 0) return detail::bracketed_root(clearance, low, low + step, kTolerance);
    }
    return std::nullopt;
  }

  const Terrain& terrain_;
  HeightRange range_;
  std::vector<std::vector<detail::HousePlane>> houses_;
};

/// Strips and beams that give the density asked for on the mean ground.
struct FlightPlan {
  double ground = 0;       ///< mean height
  double half_swath = 0;   ///< m on the mean ground
  double first_strip = 0;  ///< x of the first flight line
  double strip_step = 0;   ///< m between flight lines
  int strips = 0;
  int beams = 0;           ///< a line
  double beam_step = 0;    ///< m between beams of a line
  double line_step = 0;    ///< m between lines
  std::int64_t lines = 0;  ///< a strip

  double strip_x(int strip) const { return first_strip + strip * strip_step; }
};

double mean_ground(const AirborneOptions& options) {
  constexpr int kCells = 32;
  double sum = 0;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const double x = options.width * (i + 0.5) / kCells, y = options.depth * (j + 0.5) / kCells;
      sum += height_at(options.scene.terrain, x, y).z;
    }
  }
  return sum / (kCells * kCells);
}

/// Sum of the widths of the strips inside the tile.
double flown_width(const FlightPlan& plan, double width) {
  double sum = 0;
  for (int strip = 0; strip < plan.strips; ++strip) {
    const double x = plan.strip_x(strip);
    sum += std::min(x + plan.half_swath, width) - std::max(x - plan.half_swath, 0.0);
  }
  return sum;
}

FlightPlan plan_flight(const AirborneOptions& options) {
  FlightPlan plan;
  plan.ground = mean_ground(options);
  plan.half_swath = (options.altitude - plan.ground) * std::tan(options.half_angle);
  plan.strip_step = 2 * plan.half_swath * (1 - options.overlap);
  const double left = std::max(0.0, options.width - 2 * plan.half_swath);
  detail::require_between("number of strips", 1 + left / plan.strip_step, 1, 10000);
  plan.strips = 1 + static_cast<int>(std::ceil(left / plan.strip_step - 1e-9));
  plan.first_strip = 0.5 * (options.width - (plan.strips - 1) * plan.strip_step);
  const double strip_density = options.density * options.width / flown_width(plan, options.width);
  const double beams = 2 * plan.half_swath * std::sqrt(strip_density);
  const double shots = 2 * plan.half_swath * options.depth * strip_density * plan.strips;
  detail::require_between("number of beams, whether they meet the tile or not,", shots, 1, kMaxShots);
  plan.beams = std::max(2, static_cast<int>(std::lround(beams)));
  plan.beam_step = 2 * plan.half_swath / plan.beams;
  plan.line_step = 1 / (strip_density * plan.beam_step);
  plan.lines = static_cast<std::int64_t>(std::ceil(options.depth / plan.line_step)) + 1;
  return plan;
}

/// Gathers the returns of a survey.
class Survey {
 public:
  explicit Survey(const AirborneOptions& options)
      : options_(options),
        plan_(plan_flight(options)),
        range_(height_range(options.scene, options.width, options.depth)),
        tracer_(options.scene, range_),
        random_(options.seed) {}

  Scan run() {
    for (int strip = 0; strip < plan_.strips; ++strip) {
      for (std::int64_t line = 0; line < plan_.lines; ++line) {
        for (int beam = 0; beam < plan_.beams; ++beam) shoot(strip, line, beam);
      }
    }
    return result();
  }

 private:
  void shoot(int strip, std::int64_t line, int beam) {
    // The random numbers are drawn for every beam: what one meets does not move the others.
    const double jitter_x = options_.jitter * random_.uniform(-0.5, 0.5);
    const double jitter_y = options_.jitter * random_.uniform(-0.5, 0.5);
    const double noise = options_.range_noise * random_.normal();
    const int copies = random_.uniform() < options_.duplicates ? 2 : 1;
    const bool northward = strip % 2 == 0;
    const bool back = options_.pattern == ScanPattern::Oscillating && line % 2 == 1;
    const double across = (beam + 0.5 + jitter_x) * plan_.beam_step - plan_.half_swath;
    const double flown = (static_cast<double>(line) + (beam + 0.5) / plan_.beams - 0.5 + jitter_y) * plan_.line_step;
    const double x = plan_.strip_x(strip);
    const double target_x = x + (back == northward ? -across : across);
    const double y = northward ? flown : options_.depth - flown;

    const Vec3 scanner(x, y, options_.altitude);
    const Vec3 direction = (Vec3(target_x, y, plan_.ground) - scanner).normalized();
    if (misses_tile(target_x, direction)) return;
    const std::optional<Vec3> hit = tracer_.trace({scanner, direction});
    if (!hit || !on_tile(*hit)) return;
    for (int copy = 0; copy < copies; ++copy) keep(*hit, *hit + noise * direction, strip);
  }

  /// Whether a beam is beyond the tile at all heights of the scene.
  bool misses_tile(double target_x, const Vec3& direction) const {
    const double reach = (range_.high - range_.low) * std::abs(direction.x() / direction.z());
    return target_x < -reach || target_x > options_.width + reach;
  }

  bool on_tile(const Vec3& x) const {
    return x.x() >= 0 && x.x() <= options_.width && x.y() >= 0 && x.y() <= options_.depth;
  }

  void keep(const Vec3& hit, const Vec3& measured, int strip) {
    const SceneSample sample = sample_scene(options_.scene, hit.x(), hit.y());
    SurfacePoint point = surface_point(hit.x(), hit.y(), sample.height);
    if (sample.crease_distance < options_.crease_margin) point.curvature = TrueCurvature();
    point.x = measured;
    points_.push_back(point);
    classification_.push_back(sample.building >= 0 ? kBuilding : kGround);
    strip_.push_back(strip);
    crease_distance_.push_back(sample.crease_distance);
  }

  Scan result() {
    Scan scan = scan_of(points_);
    scan.origin = options_.origin;
    if (options_.normals == ScanNormals::None) scan.normals.clear();
    scan.fields.push_back({"classification", Field::Type::UInt8, std::move(classification_)});
    scan.fields.push_back({"strip", Field::Type::UInt16, std::move(strip_)});
    if (!options_.scene.buildings.empty()) {
      scan.fields.push_back({"crease_distance", Field::Type::Float64, std::move(crease_distance_)});
    }
    return scan;
  }

  const AirborneOptions& options_;
  FlightPlan plan_;
  HeightRange range_;
  Tracer tracer_;
  Random random_;
  std::vector<SurfacePoint> points_;
  std::vector<double> classification_, strip_, crease_distance_;
};

void validate(const AirborneOptions& options) {
  kappa::validate(options.scene);
  detail::require_positive("width", options.width);
  detail::require_positive("depth", options.depth);
  detail::require_positive("density", options.density);
  const double points = options.density * options.width * options.depth;
  detail::require_between("number of points", points, 1, detail::kMaxPoints);
  detail::require_positive("altitude", options.altitude);
  const double top = height_range(options.scene, options.width, options.depth).high;
  if (!(options.altitude > top)) {
    detail::refuse("altitude", options.altitude, "above the scene, which may reach " + detail::number_text(top));
  }
  detail::require_between("half_angle", options.half_angle, 0.01, 1);
  detail::require_between("overlap", options.overlap, 0, 0.9);
  detail::require_between("jitter", options.jitter, 0, 1);
  detail::require_not_negative("range_noise", options.range_noise);
  detail::require_between("duplicates", options.duplicates, 0, 1);
  detail::require_finite("origin", options.origin.sum());
  detail::require_not_negative("crease_margin", options.crease_margin);
}

void validate(const WavesOptions& options) {
  detail::require_between("points", static_cast<double>(options.points), 1, detail::kMaxPoints);
  detail::require_positive("width", options.width);
  detail::require_positive("depth", options.depth);
  detail::require_finite("amplitude", options.amplitude);
  detail::require_positive("x_length", options.x_length);
  detail::require_positive("y_length", options.y_length);
  detail::require_not_negative("range_noise", options.range_noise);
  detail::require_finite("origin", options.origin.sum());
}

}  // namespace

Scan airborne_scan(const AirborneOptions& options) {
  validate(options);
  return Survey(options).run();
}

Scan waves_scan(const WavesOptions& options) {
  validate(options);
  Terrain terrain;
  terrain.waves = {{options.amplitude, options.x_length, options.y_length, 0, 0.5 * kPi}};
  Random random(options.seed);
  std::vector<SurfacePoint> points;
  points.reserve(options.points);
  for (std::size_t i = 0; i < options.points; ++i) {
    const double x = random.uniform(0, options.width), y = random.uniform(0, options.depth);
    points.push_back(surface_point(x, y, height_at(terrain, x, y)));
    points.back().x.z() += options.range_noise * random.normal();
  }
  Scan scan = scan_of(points);
  scan.origin = options.origin;
  if (options.normals == ScanNormals::None) scan.normals.clear();
  return scan;
}

}  // namespace kappa
