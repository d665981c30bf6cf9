// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCellArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "kappa/scan/scan.hpp"
#include "shape.hpp"

namespace kappa::view_detail {
namespace {

constexpr double kLineLength = 0.8;  // of the spacing
constexpr double kLift = 0.05;       // of the spacing, off the surface

void add_line(vtkPolyData* data, const Vec3& a, const Vec3& b) {
  const vtkIdType ends[2] = {data->GetPoints()->InsertNextPoint(a.data()),
                             data->GetPoints()->InsertNextPoint(b.data())};
  data->GetLines()->InsertNextCell(2, ends);
}

vtkSmartPointer<vtkPolyData> no_lines() {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtkNew<vtkPoints>());
  data->SetLines(vtkNew<vtkCellArray>());
  return data;
}

/// Normal to lift a line by: zero where there is none.
Vec3 lift_of(const Scan& scan, std::size_t point) {
  if (point >= scan.normals.size() || !is_finite(scan.normals[point])) return Vec3::Zero();
  return scan.normals[point].normalized();
}

}  // namespace

vtkSmartPointer<vtkPolyData> edge_lines(const Scan& scan) {
  std::vector<std::pair<Index, Index>> edges;
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    const Faces::View face = scan.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index a = face[i], b = face[(i + 1) % face.size()];
      if (is_finite(scan.points[a]) && is_finite(scan.points[b])) edges.push_back(std::minmax(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  auto data = no_lines();
  for (const auto& edge : edges) add_line(data, scan.points[edge.first], scan.points[edge.second]);
  return data;
}

vtkSmartPointer<vtkPolyData> direction_lines(const Scan& scan, const std::vector<Vec3>& directions, double spacing) {
  auto data = no_lines();
  std::set<std::array<std::int64_t, 3>> taken;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3& x = scan.points[i];
    if (!is_finite(x) || !is_finite(directions[i])) continue;
    const Vec3 cell = (x / spacing).array().floor();
    const std::array<std::int64_t, 3> key = {std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())};
    if (!taken.insert(key).second) continue;
    const Vec3 half = 0.5 * kLineLength * spacing * directions[i].normalized();
    const Vec3 lifted = x + kLift * spacing * lift_of(scan, i);
    add_line(data, lifted - half, lifted + half);
  }
  return data;
}

}  // namespace kappa::view_detail
