// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/scale.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kappa/core/error.hpp"
#include "kappa/mesh/orders.hpp"
#include "kappa/mesh/statistics.hpp"
#include "kappa/mesh/topology.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::size_t kPatches = 48, kPatch = 40;  ///< pilots, and points of each
constexpr std::size_t kMostRungs = 80;
/// Rungs in a factor sqrt(2), by which the balls of an order and the estimates that are compared differ.
constexpr std::size_t kStep = 2;
/// Averagings over the neighbours: the changes of near vertices are all but independent, their errors nearly equal.
constexpr int kPasses = 24;
/// Rise of the error over the least one so far past which a rung is bias, not chance. On the finest rungs the normals
/// of neighbours vary together, and the change shows less of the noise than it does further up.
constexpr double kRise = 2, kFineRise = 4;
constexpr std::size_t kFineRungs = 3 * kStep;
/// Estimates so many steps apart must differ by no more than their noise, in mean squares by this factor, if the lower
/// one is not on the finest rungs: under heavy noise bias comes in without any rise.
constexpr std::size_t kNearest = 2, kFarthest = 4, kFirstCompared = 4 * kStep;
constexpr double kDisagreement = 3;
/// Least radius in spacings of the centre: a narrower ball sees one star, and no noise.
constexpr double kLeastSpacings = 0.7;
/// Mean square error over mean square change of white noise on the rims, and the factor taken: where bias and noise are
/// in balance it is 0.83, 0.27, 0.09, and what is chosen lies between.
constexpr std::array<double, kMaxOrder> kNoiseOfChange = {0.74, 0.60, 0.55};
constexpr std::array<double, kMaxOrder> kErrorOfChange = {0.8, 0.4, 0.3};

/// What the scale is chosen by: the second form (11, 12, 22) and the mean; NaN where a ball gives none.
using Rung = std::array<double, 4>;
constexpr Rung kNone = {kNaN, kNaN, kNaN, kNaN};

struct FaceVertex {
  Index face, vertex;
  bool operator<(const FaceVertex& other) const {
    return face != other.face ? face < other.face : vertex < other.vertex;
  }
};

/// The vertices of the faces of the mesh, sorted; the triangles may stand in any order.
std::vector<FaceVertex> face_vertices(const MeasuredTriangles& t, const std::vector<Index>& parts) {
  std::vector<FaceVertex> all;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Index face = t.faces[i];
    // Of a face in several parts each vertex is the first corner of one.
    const std::size_t corners = parts[face] > 1 ? 1 : 3;
    for (std::size_t c = 0; c < corners; ++c)
      if (t.corners[i][c] < t.vertices) all.push_back({face, t.corners[i][c]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The graph of the vertices and the edge of the even triangulation that has their area.
struct Surroundings {
  Adjacency neighbours;
  std::vector<double> spacing;  ///< 0 for a vertex in no face
  double typical_spacing = kNaN;
};

Surroundings surroundings(const MeasuredTriangles& t) {
  const std::vector<Index> parts = parts_of_faces(t);
  std::vector<double> face_areas(parts.size()), areas(t.vertices);
  for (std::size_t i = 0; i < t.size(); ++i) face_areas[t.faces[i]] += t.measures[i].area;
  const std::vector<FaceVertex> of_faces = face_vertices(t, parts);
  Mesh graph;
  graph.vertices.resize(t.vertices);
  std::vector<Index> face;
  for (auto next = of_faces.begin(); next != of_faces.end();) {
    const Index f = next->face;
    for (face.clear(); next != of_faces.end() && next->face == f; ++next) face.push_back(next->vertex);
    graph.faces.add(face);
    for (const Index v : face) areas[v] += face_areas[f] / static_cast<double>(face.size());
  }
  Surroundings s;
  s.neighbours = vertex_neighbours(graph);
  std::vector<double> positive;
  for (const double area : areas) {
    s.spacing.push_back(std::sqrt(area * 2 / std::sqrt(3.0)));
    if (area > 0) positive.push_back(s.spacing.back());
  }
  s.typical_spacing = percentile(positive, 50);
  return s;
}

std::vector<double> ladder(double finest, double most, std::size_t most_rungs) {
  std::vector<double> radii = {finest};
  while (radii.back() < most && radii.size() < most_rungs)
    radii.push_back(finest * std::pow(2.0, 0.5 / kStep * static_cast<double>(radii.size())));
  return radii;
}

/// Points whose scale is chosen together.
struct Points {
  std::vector<Vec3> x;
  Normals u;
  std::vector<double> spacing;
  Adjacency neighbours;

  std::size_t size() const { return x.size(); }
  bool usable(std::size_t i) const { return is_finite(x[i]) && is_finite(u[i]) && !u[i].isZero(0); }
};

/// `at[rung][point]`.
std::vector<std::vector<Rung>> measure_rungs(const BallSum& balls, const Points& points,
                                             const std::vector<double>& radii, BallDefinition ball,
                                             const Execution& run) {
  std::vector<std::vector<Rung>> at(radii.size(), std::vector<Rung>(points.size(), kNone));
  balls.sum(points.x, radii, ball, run, [&](std::size_t q, const BallMeasures* measures) {
    if (!points.usable(q)) return;
    for (std::size_t r = 0; r < radii.size(); ++r) {
      if (measures[r].face_count == 0 || radii[r] < kLeastSpacings * points.spacing[q]) continue;
      const CurvatureRatios ratios = curvature_ratios(measures[r].sum, points.u[q]);
      at[r][q] = {ratios.form[0], ratios.form[1], ratios.form[2], ratios.mean};
    }
  });
  return at;
}

/// The estimate of an order whose smallest ball is on rung `finest`.
Rung candidate(const std::vector<std::vector<Rung>>& at, std::size_t point, int order, std::size_t finest) {
  std::array<CurvatureRatios, kMaxOrder> of_balls;
  for (int b = 0; b < order; ++b) {
    const Rung& rung = at[finest + kStep * static_cast<std::size_t>(order - 1 - b)][point];
    if (std::isnan(rung[0])) return kNone;
    of_balls[static_cast<std::size_t>(b)] = {rung[3], 0, {rung[0], rung[1], rung[2]}, PointStatus::Valid};
  }
  const CurvatureRatios e = extrapolate(of_balls.data(), order).ratios;
  return {e.form[0], e.form[1], e.form[2], e.mean};
}

/// Of each point: how two candidates of one order differ.
struct Changes {
  std::vector<double> square;       ///< of the mean and the principal curvatures, mean of both
  std::vector<double> mean_excess;  ///< of the square change of the mean over that of half the trace
};

/// Replaces every value by the mean of those of its point and of the neighbours, `kPasses` times. NaN stay and do not
/// count.
void average(std::vector<double>& values, const Adjacency& neighbours, const Execution& run) {
  std::vector<double> before;
  for (int pass = 0; pass < kPasses; ++pass) {
    before = values;
    parallel_for(values.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) {
        if (std::isnan(before[i])) continue;
        double sum = before[i];
        int count = 1;
        for (const Index* j = neighbours.begin(i); j != neighbours.end(i); ++j) {
          if (std::isnan(before[*j])) continue;
          sum += before[*j];
          ++count;
        }
        values[i] = sum / count;
      }
    });
  }
}

/// Averaged over the neighbours.
Changes changes(const std::vector<std::vector<Rung>>& at, const Adjacency& neighbours, int order, std::size_t lower,
                std::size_t upper, const Execution& run) {
  const std::size_t n = at.front().size();
  Changes c{std::vector<double>(n), std::vector<double>(n)};
  parallel_for(n, kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Rung a = candidate(at, i, order, lower), b = candidate(at, i, order, upper);
      const double d11 = b[0] - a[0], d12 = b[1] - a[1], d22 = b[2] - a[2], mean = b[3] - a[3];
      const double principal_sq = 0.5 * (d11 * d11 + d22 * d22) + d12 * d12, trace = 0.5 * (d11 + d22);
      c.square[i] = 0.5 * (principal_sq + mean * mean);
      c.mean_excess[i] = mean * mean - trace * trace;
    }
  });
  average(c.square, neighbours, run);
  average(c.mean_excess, neighbours, run);
  return c;
}

/// What was chosen for a point; order 0 if no rung has an estimate.
struct Choice {
  double error_sq = std::numeric_limits<double>::infinity();
  int order = 0;
  std::size_t finest = 0;  ///< rung of the smallest ball
  bool by_trace = false;   ///< mean and gaussian are those of the form

  /// Rung of the largest ball.
  std::size_t rung() const { return finest + kStep * static_cast<std::size_t>(order - 1); }
};

/// Goes up the rungs with all points for one order.
class Climb {
 public:
  Climb(const std::vector<std::vector<Rung>>& at, const Adjacency& neighbours, int order, const Execution& run)
      : at_(at),
        neighbours_(neighbours),
        order_(order),
        run_(run),
        least_(at.front().size()),
        ended_(least_.size(), 0) {
    const auto row = static_cast<std::size_t>(order - 1);
    for (std::size_t finest = 0; finest + kStep * (row + 1) < at.size(); ++finest) {
      const Changes c = changes(at, neighbours, order, finest, finest + kStep, run);
      changes_.push_back(c.square);
      end_where_rungs_disagree(finest, kDisagreement * kNoiseOfChange[row]);
      take(finest, kErrorOfChange[row], c.mean_excess);
    }
  }

  /// The best rung of each point.
  const std::vector<Choice>& least() const { return least_; }

 private:
  void end_where_rungs_disagree(std::size_t finest, double factor) {
    for (std::size_t steps = kNearest; steps <= kFarthest; ++steps) {
      const std::size_t apart = steps * kStep;
      if (finest < kFirstCompared + apart) return;
      const std::vector<double>& lower = changes_[finest - apart];
      const std::vector<double> square = changes(at_, neighbours_, order_, finest - apart, finest, run_).square;
      for (std::size_t i = 0; i < ended_.size(); ++i)
        if (square[i] > factor * (lower[i] + changes_[finest][i])) ended_[i] = 1;
    }
  }

  void take(std::size_t finest, double error_of_change, const std::vector<double>& mean_excess) {
    const double rise = finest < kFineRungs ? kFineRise : kRise;
    for (std::size_t i = 0; i < least_.size(); ++i) {
      const double error_sq = error_of_change * changes_[finest][i];
      if (ended_[i] || std::isnan(error_sq)) continue;
      if (error_sq > rise * least_[i].error_sq) ended_[i] = 1;
      if (error_sq < least_[i].error_sq) least_[i] = {error_sq, order_, finest, mean_excess[i] > 0};
    }
  }

  const std::vector<std::vector<Rung>>& at_;
  const Adjacency& neighbours_;
  int order_;
  const Execution& run_;
  std::vector<Choice> least_;
  std::vector<char> ended_;
  std::vector<std::vector<double>> changes_;  ///< of each rung so far to the next step
};

std::vector<Choice> choose(const std::vector<std::vector<Rung>>& at, const Adjacency& neighbours,
                           const Execution& run) {
  std::vector<Choice> best(at.front().size());
  for (int order = 1; order <= kMaxOrder; ++order) {
    const Climb climb(at, neighbours, order, run);
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (climb.least()[i].error_sq < best[i].error_sq) best[i] = climb.least()[i];
    }
  }
  return best;
}

Points points_of(const MeasuredTriangles& t, const Normals& u, Surroundings around) {
  Points p;
  p.x.assign(t.x.begin(), t.x.begin() + static_cast<std::ptrdiff_t>(t.vertices));
  p.u = u;
  p.spacing = std::move(around.spacing);
  for (double& spacing : p.spacing) {
    if (!(spacing > 0)) spacing = around.typical_spacing;
  }
  p.neighbours = std::move(around.neighbours);
  return p;
}

/// Adds point `seed` of `all` and those nearest to it along edges to `members`, up to kPatch new ones.
void add_patch(const Points& all, Index seed, std::vector<Index>& place, std::vector<Index>& members) {
  const std::size_t end = members.size() + kPatch;
  const auto add = [&](Index i) {
    if (place[i] != kNoIndex || members.size() == end) return;
    place[i] = static_cast<Index>(members.size());
    members.push_back(i);
  };
  std::size_t next = members.size();
  for (add(seed); next < members.size(); ++next) {
    for (const Index* j = all.neighbours.begin(members[next]); j != all.neighbours.end(members[next]); ++j) add(*j);
  }
}

/// Patches all over the points, with the edges among them.
Points pilots_of(const Points& all) {
  std::vector<Index> place(all.size(), kNoIndex), members;
  for (std::size_t seed = 0; seed < all.size(); seed += 1 + all.size() / kPatches)
    add_patch(all, static_cast<Index>(seed), place, members);
  Points pilots;
  for (const Index i : members) {
    pilots.x.push_back(all.x[i]);
    pilots.u.push_back(all.u[i]);
    pilots.spacing.push_back(all.spacing[i]);
    for (const Index* j = all.neighbours.begin(i); j != all.neighbours.end(i); ++j)
      if (place[*j] != kNoIndex) pilots.neighbours.items.push_back(place[*j]);
    pilots.neighbours.offsets.push_back(pilots.neighbours.items.size());
  }
  return pilots;
}

/// Rungs that are worth measuring, from patches of the points; a candidate's change takes one beyond its own.
std::size_t rungs_needed(const BallSum& balls, const Points& all, const std::vector<double>& radii, BallDefinition ball,
                         const Execution& run) {
  const Points pilots = pilots_of(all);
  std::vector<double> rungs;
  for (const Choice& c : choose(measure_rungs(balls, pilots, radii, ball, run), pilots.neighbours, run)) {
    if (c.order > 0) rungs.push_back(static_cast<double>(c.rung()));
  }
  if (rungs.empty()) return radii.size();
  return std::min(radii.size(), static_cast<std::size_t>(percentile(rungs, 98)) + 2 * kStep + 1);
}

/// The samples of the points that share a choice of order and rung.
void measure_group(const BallSum& balls, const Points& points, const std::vector<Index>& group, int order,
                   double radius, BallDefinition ball, const Execution& run, std::vector<CurvatureSample>& samples) {
  std::vector<Vec3> x;
  Normals u;
  for (const Index i : group) {
    x.push_back(points.x[i]);
    u.push_back(points.u[i]);
  }
  CurvatureOptions options;
  options.radii = {radius};
  options.order = order;
  options.ball = ball;
  const CurvatureField field = std::move(estimate_curvatures(balls, x, u, options, run).front());
  for (std::size_t g = 0; g < group.size(); ++g) samples[group[g]] = field.samples[g];
}

void finish(const Choice& choice, CurvatureSample& sample) {
  sample.std_error = kNaN;
  if (sample.k.status != PointStatus::Valid || choice.order == 0) return;
  sample.std_error = std::sqrt(choice.error_sq);
  if (!choice.by_trace) return;
  sample.k.mean = 0.5 * (sample.k.k_min + sample.k.k_max);
  sample.k.gaussian = sample.k.k_min * sample.k.k_max;
}

std::vector<CurvatureSample> measure_choices(const BallSum& balls, const Points& points,
                                             const std::vector<Choice>& choices, const std::vector<double>& radii,
                                             BallDefinition ball, const Execution& run) {
  std::vector<CurvatureSample> samples(points.size());
  // The last group takes those for whom nothing could be chosen: the widest ball, if any, still meets a face.
  const std::size_t groups = kMaxOrder * radii.size();
  std::vector<std::vector<Index>> members(groups + 1);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Choice& c = choices[i];
    const std::size_t group = c.order == 0 ? groups : static_cast<std::size_t>(c.order - 1) * radii.size() + c.rung();
    members[group].push_back(static_cast<Index>(i));
  }
  for (std::size_t g = 0; g <= groups; ++g) {
    if (members[g].empty()) continue;
    const int order = g == groups ? 1 : static_cast<int>(g / radii.size()) + 1;
    const double radius = g == groups ? radii.back() : radii[g % radii.size()];
    const double done = static_cast<double>(g) / static_cast<double>(groups + 1);
    measure_group(balls, points, members[g], order, radius, ball, stage(run, done, done), samples);
  }
  for (std::size_t i = 0; i < choices.size(); ++i) finish(choices[i], samples[i]);
  return samples;
}

}  // namespace

CurvatureField estimate_at_own_scale(const BallSum& balls, const Normals& u, BallDefinition ball,
                                     const Execution& run) {
  const MeasuredTriangles& t = balls.triangles();
  if (u.size() != t.vertices)
    throw Error(ErrorCode::InvalidArgument, std::to_string(u.size()) + " normals for " + std::to_string(t.vertices) +
                                                " vertices: give one a vertex");
  Surroundings around = surroundings(t);
  const double spacing = around.typical_spacing;
  if (!(spacing > 0))
    throw Error(ErrorCode::InvalidData, "no face has an area, so no scale can be chosen; give a radius");
  const Points points = points_of(t, u, std::move(around));
  std::vector<double> radii = ladder(spacing, bounds(points.x).diagonal() / 2, kMostRungs);
  radii.resize(rungs_needed(balls, points, radii, ball, stage(run, 0, 0.1)));
  const auto at = measure_rungs(balls, points, radii, ball, stage(run, 0.1, 0.8));
  const std::vector<Choice> choices = choose(at, points.neighbours, stage(run, 0.8, 0.8));
  return {kNaN, measure_choices(balls, points, choices, radii, ball, stage(run, 0.8, 1)), 0};
}

}  // namespace kappa
