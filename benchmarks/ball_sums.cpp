// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <random>

#include "balls/kernels/views.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "kappa/search/flann_ball_sum.hpp"
#include "kappa/search/neighbours.hpp"
#include "surfaces.hpp"

// Ball sums of the engines, FLANN's search alone, building. Names: task/surface/engine/faces/definition/threads.

namespace {

using namespace kappa;

using Engine = std::unique_ptr<BallSum> (*)(const Triangles&);

std::unique_ptr<BallSum> make_flann(const Triangles& t) {
  return std::make_unique<FlannBallSum>(t);
}
std::unique_ptr<BallSum> make_tree(const Triangles& t) {
  return std::make_unique<MeasureTree>(t);
}
std::unique_ptr<BallSum> make_fast(const Triangles& t) {
  return std::make_unique<MeasureTree>(t, Precision::Fast);
}

const std::map<std::string, Engine> kEngines = {{"flann", make_flann}, {"tree", make_tree}, {"fast", make_fast}};

const BallSum& engine(const std::string& name, const std::string& surface) {
  static std::map<std::string, std::unique_ptr<BallSum>> made;
  std::unique_ptr<BallSum>& slot = made[name + "/" + surface];
  if (!slot) slot = kEngines.at(name)(bench::triangles(surface));
  return *slot;
}

struct Case {
  std::string surface, engine;
  int faces;
  BallDefinition ball = BallDefinition::ExactDensity;
  std::vector<double> factors = {1.0};  ///< radii over the one for `faces`
  int threads = 1;
  enum class Run { Together, OneByOne, RandomOrder } run = Run::Together;
};

/// Enough for a whole run's state of the caches, little enough for FLANN.
std::size_t query_count(int faces) {
  return static_cast<std::size_t>(std::clamp(2e7 / faces, 150.0, 20000.0));
}

void ball_sums(benchmark::State& state, const Case& c) {
  const BallSum& balls = engine(c.engine, c.surface);
  std::vector<Vec3> centres = bench::queries(c.surface, query_count(c.faces));
  if (c.run == Case::Run::RandomOrder) std::shuffle(centres.begin(), centres.end(), std::mt19937_64(1));
  std::vector<double> radii;
  for (const double f : c.factors) radii.push_back(f * bench::radius_for(c.surface, c.faces));
  Execution run;
  run.threads = c.threads;
  std::vector<double> sums(centres.size());
  std::vector<Index> met(centres.size());
  std::vector<std::vector<double>> runs = {radii};
  if (c.run == Case::Run::OneByOne) {
    runs.clear();
    for (const double r : radii) runs.push_back({r});
  }
  for (auto _ : state) {
    for (const std::vector<double>& of_run : runs) {
      balls.sum(centres, of_run, c.ball, run, [&](std::size_t q, const BallMeasures* m) {
        sums[q] = m[0].sum.mu0;
        met[q] = m[0].face_count;
      });
    }
    benchmark::DoNotOptimize(sums.data());
  }
  double faces = 0;
  for (const Index m : met) faces += m;
  state.counters["faces"] = faces / static_cast<double>(centres.size());
  state.counters["us"] =
      benchmark::Counter(1e-6 * static_cast<double>(centres.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void search_alone(benchmark::State& state, const std::string& surface, int faces) {
  static std::map<std::string, std::unique_ptr<NeighbourSearch>> made;
  std::unique_ptr<NeighbourSearch>& search = made[surface];
  if (!search) {
    const Triangles& t = bench::triangles(surface);
    std::vector<Vec3> centroids;
    for (const auto& c : t.corners) centroids.push_back((t.x[c[0]] + t.x[c[1]] + t.x[c[2]]) / 3);
    search = std::make_unique<NeighbourSearch>(centroids);
  }
  const std::vector<Vec3> centres = bench::queries(surface, query_count(faces));
  const double radius = bench::radius_for(surface, faces);
  std::vector<Index> found;
  std::vector<double> distances_sq;
  for (auto _ : state) {
    for (const Vec3& centre : centres) {
      search->within(centre, radius, found, distances_sq);
      benchmark::DoNotOptimize(found.data());
    }
  }
  state.counters["us"] =
      benchmark::Counter(1e-6 * static_cast<double>(centres.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void build(benchmark::State& state, const std::string& name) {
  const Triangles& t = bench::triangles("torus");
  Execution one;  // as FLANN has
  one.threads = 1;
  for (auto _ : state) {
    state.PauseTiming();
    Triangles copy = t;
    state.ResumeTiming();
    std::unique_ptr<BallSum> balls;
    if (name == "flann") balls = std::make_unique<FlannBallSum>(std::move(copy));
    if (name == "tree") balls = std::make_unique<MeasureTree>(std::move(copy), Precision::Double, one);
    if (name == "fast") balls = std::make_unique<MeasureTree>(std::move(copy), Precision::Fast, one);
    benchmark::DoNotOptimize(balls.get());
    state.PauseTiming();
    if (const auto* tree = dynamic_cast<const MeasureTree*>(balls.get()))
      state.counters["bytes_per_triangle"] = static_cast<double>(tree->bytes()) / static_cast<double>(t.size());
    balls.reset();
    state.ResumeTiming();
  }
}

void add(const Case& c, const std::string& task) {
  const std::string definition = c.ball == BallDefinition::ExactDensity ? "exact" : "fraction";
  const std::string name = task + "/" + c.surface + "/" + c.engine + "/" + std::to_string(c.faces) + "/" + definition +
                           "/" + std::to_string(c.threads);
  auto* b = benchmark::RegisterBenchmark(name.c_str(), [c](benchmark::State& state) { ball_sums(state, c); });
  b->Unit(benchmark::kMillisecond);
  if (c.threads > 1) b->UseRealTime();
}

void add_all() {
  for (const std::string surface : {"torus", "terrain"}) {
    for (const int faces : {20, 200, 2000, 20000, 200000}) {
      benchmark::RegisterBenchmark(("search/" + surface + "/flann/" + std::to_string(faces)).c_str(),
                                   [=](benchmark::State& state) { search_alone(state, surface, faces); })
          ->Unit(benchmark::kMillisecond);
      for (const std::string engine : {"flann", "tree", "fast"}) {
        add({surface, engine, faces}, "sum");
        add({surface, engine, faces, BallDefinition::AreaFraction}, "sum");
      }
    }
  }
  const std::vector<double> five = {1.0, std::sqrt(0.5), 0.5, std::sqrt(0.125), 0.25};
  for (const int faces : {20, 200, 2000, 20000}) {
    for (const std::string engine : {"flann", "tree", "fast"}) {
      for (const std::string surface : {"huge", "pareto", "shuffled"}) add({surface, engine, faces}, "sum");
      Case c{"torus", engine, faces};
      c.run = Case::Run::RandomOrder;
      add(c, "random");
      c.factors = five;
      c.run = Case::Run::Together;
      add(c, "five");
      c.run = Case::Run::OneByOne;
      add(c, "one_by_one");
    }
  }
  for (const int threads : {1, 2}) {
    Case c{"torus", "tree", 2000};
    c.threads = threads;
    add(c, "threads");
  }
  for (const std::string engine : {"flann", "tree", "fast"})
    benchmark::RegisterBenchmark(("build/torus/" + engine).c_str(), [=](benchmark::State& state) {
      build(state, engine);
    })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  add_all();
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("kernels", kernels::best_table().name);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
