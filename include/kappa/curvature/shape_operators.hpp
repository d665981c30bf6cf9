// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/balls/splitting.hpp"

namespace kappa {

/// Shape operators good enough to refine with, from the curvatures of order 2 of balls of two median edges: first on
/// the faces as they are, then on those split once with what came out. NaN where a ball gives none, and everywhere if
/// no edge has a length. A third time gains nothing, and neither radius nor order matter much: docs/accuracy.md.
/// @throws Error as `triangles_of` does; Cancelled.
ShapeOperators estimate_shape_operators(const Mesh& mesh, const Normals& normals, const Execution& run = {});

/// The triangles of a mesh, each split in 4^levels on a curved patch: `refined_triangles` with the shape operators of
/// `estimate_shape_operators`.
/// @throws Error as `refined_triangles` does; Cancelled.
Triangles refined_triangles(const Mesh& mesh, const Normals& normals, int levels, const Execution& run = {});

/// The triangles of a mesh as a ball sum wants them: refined, or with bilinear quads, or plain.
/// @throws OptionError as `validate(MeasureOptions)` does, Error as the functions above do; Cancelled.
Triangles triangles_of(const Mesh& mesh, const Normals& normals, const MeasureOptions& options,
                       const Execution& run = {});

}  // namespace kappa
