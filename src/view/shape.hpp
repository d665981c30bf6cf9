// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/colour_map.hpp"

namespace kappa::view_detail {

/// A part of the picture that is drawn in one way: in its colour, or, without one, by the scalars of its points.
struct Layer {
  vtkSmartPointer<vtkPolyData> data;
  std::optional<Rgb> colour;
};

enum class ShapeKind { Mesh, Discs, Points };

/// The geometry of a scan, ready to be painted again and again with other values: the triangles of its faces, discs
/// or points. Elements with a corner that is not finite are left out.
class Shape {
 public:
  /// `point_size` as in FigureOptions; `towards` is the direction from the scan to the eye. @throws Cancelled.
  Shape(const Scan& scan, double point_size, const Vec3& towards, const Execution& run);

  ShapeKind kind() const { return kind_; }
  bool has_normals() const { return normals_ != nullptr; }
  std::size_t point_count() const { return finite_points_; }

  /// Two layers: first the elements whose corners all have a value, then the other ones. @throws Cancelled.
  std::vector<Layer> paint(const std::vector<double>& values, const Execution& run) const;
  /// A layer for each label, empty where the label does not occur. A triangle with several labels is divided at the
  /// midpoints of its edges. @throws Cancelled.
  std::vector<Layer> paint(const std::vector<Label>& labels, const Execution& run) const;

 private:
  using Triangle = std::array<Index, 3>;

  void make_mesh(const Scan& scan, const Execution& run);
  void make_discs(const Scan& scan, const Vec3& towards, const Execution& run);
  void make_points(const Scan& scan, const Execution& run);
  vtkSmartPointer<vtkPolyData> empty_part(vtkPoints* points, vtkFloatArray* normals) const;

  ShapeKind kind_ = ShapeKind::Mesh;
  std::size_t finite_points_ = 0;
  vtkNew<vtkPoints> corners_;
  vtkSmartPointer<vtkFloatArray> normals_;  // one a corner, or null
  std::vector<Index> source_;               // point of the scan each corner belongs to
  std::vector<Triangle> triangles_;         // into corners_
  std::vector<Index> dots_;                 // into corners_, for ShapeKind::Points
};

/// The edges of the faces of a scan, each once, as lines. @throws Cancelled.
vtkSmartPointer<vtkPolyData> edge_lines(const Scan& scan, const Execution& run);

/// Short lines along `directions`, spread evenly over the scan: one in each cell of a grid of side `spacing`. The
/// normals of the scan, if it has any, lift the lines off the surface a little. @throws Cancelled.
vtkSmartPointer<vtkPolyData> direction_lines(const Scan& scan, const std::vector<Vec3>& directions, double spacing,
                                             const Execution& run);

}  // namespace kappa::view_detail
