// SPDX-License-Identifier: BSD-3-Clause
#include "point_order.hpp"

#include <algorithm>
#include <utility>

#include "kappa/core/gather.hpp"
#include "kappa/core/spatial_order.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

/// Moves values[i] to values[to[i]] along the cycles of the permutation, without a copy of them all. The values come
/// from all over the memory: they are asked for some steps ahead.
template <class T>
void scatter(std::vector<T>& values, const std::vector<Index>& to) {
  if (values.empty()) return;
  constexpr int kAhead = 12;
  std::vector<bool> moved(to.size());
  for (std::size_t first = 0; first < to.size(); ++first) {
    if (moved[first]) continue;
    T carried = std::move(values[first]);
    std::size_t ahead = first;
    for (int i = 0; i < kAhead; ++i) ahead = to[ahead];
    for (std::size_t at = to[first]; !moved[at]; at = to[at], ahead = to[ahead]) {
      for (std::size_t byte = 0; byte < sizeof(T); byte += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(&values[ahead]) + byte, 1);
      moved[at] = true;
      std::swap(carried, values[at]);
    }
  }
}

Faces renamed(const Faces& faces, const std::vector<Index>& names) {
  Faces result;
  result.reserve(faces.size(), faces.corners().size());
  std::vector<Index> corners;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    corners.clear();
    for (const Index v : faces[f]) corners.push_back(names[v]);
    result.add(corners);
  }
  return result;
}

}  // namespace

PointOrder::PointOrder(const Scan& scan, const Execution& run) {
  if (scan.is_mesh() || scan.is_organised()) return;
  file_ = spatial_order(scan.points, stage(run, 0.0, 0.0));
  if (std::is_sorted(file_.begin(), file_.end())) file_.clear();
}

Scan PointOrder::sorted(const Scan& scan) const {
  Scan result;
  result.origin = scan.origin;
  result.points = gathered(scan.points, file_);
  result.normals = gathered(scan.normals, file_);
  result.width = result.points.size();
  result.viewpoint = scan.viewpoint;
  const Field* const ring = scan.field("ring");
  if (ring) result.fields = {{ring->name, ring->type, gathered(ring->values, file_)}};
  return result;
}

std::vector<Index> PointOrder::places() const {
  std::vector<Index> result(file_.size());
  for (Index i = 0; i < file_.size(); ++i) result[file_[i]] = i;
  return result;
}

void PointOrder::restore(Surface& surface) const {
  if (!changes()) return;
  scatter(surface.mesh.vertices, file_);
  scatter(surface.u, file_);
  surface.mesh.faces = renamed(surface.mesh.faces, file_);
  for (Index& twin : surface.twins) twin = twin == kNoIndex ? kNoIndex : file_[twin];
  scatter(surface.twins, file_);
}

void PointOrder::restore(CurvatureField& field) const {
  if (changes()) scatter(field.samples, file_);
}

}  // namespace kappa
