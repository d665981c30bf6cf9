// SPDX-License-Identifier: BSD-3-Clause
#include "shape.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkTriangleFilter.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "discs.hpp"
#include "kappa/scan/scan.hpp"
#include "steps.hpp"

namespace kappa::view_detail {
namespace {

constexpr std::size_t kMostDiscs = 300000;  // beyond, a point is about a pixel anyway and memory counts
constexpr int kDiscSides = 6;
// The middle of a disc is raised, so that where discs overlap each point shows around its own position.
constexpr double kDiscRise = 0.15;

void append(vtkCellArray* cells, std::initializer_list<vtkIdType> corners) {
  cells->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.begin());
}

bool all_finite(const Faces::View& face, const std::vector<Vec3>& points) {
  return std::all_of(face.begin(), face.end(), [&](Index i) { return i < points.size() && is_finite(points[i]); });
}

/// Triangles of the faces with finite corners; VTK divides polygons, concave ones too.
std::vector<std::array<Index, 3>> triangles_of(const Scan& scan, vtkPoints* corners, const Execution& run) {
  vtkNew<vtkCellArray> polygons;
  std::vector<vtkIdType> ids;
  each(scan.faces.size(), stage(run, 0.0, 0.3), [&](std::size_t f) {
    const Faces::View face = scan.faces[f];
    if (!all_finite(face, scan.points)) return;
    ids.assign(face.begin(), face.end());
    polygons->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
  });
  vtkNew<vtkPolyData> data;
  data->SetPoints(corners);
  data->SetPolys(polygons);
  vtkNew<vtkTriangleFilter> divide;
  divide->SetInputData(data);
  divide->PassVertsOff();
  divide->PassLinesOff();
  update(divide, stage(run, 0.3, 0.8));
  std::vector<std::array<Index, 3>> triangles;
  vtkCellArray* cells = divide->GetOutput()->GetPolys();
  triangles.reserve(static_cast<std::size_t>(cells->GetNumberOfCells()));
  vtkIdType count = 0;
  const vtkIdType* cell = nullptr;
  cells->InitTraversal();
  each(triangles.capacity(), stage(run, 0.8, 1.0), [&](std::size_t) {
    if (cells->GetNextCell(count, cell) == 0) return;
    triangles.push_back({static_cast<Index>(cell[0]), static_cast<Index>(cell[1]), static_cast<Index>(cell[2])});
  });
  return triangles;
}

/// Normals for the light: those of the scan, else the area-weighted ones of the triangles.
Normals light_normals(const Scan& scan, const std::vector<std::array<Index, 3>>& triangles) {
  Normals sums(scan.points.size(), Vec3::Zero());
  for (const auto& t : triangles) {
    const Vec3 n = (scan.points[t[1]] - scan.points[t[0]]).cross(scan.points[t[2]] - scan.points[t[0]]);
    for (const Index i : t) sums[i] += n;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const bool given = i < scan.normals.size() && is_finite(scan.normals[i]) && scan.normals[i].norm() > 0;
    if (given) sums[i] = scan.normals[i];
    sums[i] = sums[i].norm() > 0 ? Vec3(sums[i].normalized()) : Vec3::UnitZ();
  }
  return sums;
}

vtkSmartPointer<vtkFloatArray> normal_array() {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  return array;
}

/// Adds corners on a copy of a shape's points, for the parts of divided triangles.
struct Divider {
  vtkNew<vtkPoints> points;
  vtkSmartPointer<vtkFloatArray> normals;

  Divider(vtkPoints* corners, vtkFloatArray* corner_normals) {
    points->DeepCopy(corners);
    if (corner_normals == nullptr) return;
    normals = normal_array();
    normals->DeepCopy(corner_normals);
  }

  vtkIdType mean_of(std::initializer_list<vtkIdType> corners) {
    Vec3 x = Vec3::Zero(), n = Vec3::Zero();
    for (const vtkIdType corner : corners) {
      Vec3 v;
      points->GetPoint(corner, v.data());
      x += v;
      if (normals != nullptr) normals->GetTuple(corner, v.data());
      n += v;
    }
    x /= static_cast<double>(corners.size());
    if (normals != nullptr) normals->InsertNextTuple(n.norm() > 0 ? n.normalized().eval().data() : n.data());
    return points->InsertNextPoint(x.data());
  }
};

}  // namespace

Shape::Shape(const Scan& scan, double point_size, const Vec3& towards, const Execution& run) {
  finite_points_ = static_cast<std::size_t>(std::count_if(scan.points.begin(), scan.points.end(), is_finite));
  if (scan.is_mesh()) {
    make_mesh(scan, run);
  } else if (point_size <= 0 && finite_points_ <= kMostDiscs) {
    make_discs(scan, towards, run);
  } else {
    make_points(scan, run);
  }
}

void Shape::make_mesh(const Scan& scan, const Execution& run) {
  kind_ = ShapeKind::Mesh;
  each(scan.points.size(), stage(run, 0.0, 0.2), [&](std::size_t i) {
    const Vec3& x = scan.points[i];
    corners_->InsertNextPoint(is_finite(x) ? x.data() : Vec3::Zero().eval().data());
    source_.push_back(static_cast<Index>(i));
  });
  triangles_ = triangles_of(scan, corners_, stage(run, 0.2, 0.8));
  const Normals normals = light_normals(scan, triangles_);
  normals_ = normal_array();
  each(normals.size(), stage(run, 0.8, 1.0), [&](std::size_t i) { normals_->InsertNextTuple(normals[i].data()); });
}

void Shape::make_discs(const Scan& scan, const Vec3& towards, const Execution& run) {
  kind_ = ShapeKind::Discs;
  normals_ = normal_array();
  const std::vector<Disc> discs = view_detail::make_discs(scan.points, scan.normals, towards, stage(run, 0.0, 0.7));
  each(discs.size(), stage(run, 0.7, 1.0), [&](std::size_t d) {
    const Disc& disc = discs[d];
    const Vec3& x = scan.points[disc.point];
    const Vec3 s = disc.radius * disc.normal.unitOrthogonal();
    const Vec3 t = disc.normal.cross(s);
    const auto centre =
        static_cast<Index>(corners_->InsertNextPoint((x + kDiscRise * disc.radius * disc.normal).eval().data()));
    for (int i = 0; i < kDiscSides; ++i) {
      const double angle = 2 * kPi * i / kDiscSides;
      corners_->InsertNextPoint((x + std::cos(angle) * s + std::sin(angle) * t).eval().data());
      triangles_.push_back(
          {centre, centre + 1 + static_cast<Index>(i), centre + 1 + static_cast<Index>((i + 1) % kDiscSides)});
    }
    for (int i = 0; i <= kDiscSides; ++i) {
      normals_->InsertNextTuple(disc.normal.data());
      source_.push_back(disc.point);
    }
  });
}

void Shape::make_points(const Scan& scan, const Execution& run) {
  kind_ = ShapeKind::Points;
  if (scan.normals.size() == scan.points.size()) normals_ = normal_array();
  each(scan.points.size(), run, [&](std::size_t i) {
    if (!is_finite(scan.points[i])) return;
    dots_.push_back(static_cast<Index>(corners_->InsertNextPoint(scan.points[i].data())));
    source_.push_back(static_cast<Index>(i));
    if (normals_ == nullptr) return;
    const Vec3& n = scan.normals[i];
    normals_->InsertNextTuple(is_finite(n) && n.norm() > 0 ? n.normalized().eval().data()
                                                           : Vec3::UnitZ().eval().data());
  });
}

vtkSmartPointer<vtkPolyData> Shape::empty_part(vtkPoints* points, vtkFloatArray* normals) const {
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(points);
  part->SetPolys(vtkNew<vtkCellArray>());
  part->SetVerts(vtkNew<vtkCellArray>());
  if (normals != nullptr) part->GetPointData()->SetNormals(normals);
  return part;
}

std::vector<Layer> Shape::paint(const std::vector<double>& values, const Execution& run) const {
  const auto has_value = [&](Index corner) { return std::isfinite(values[source_[corner]]); };
  Layer with{empty_part(corners_, normals_), {}};
  Layer without{empty_part(corners_, normals_), kNoValueColour};
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfValues(static_cast<vtkIdType>(source_.size()));
  each(source_.size(), stage(run, 0.0, 0.3), [&](std::size_t i) {
    const double value = values[source_[i]];
    scalars->SetValue(static_cast<vtkIdType>(i), std::isfinite(value) ? value : 0.0);
  });
  with.data->GetPointData()->SetScalars(scalars);
  each(triangles_.size(), stage(run, 0.3, 0.9), [&](std::size_t i) {
    const Triangle& t = triangles_[i];
    const bool all = has_value(t[0]) && has_value(t[1]) && has_value(t[2]);
    append((all ? with : without).data->GetPolys(), {t[0], t[1], t[2]});
  });
  each(dots_.size(), stage(run, 0.9, 1.0),
       [&](std::size_t i) { append((has_value(dots_[i]) ? with : without).data->GetVerts(), {dots_[i]}); });
  return {with, without};
}

std::vector<Layer> Shape::paint(const std::vector<Label>& labels, const Execution& run) const {
  Divider divider(corners_, normals_);
  std::vector<Layer> layers;
  for (int i = 0; i < kLabelCount; ++i) {
    layers.push_back({empty_part(divider.points, divider.normals), label_colour(static_cast<Label>(i))});
  }
  const auto layer_of = [&](Index corner) { return static_cast<std::size_t>(labels[source_[corner]]); };
  each(triangles_.size(), stage(run, 0.0, 0.9), [&](std::size_t triangle) {
    const Triangle& t = triangles_[triangle];
    if (layer_of(t[0]) == layer_of(t[1]) && layer_of(t[1]) == layer_of(t[2])) {
      append(layers[layer_of(t[0])].data->GetPolys(), {t[0], t[1], t[2]});
      return;
    }
    const vtkIdType m[3] = {divider.mean_of({t[0], t[1]}), divider.mean_of({t[1], t[2]}),
                            divider.mean_of({t[2], t[0]})};
    const vtkIdType centre = divider.mean_of({t[0], t[1], t[2]});
    for (std::size_t i = 0; i < 3; ++i) {
      append(layers[layer_of(t[i])].data->GetPolys(), {t[i], m[i], centre, m[(i + 2) % 3]});
    }
  });
  each(dots_.size(), stage(run, 0.9, 1.0),
       [&](std::size_t i) { append(layers[layer_of(dots_[i])].data->GetVerts(), {dots_[i]}); });
  return layers;
}

}  // namespace kappa::view_detail
