// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// What a face that the sphere cuts adds to its ball.
enum class BallDefinition {
  ExactDensity,  ///< integral of the density over the part inside: subdividing a face changes nothing
  AreaFraction   ///< measures of the face times the share of its area inside (Property 2 of the paper)
};

/// How a face of four corners is measured.
enum class QuadMeasures {
  Split,    ///< in four triangles at its barycentre, as any other polygon
  Bilinear  ///< as a bilinear patch (Appendix B)
};

/// The faces of a surface as triangles with their measures: what every ball sum works on.
///
/// A polygon of four corners or more is split at its barycentre. Faces with a corner whose position
/// or normal is not finite, or whose normal is zero, are left out and counted.
struct MeasuredTriangles {
  std::vector<Vec3> x;  ///< vertices of the mesh, then the barycentres
  Normals u;            ///< normals there
  /// Of a polygon split at its barycentre: two neighbouring vertices and the barycentre. Where a face has several
  /// parts, each of its vertices is the first corner of one of them.
  std::vector<std::array<Index, 3>> corners;
  std::vector<double> weights;       ///< of each triangle, empty for all 1
  std::vector<MeasureSum> measures;  ///< of each whole triangle, times its weight; if empty, see measures_of()
  /// What the measures have beside the integral of the density over the triangle, as those of the parts of bilinear
  /// quads do; empty if nothing.
  std::vector<MeasureSum> beside;
  std::vector<Index> faces;  ///< face of the mesh that each triangle is of, increasing
  std::size_t vertices = 0;  ///< of the mesh; x[i] with i >= vertices is a barycentre
  std::size_t dropped_faces = 0;

  std::size_t size() const { return corners.size(); }
  double weight(std::size_t triangle) const { return weights.empty() ? 1.0 : weights[triangle]; }
};

/// @throws Error InvalidData if the mesh is not valid, or InvalidArgument if normals.size() is not #V.
MeasuredTriangles measure_triangles(const Mesh& mesh, const Normals& normals, QuadMeasures quads = QuadMeasures::Split,
                                    const Execution& run = {});

/// The same for MeasureTree: without measures that follow from the rest, which the tree makes when it has the triangles
/// in its order. With bilinear quads they do not, and are there.
/// @throws as measure_triangles()
MeasuredTriangles triangles_for_tree(const Mesh& mesh, const Normals& normals, QuadMeasures quads = QuadMeasures::Split,
                                     const Execution& run = {});

/// Measures of whole triangle `t`, times its weight: the stored ones if there are any, else computed.
MeasureSum measures_of(const MeasuredTriangles& triangles, std::size_t t);

/// Number of parts of every face of the mesh up to the last one that has any. The triangles may stand in any order.
std::vector<Index> parts_of_faces(const MeasuredTriangles& triangles);

/// Measures of a ball, with the number of triangles (parts of polygons count singly) it meets.
struct BallMeasures {
  MeasureSum sum;
  Index face_count = 0;
};

/// Measures of triangle `t`'s part in the closed ball; adds nothing and returns false if they do not meet.
bool add_triangle_in_ball(const MeasuredTriangles& triangles, std::size_t t, const Vec3& centre, double radius,
                          BallDefinition ball, BallMeasures& to);

/// Sums the measures of triangles in balls. Engines differ in speed alone: their sums agree to
/// 1e-11 of the sum of absolute values.
class BallSum {
 public:
  virtual ~BallSum() = default;

  /// Receives the measures of the balls around centre `query`, one a radius in the order given.
  /// Called from any thread, once a query.
  using Sink = std::function<void(std::size_t query, const BallMeasures* per_radius)>;

  /// Measures of the closed balls of every radius around every centre (in the local coordinates of
  /// the triangles). A centre that is not finite gets empty balls.
  /// @throws Error InvalidArgument if a radius is not finite and positive.
  void sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
           const Execution& run, const Sink& sink) const;

  virtual const MeasuredTriangles& triangles() const = 0;

 private:
  virtual void do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
                      const Execution& run, const Sink& sink) const = 0;
};

/// Every triangle for every ball: the slow reference that the tests compare with.
class BruteForceBallSum final : public BallSum {
 public:
  explicit BruteForceBallSum(MeasuredTriangles triangles) : triangles_(std::move(triangles)) {}
  const MeasuredTriangles& triangles() const override { return triangles_; }

 private:
  void do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
              const Execution& run, const Sink& sink) const override;
  MeasuredTriangles triangles_;
};

/// Indices of `points` along a space-filling (Morton) curve; points that are not finite come last.
std::vector<Index> spatial_order(const std::vector<Vec3>& points, const Execution& run = {});

}  // namespace kappa
