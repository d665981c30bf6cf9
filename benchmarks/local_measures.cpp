// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <string>

#include "balls/whole_measures.hpp"
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

void set_bytes(benchmark::State& state, const Triangles& t) {
  const std::size_t bytes = t.x.size() * 2 * sizeof(Vec3) + t.size() * (3 * sizeof(Index) + sizeof(MeasureSum));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}

/// The whole call, with the check of the mesh and the copies of vertices and normals.
void whole_call(benchmark::State& state, const std::string& surface) {
  const bench::Surface& s = bench::surface(surface);
  for (auto _ : state) benchmark::DoNotOptimize(measure_triangles(triangles_of(s.mesh, s.normals)).data());
  set_bytes(state, bench::triangles(surface));
}

/// The pass over the faces alone.
void pass(benchmark::State& state) {
  const Triangles& t = bench::triangles("torus");
  const kernels::TriangleView view = view_of(t, {});
  const kernels::Table& table = kernels::best_table();
  std::vector<MeasureSum> out(t.size());
  for (auto _ : state) {
    table.measure(view, 0, t.size(), &out[0].area);
    benchmark::DoNotOptimize(out.data());
  }
  set_bytes(state, t);
}

/// A plain scalar loop over the faces.
void plain_loop(benchmark::State& state) {
  const Triangles& t = bench::triangles("torus");
  std::vector<MeasureSum> out(t.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto& c = t.corners[i];
      out[i] = compact(triangle_measures({t.x[c[0]], t.x[c[1]], t.x[c[2]]}, {t.u[c[0]], t.u[c[1]], t.u[c[2]]}));
    }
    benchmark::DoNotOptimize(out.data());
  }
  set_bytes(state, t);
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const char* name, auto function, auto... arguments) {
    benchmark::RegisterBenchmark(name, function, arguments...)->Unit(benchmark::kMillisecond);
  };
  add("triad", triad);
  add("measures/pass", pass);
  add("measures/plain_loop", plain_loop);
  add("measures/measure_triangles", whole_call, std::string("torus"));
  add("measures/measure_triangles_shuffled", whole_call, std::string("shuffled"));
  benchmark::Initialize(&argc, argv);
  benchmark::AddCustomContext("kernels", kernels::best_table().name);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
