// SPDX-License-Identifier: BSD-3-Clause
#include "support/cancelling.hpp"

#include "kappa/mesh/normals.hpp"
#include "kappa/mesh/topology.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

TEST(MeshCancel, InWhicheverReport) {
  const shapes::Shape torus = shapes::torus(3, 1, 12, 8);
  Mesh weighted = torus.mesh;
  weighted.weights.assign(weighted.faces.size(), 0.5);
  const Mesh& mesh = torus.mesh;
  const Normals& u = torus.normals;
  test::expect_cancellable({
      {"validate", [&](const Execution& run) { validate(mesh, run); }},
      {"validate with weights", [&](const Execution& run) { validate(weighted, run); }},
      {"median_edge_length", [&](const Execution& run) { median_edge_length(mesh, run); }},
      {"faces_of_vertices", [&](const Execution& run) { faces_of_vertices(mesh, run); }},
      {"vertex_neighbours", [&](const Execution& run) { vertex_neighbours(mesh, run); }},
      {"topology", [&](const Execution& run) { topology(mesh, run); }},
      {"vertex_normals", [&](const Execution& run) { vertex_normals(mesh, NormalWeights::Max, run); }},
      {"average_normals", [&](const Execution& run) { average_normals(mesh, u, 2, run); }},
      {"average_normals in no pass", [&](const Execution& run) { average_normals(mesh, u, 0, run); }},
      {"normalised", [&](const Execution& run) { normalised(u, run); }},
      {"flipped", [&](const Execution& run) { flipped(u, run); }},
  });
}

}  // namespace
}  // namespace kappa
