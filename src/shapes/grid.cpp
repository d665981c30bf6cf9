// SPDX-License-Identifier: BSD-3-Clause
#include "grid.hpp"

namespace kappa::detail {
namespace {

void add_quad(Faces& faces, const Index (&q)[4], GridFaces kind) {
  if (kind == GridFaces::Quads) {
    faces.add(q, 4);
  } else if (kind == GridFaces::Triangles) {
    faces.add(q[0], q[1], q[2]);
    faces.add(q[0], q[2], q[3]);
  } else {
    faces.add(q[0], q[1], q[3]);
    faces.add(q[1], q[2], q[3]);
  }
}

}  // namespace

void add_grid_faces(Faces& faces, const QuadGrid& grid, GridFaces kind) {
  const Index quads_u = grid.closed_u ? grid.columns : grid.columns - 1;
  const Index quads_v = grid.closed_v ? grid.rows : grid.rows - 1;
  for (Index v = 0; v < quads_v; ++v) {
    const Index low = grid.first + v * grid.columns;
    const Index high = grid.first + (v + 1) % grid.rows * grid.columns;
    for (Index u = 0; u < quads_u; ++u) {
      const Index next = (u + 1) % grid.columns;
      add_quad(faces, {low + u, low + next, high + next, high + u}, kind);
    }
  }
}

}  // namespace kappa::detail
