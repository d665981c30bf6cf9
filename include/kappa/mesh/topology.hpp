// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// Lists of indices, one a vertex, stored end to end.
struct Adjacency {
  std::vector<std::size_t> offsets = {0};
  std::vector<Index> items;
  std::size_t size() const { return offsets.size() - 1; }
  const Index* begin(std::size_t i) const { return items.data() + offsets[i]; }
  const Index* end(std::size_t i) const { return items.data() + offsets[i + 1]; }
};

/// The functions below take a mesh that `validate` accepts.

/// Faces around each vertex, in increasing order; a face that has a vertex twice stands twice.
Adjacency faces_of_vertices(const Mesh& mesh);

/// Neighbours of each vertex along edges of faces, in increasing order, each once.
Adjacency vertex_neighbours(const Mesh& mesh);

/// Counts that describe a mesh.
struct Topology {
  std::size_t vertices = 0, faces = 0, edges = 0;
  std::size_t triangles = 0, quads = 0, polygons = 0;  ///< polygons: five corners or more
  std::size_t border_edges = 0;                        ///< in one face
  std::size_t nonmanifold_edges = 0;                   ///< in three faces or more
  std::size_t inconsistent_edges = 0;                  ///< run through twice in the same sense
  std::size_t isolated_vertices = 0;                   ///< in no face
  std::size_t components = 0;                          ///< of the faces, joined by shared vertices
  long euler = 0;                                      ///< vertices in faces - edges + faces
};
Topology topology(const Mesh& mesh);

}  // namespace kappa
