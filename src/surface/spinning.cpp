// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/spinning.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "cell_grid.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"

namespace kappa {
namespace {

constexpr std::size_t kMaxRings = 512;
constexpr double kTurn = 2 * kPi;

/// One return in the directions of the sensor.
struct Return {
  double azimuth, elevation, distance;
  Index point;
};
using Ring = std::vector<Return>;

std::vector<Return> find_returns(const std::vector<Vec3>& points, const Vec3& sensor, SpinningSweep& sweep) {
  constexpr double kAtSensor = 1e-6;
  const double nearest = kAtSensor * bounds(points).diagonal();
  std::vector<Return> returns;
  for (Index i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - sensor;
    if (!is_finite(points[i])) {
      ++sweep.invalid_points;
    } else if (d.norm() <= nearest) {
      ++sweep.at_sensor;
    } else {
      returns.push_back({std::atan2(d.y(), d.x()), std::atan2(d.z(), d.head<2>().norm()), d.norm(), i});
    }
  }
  return returns;
}

/// Gap of the elevation above which one ring ends and the next begins; NaN if no ring stands out.
double ring_gap(const std::vector<Return>& sorted) {
  // Gaps below this, 0.00006 degrees, are those of one laser.
  constexpr double kSameAngle = 1e-6;
  constexpr double kSteepest = 3;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    gaps.push_back(std::max(kSameAngle, sorted[i].elevation - sorted[i - 1].elevation));
  if (gaps.size() < 2) return kNaN;
  std::sort(gaps.begin(), gaps.end(), std::greater<>());
  double steepest = kSteepest, gap = kNaN;
  for (std::size_t i = 0; i + 1 < std::min(gaps.size(), kMaxRings); ++i) {
    if (gaps[i] / gaps[i + 1] <= steepest) continue;
    steepest = gaps[i] / gaps[i + 1];
    gap = std::sqrt(gaps[i] * gaps[i + 1]);
  }
  return gap;
}

std::vector<Ring> rings_by_elevation(std::vector<Return> returns) {
  std::sort(returns.begin(), returns.end(), [](const Return& a, const Return& b) {
    return std::tie(a.elevation, a.point) < std::tie(b.elevation, b.point);
  });
  const double gap = ring_gap(returns);
  std::vector<Ring> rings;
  if (std::isnan(gap)) return rings;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    if (i == 0 || returns[i].elevation - returns[i - 1].elevation > gap) rings.emplace_back();
    rings.back().push_back(returns[i]);
  }
  return rings;
}

std::vector<Ring> rings_by_number(const std::vector<Return>& returns, const std::vector<double>& number) {
  std::map<double, Ring> of_number;
  for (const Return& r : returns) {
    if (std::isfinite(number[r.point])) of_number[number[r.point]].push_back(r);
  }
  std::vector<Ring> rings;
  rings.reserve(of_number.size());
  for (auto& entry : of_number) rings.push_back(std::move(entry.second));
  return rings;
}

double median(std::vector<double> values) {
  if (values.empty()) return kNaN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_elevation(const Ring& ring) {
  std::vector<double> angles;
  for (const Return& r : ring) angles.push_back(r.elevation);
  return median(std::move(angles));
}

/// From the highest ring down, each by increasing azimuth.
void sort_rings(std::vector<Ring>& rings, SpinningSweep& sweep) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < rings.size(); ++i) order.emplace_back(-median_elevation(rings[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<Ring> sorted;
  for (const auto& [elevation, i] : order) {
    sweep.elevation.push_back(-elevation);
    sorted.push_back(std::move(rings[i]));
    std::sort(sorted.back().begin(), sorted.back().end(), [](const Return& a, const Return& b) {
      return std::tie(a.azimuth, a.distance, a.point) < std::tie(b.azimuth, b.distance, b.point);
    });
  }
  rings = std::move(sorted);
}

/// Average step of the azimuth between neighbours in a ring, leaving out those with returns missing between them.
double azimuth_step(const std::vector<Ring>& rings) {
  constexpr double kSameDirection = 1e-6;
  std::vector<double> steps;
  for (const Ring& ring : rings) {
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const double step = ring[i].azimuth - ring[i - 1].azimuth;
      if (step > kSameDirection) steps.push_back(step);
    }
  }
  const double typical = median(steps);
  double sum = 0;
  std::size_t count = 0;
  for (const double step : steps) {
    if (step < 0.5 * typical || step > 1.5 * typical) continue;
    sum += step;
    ++count;
  }
  return count == 0 ? kNaN : sum / static_cast<double>(count);
}

/// Azimuth at the end of the widest gap in the data: the seam of the columns lies where there is nothing, if anywhere.
double seam(const std::vector<Ring>& rings) {
  std::vector<double> angles;
  for (const Ring& ring : rings) {
    for (const Return& r : ring) angles.push_back(r.azimuth);
  }
  std::sort(angles.begin(), angles.end());
  double start = angles.front(), widest = angles.front() + kTurn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] <= widest) continue;
    widest = angles[i] - angles[i - 1];
    start = angles[i];
  }
  return start;
}

/// Puts the returns of a ring into its columns. Azimuths jitter: a return whose column is taken by its neighbour takes
/// the next one, unless both look in one direction.
void fill_row(const Ring& ring, double start, SpinningSweep& sweep, Index* row) {
  const double width = static_cast<double>(sweep.columns);
  const auto columns = static_cast<std::ptrdiff_t>(sweep.columns);
  std::vector<std::pair<double, const Return*>> placed;
  for (const Return& r : ring) {
    const double turn = (r.azimuth - start) / kTurn;
    placed.emplace_back((turn - std::floor(turn)) * width, &r);
  }
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::ptrdiff_t last = -1;
  double last_position = -1, last_distance = 0;
  for (const auto& [position, r] : placed) {
    constexpr double kSameDirection = 0.25, kReach = 1.5;
    const bool same = last >= 0 && position - last_position < kSameDirection;
    const std::ptrdiff_t column = same ? last : std::max(last + 1, static_cast<std::ptrdiff_t>(position));
    const bool free = column < columns && static_cast<double>(column) - position < kReach;
    if (same || !free) ++sweep.extra_returns;
    if (!free || (same && r->distance >= last_distance)) continue;
    row[column] = r->point;
    last = column;
    last_position = position;
    last_distance = r->distance;
  }
}

void check_rings(const std::vector<Ring>& rings, std::size_t returns) {
  const std::string remedy = "; give their numbers, or another surface (umbrella)";
  if (rings.size() < 2)
    throw Error(ErrorCode::InvalidData,
                "no rings can be told apart among the " + std::to_string(returns) + " returns of the sweep" + remedy);
  if (rings.size() > kMaxRings || returns < 4 * rings.size())
    throw Error(ErrorCode::InvalidData, std::to_string(rings.size()) + " rings in " + std::to_string(returns) +
                                            " returns are no sweep of a spinning scanner" + remedy);
}

}  // namespace

SpinningSweep organise_sweep(const std::vector<Vec3>& points, const Vec3& sensor, const std::vector<double>& ring) {
  if (!is_finite(sensor))
    throw Error(ErrorCode::InvalidArgument, "the place of the sensor is not finite; give three finite coordinates");
  if (!ring.empty() && ring.size() != points.size())
    throw Error(ErrorCode::InvalidArgument, std::to_string(ring.size()) + " ring numbers for " +
                                                std::to_string(points.size()) + " points: give one a point");
  SpinningSweep sweep;
  std::vector<Return> returns = find_returns(points, sensor, sweep);
  std::vector<Ring> rings = ring.empty() ? rings_by_elevation(returns) : rings_by_number(returns, ring);
  check_rings(rings, returns.size());
  sort_rings(rings, sweep);
  const double step = azimuth_step(rings);
  if (std::isnan(step))
    throw Error(ErrorCode::InvalidData, "all returns of the sweep lie in one direction in plan; give another surface");
  sweep.rings = rings.size();
  sweep.columns = static_cast<std::size_t>(std::max(1.0, std::round(kTurn / step)));
  sweep.azimuth_step = kTurn / static_cast<double>(sweep.columns);
  sweep.cells.assign(sweep.rings * sweep.columns, kNoIndex);
  const double start = seam(rings);
  for (std::size_t i = 0; i < rings.size(); ++i) fill_row(rings[i], start, sweep, &sweep.cells[i * sweep.columns]);
  return sweep;
}

SpinningSurface spinning_surface(const Vec3& origin, const std::vector<Vec3>& points, const Vec3& sensor,
                                 const std::vector<double>& ring, const GridOptions& options, const Execution& run) {
  check(options, sensor);
  SpinningSurface result;
  result.sweep = organise_sweep(points, sensor, ring);
  check_cancelled(run);
  CloudSurface& s = result.grid.surface;
  s.mesh.origin = origin;
  s.mesh.vertices = points;
  s.invalid_points = result.sweep.invalid_points;
  CellGrid grid{result.sweep.columns, result.sweep.rings, result.sweep.cells, CellGrid::Columns::Closed};
  result.grid.cuts = add_cell_faces(grid, sensor, options, run, s.mesh);
  s.representative.assign(points.size(), kNoIndex);
  for (const Index i : grid.points) {
    if (i != kNoIndex) s.representative[i] = i;
  }
  s.starless_points = count_faceless(s.mesh) - result.sweep.at_sensor;
  return result;
}

}  // namespace kappa
