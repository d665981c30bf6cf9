// SPDX-License-Identifier: BSD-3-Clause
#include <vtkCellArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "kappa/scan/scan.hpp"
#include "shape.hpp"
#include "steps.hpp"

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

/// Calls `visit(a, b)`, a <= b, for each edge of each face with finite ends.
template <class Visit>
void for_each_edge(const Scan& scan, const Execution& run, Visit&& visit) {
  each(scan.faces.size(), run, [&](std::size_t f) {
    const Faces::View face = scan.faces[f];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index a = face[i], b = face[(i + 1) % face.size()];
      if (is_finite(scan.points[a]) && is_finite(scan.points[b])) visit(std::min(a, b), std::max(a, b));
    }
  });
}

/// Normal to lift a line by: zero where there is none.
Vec3 lift_of(const Scan& scan, std::size_t point) {
  if (point >= scan.normals.size() || !is_finite(scan.normals[point])) return Vec3::Zero();
  return scan.normals[point].normalized();
}

}  // namespace

vtkSmartPointer<vtkPolyData> edge_lines(const Scan& scan, const Execution& run) {
  // For each point its neighbours of larger index, one after the other: sorting them point by point can be cancelled.
  std::vector<std::size_t> ends(scan.points.size() + 1, 0);
  for_each_edge(scan, stage(run, 0.0, 0.2), [&](Index a, Index) { ++ends[a + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Index> neighbours(ends.back());
  std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
  for_each_edge(scan, stage(run, 0.2, 0.5), [&](Index a, Index b) { neighbours[next[a]++] = b; });
  auto data = no_lines();
  each(scan.points.size(), stage(run, 0.5, 1.0), [&](std::size_t a) {
    const auto first = neighbours.begin() + static_cast<std::ptrdiff_t>(ends[a]);
    const auto last = neighbours.begin() + static_cast<std::ptrdiff_t>(ends[a + 1]);
    std::sort(first, last);
    std::for_each(first, std::unique(first, last), [&](Index b) { add_line(data, scan.points[a], scan.points[b]); });
  });
  return data;
}

vtkSmartPointer<vtkPolyData> direction_lines(const Scan& scan, const std::vector<Vec3>& directions, double spacing,
                                             const Execution& run) {
  auto data = no_lines();
  std::set<std::array<std::int64_t, 3>> taken;
  each(scan.points.size(), run, [&](std::size_t i) {
    const Vec3& x = scan.points[i];
    if (!is_finite(x) || !is_finite(directions[i])) return;
    const Vec3 cell = (x / spacing).array().floor();
    const std::array<std::int64_t, 3> key = {std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())};
    if (!taken.insert(key).second) return;
    const Vec3 half = 0.5 * kLineLength * spacing * directions[i].normalized();
    const Vec3 lifted = x + kLift * spacing * lift_of(scan, i);
    add_line(data, lifted - half, lifted + half);
  });
  return data;
}

}  // namespace kappa::view_detail
