// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "kappa/mesh/ball_sum.hpp"
#include "surfaces.hpp"

// Measures of every face against the bandwidth of the machine: bytes that must be read and written (vertices, normals
// and corners once, one MeasureSum a face) over time, beside a triad of the same run.

namespace {

using namespace kappa;

void triad(benchmark::State& state) {
  constexpr std::size_t kCount = std::size_t{1} << 24;
  std::vector<double> a(kCount), b(kCount, 1.0), c(kCount, 2.0);
  for (auto _ : state) {
    for (std::size_t i = 0; i < kCount; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * 3 * kCount * sizeof(double)));
}

void set_bytes(benchmark::State& state, const MeasuredTriangles& t) {
  const std::size_t bytes = t.x.size() * 2 * sizeof(Vec3) + t.size() * (3 * sizeof(Index) + sizeof(MeasureSum));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}

/// The whole call, with the check of the mesh and the copies of vertices and normals.
void whole_call(benchmark::State& state) {
  const bench::Surface& s = bench::surface("torus");
  for (auto _ : state) benchmark::DoNotOptimize(measure_triangles(s.mesh, s.normals).measures.data());
  set_bytes(state, bench::measured("torus"));
}

/// A plain loop over the faces, corners in the order `order`.
void plain_loop(benchmark::State& state, bool shuffled) {
  const MeasuredTriangles& t = bench::measured("torus");
  std::vector<Index> order(t.size());
  std::iota(order.begin(), order.end(), Index{0});
  if (shuffled) std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  std::vector<MeasureSum> out(t.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto& c = t.corners[order[i]];
      out[i] = compact(triangle_measures({t.x[c[0]], t.x[c[1]], t.x[c[2]]}, {t.u[c[0]], t.u[c[1]], t.u[c[2]]}));
    }
    benchmark::DoNotOptimize(out.data());
  }
  set_bytes(state, t);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("triad", triad)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("measures/measure_triangles", whole_call)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("measures/plain_loop", plain_loop, false)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("measures/plain_loop_shuffled", plain_loop, true)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
