// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>

#include <cstdio>
#include <cstring>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/in_balls.hpp"
#include "surfaces.hpp"

// whole_run double|fast: curvatures at all vertices of the torus in one process, and the peak of its memory in MiB as
// JSON.

int main(int argc, char** argv) {
  using namespace kappa;
  const auto is = [&](const char* name) { return argc == 2 && std::strcmp(argv[1], name) == 0; };
  if (!is("double") && !is("fast")) return 2;
  const bench::Surface& s = bench::surface("torus");
  const MeasureTree tree(triangles_of(s.mesh, s.normals), is("fast") ? Precision::Fast : Precision::Double);
  const auto fields = curvatures_in_balls(tree, s.mesh.vertices, s.normals, {{bench::radius_for("torus", 200)}});
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  std::printf("{\"peak_mib\": %.1f, \"cpu_s\": %.2f, \"points\": %zu, \"tree_bytes_a_triangle\": %.1f}\n",
              static_cast<double>(usage.ru_maxrss) / 1024,
              static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                  1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
              fields[0].samples.size(),
              static_cast<double>(tree.bytes()) / static_cast<double>(tree.triangles().size()));
  return 0;
}
