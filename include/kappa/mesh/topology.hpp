// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// A list of indices for each vertex. The list of vertex i is [begin(i), end(i)).
struct Adjacency {
  std::vector<std::size_t> offsets = {0};  ///< where each list begins in `items`, and the number of items at the end
  std::vector<Index> items;                ///< the lists, one after the other
  /// The number of lists.
  std::size_t size() const { return offsets.size() - 1; }
  const Index* begin(std::size_t i) const { return items.data() + offsets[i]; }
  const Index* end(std::size_t i) const { return items.data() + offsets[i + 1]; }
};

// The functions below take a mesh that `validate` accepts; this is not checked.

/// The faces around each vertex, in increasing order. A face that has a vertex twice stands twice in its list.
/// @throws Cancelled. Cost: linear.
Adjacency faces_of_vertices(const Mesh& mesh, const Execution& run = {});

/// The neighbours of each vertex along the edges of faces, in increasing order, each once.
/// @throws Cancelled, and Error as `thread_count` does. Cost: linear, 8 bytes an edge of a face while it works.
Adjacency vertex_neighbours(const Mesh& mesh, const Execution& run = {});

/// Counts that describe a mesh. An edge joins two different vertices that follow each other in a face, and counts once
/// however many faces have it.
struct Topology {
  std::size_t vertices = 0, faces = 0, edges = 0;
  std::size_t triangles = 0, quads = 0;
  std::size_t polygons = 0;            ///< faces of five corners or more
  std::size_t border_edges = 0;        ///< edges of one face
  std::size_t nonmanifold_edges = 0;   ///< edges of three faces or more
  std::size_t inconsistent_edges = 0;  ///< edges of two faces that both run through them in the same sense
  std::size_t isolated_vertices = 0;   ///< vertices of no face
  std::size_t components = 0;          ///< parts of the surface; faces that share a vertex belong to one part
  long euler = 0;                      ///< the Euler number: vertices of faces - edges + faces
};

/// The counts of a mesh.
/// @throws Cancelled, and Error as `thread_count` does. Cost: linear, 8 bytes an edge of a face while it works.
Topology topology(const Mesh& mesh, const Execution& run = {});

}  // namespace kappa
