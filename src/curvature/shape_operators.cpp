// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/curvature/shape_operators.hpp"

#include <utility>

#include "kappa/balls/measure_tree.hpp"
#include "kappa/curvature/in_balls.hpp"

namespace kappa {
namespace {

/// Of the balls that shape operators are measured in: order 2 is as good as 3 there, and needs fewer of them.
constexpr double kShapeRadius = 2;  ///< median edges
constexpr int kShapeOrder = 2;

Mat3 shape_of(const Curvatures& k) {
  if (k.status != PointStatus::Valid) return Mat3::Constant(kNaN);
  return k.k_min * k.dir_min * k.dir_min.transpose() + k.k_max * k.dir_max * k.dir_max.transpose();
}

/// Shape operators at the vertices of the mesh that the triangles were made of.
ShapeOperators measured_shapes(Triangles triangles, const Normals& normals, double radius, const Execution& run) {
  const MeasureTree balls(std::move(triangles), Precision::Double, stage(run, 0.0, 0.1));
  const BallPlan plan{{radius}, kShapeOrder, BallDefinition::ExactDensity};
  const auto fields = curvatures_in_balls(balls, vertices_of(balls.triangles()), normals, plan, stage(run, 0.1, 1.0));
  ShapeOperators shapes;
  shapes.reserve(normals.size());
  for (const CurvatureSample& s : fields.front().samples) shapes.push_back(shape_of(s.k));
  return shapes;
}

}  // namespace

ShapeOperators estimate_shape_operators(const Mesh& mesh, const Normals& normals, const Execution& run) {
  Triangles coarse = triangles_of(mesh, normals, QuadMeasures::Split, stage(run, 0, 0.1));
  const double radius = kShapeRadius * median_edge_length(mesh);
  if (!(radius > 0)) return ShapeOperators(normals.size(), Mat3::Constant(kNaN));
  const ShapeOperators shapes = measured_shapes(std::move(coarse), normals, radius, stage(run, 0.1, 0.3));
  return measured_shapes(refined_triangles(mesh, normals, shapes, 1, stage(run, 0.3, 0.5)), normals, radius,
                         stage(run, 0.5, 1));
}

Triangles refined_triangles(const Mesh& mesh, const Normals& normals, int levels, const Execution& run) {
  check_refinement(levels, mesh.faces.corners().size());
  if (levels == 0) return triangles_of(mesh, normals, QuadMeasures::Split, run);
  const ShapeOperators shapes = estimate_shape_operators(mesh, normals, stage(run, 0, 0.6));
  return refined_triangles(mesh, normals, shapes, levels, stage(run, 0.6, 1));
}

Triangles triangles_of(const Mesh& mesh, const Normals& normals, const MeasureOptions& options, const Execution& run) {
  validate(options);
  if (options.refine > 0) return refined_triangles(mesh, normals, options.refine, run);
  return triangles_of(mesh, normals, options.quads, run);
}

}  // namespace kappa
