// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/segment/regions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include <Eigen/Geometry>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

/// Regions while they are merged: a forest over the points, and at each root its area and the lengths of its borders.
class RegionGraph {
 public:
  RegionGraph(const Mesh& mesh, const std::vector<Label>& labels, const std::vector<Index>& twins)
      : labels_(labels), parent_(labels.size()), area_(labels.size(), 0.0), borders_(labels.size()) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    join_components(mesh, twins);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) add_face(mesh, f);
  }

  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  Label label(Index i) { return labels_[root(i)]; }
  double area(Index root) const { return area_[root]; }
  double border(Index root) const {
    double sum = 0;
    for (const auto& [other, length] : borders_[root]) sum += length;
    return sum;
  }

  /// Merges regions below `min_area`, smallest first, ties by their first point.
  void merge_small(double min_area) {
    std::set<std::pair<double, Index>> small;
    for (Index i = 0; i < parent_.size(); ++i) {
      if (parent_[i] == i && labels_[i] != Label::Undefined && area_[i] < min_area) small.emplace(area_[i], i);
    }
    while (!small.empty()) {
      const Index from = small.begin()->second;
      small.erase(small.begin());
      Index to = best_neighbour(from);
      if (to == kNoIndex) continue;
      // All of that label that the small one touches become one, the one of fewer neighbours going into the other.
      const std::vector<Index> touched = neighbours(from, labels_[to]);
      for (const Index other : touched) small.erase({area_[other], other});
      absorb(from, to);
      for (Index other : touched) {
        other = root(other);
        if (other == to) continue;
        if (borders_[other].size() > borders_[to].size()) std::swap(other, to);
        absorb(other, to);
      }
      if (area_[to] < min_area) small.emplace(area_[to], to);
    }
  }

 private:
  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  void join_components(const Mesh& mesh, const std::vector<Index>& twins) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Faces::View face = mesh.faces[f];
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Index a = face[i], b = face[(i + 1) % face.size()];
        if (labels_[a] == labels_[b]) join(a, b);
      }
    }
    for (Index i = 0; i < twins.size(); ++i) {
      if (twins[i] != kNoIndex && labels_[i] == labels_[twins[i]]) join(i, twins[i]);
    }
  }

  /// Shares a face out: by triangles around its barycentre, a third of each half to either end of a side.
  void add_face(const Mesh& mesh, std::size_t f) {
    const Faces::View face = mesh.faces[f];
    const double n = static_cast<double>(face.size());
    Vec3 centre = Vec3::Zero();
    for (const Index v : face) centre += mesh.vertices[v] / n;
    if (!is_finite(centre)) return;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Index a = face[i], b = face[(i + 1) % face.size()];
      const Vec3 &xa = mesh.vertices[a], &xb = mesh.vertices[b];
      const Index ra = root(a), rb = root(b);
      const double half_area = 0.25 * (xa - centre).cross(xb - centre).norm() * mesh.weight(f);
      area_[ra] += half_area;
      area_[rb] += half_area;
      if (ra != rb) add_border(ra, rb, (0.5 * (xa + xb) - centre).norm() * mesh.weight(f));
    }
  }

  void add_border(Index a, Index b, double length) {
    borders_[a][b] += length;
    borders_[b][a] += length;
  }

  Index best_neighbour(Index from) const {
    Index best = kNoIndex;
    double longest = -1;
    for (const auto& [other, length] : borders_[from]) {
      if (labels_[other] == Label::Undefined || length <= longest) continue;
      longest = length;
      best = other;
    }
    return best;
  }

  std::vector<Index> neighbours(Index of, Label label) const {
    std::vector<Index> found;
    for (const auto& [other, length] : borders_[of]) {
      if (labels_[other] == label) found.push_back(other);
    }
    return found;
  }

  void absorb(Index from, Index to) {
    parent_[from] = to;
    area_[to] += area_[from];
    for (const auto& [other, length] : borders_[from]) {
      borders_[other].erase(from);
      if (other != to) add_border(to, other, length);
    }
    borders_[from].clear();
  }

  const std::vector<Label>& labels_;
  std::vector<Index> parent_;
  std::vector<double> area_;
  std::vector<std::map<Index, double>> borders_;
};

void check_sizes(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
                 const std::vector<Index>& twins, const RegionOptions& options) {
  const std::size_t points = mesh.vertices.size();
  if (labels.size() != points || field.samples.size() != points || !(twins.empty() || twins.size() == points))
    throw Error(ErrorCode::InvalidArgument, "labels (" + std::to_string(labels.size()) + "), samples (" +
                                                std::to_string(field.samples.size()) + ") and vertices (" +
                                                std::to_string(points) + ") must be equally many");
  if (!(options.min_area >= 0 && std::isfinite(options.min_area)))
    throw Error(ErrorCode::InvalidArgument,
                "min_area = " + std::to_string(options.min_area) + ": give a finite area, 0 or more");
}

/// Numbers of the roots from 1, by decreasing area, ties by the first point.
std::map<Index, Index> number_regions(RegionGraph& graph, std::size_t points) {
  std::vector<Index> roots;
  for (Index i = 0; i < points; ++i) {
    if (graph.root(i) == i && graph.label(i) != Label::Undefined) roots.push_back(i);
  }
  std::stable_sort(roots.begin(), roots.end(), [&](Index a, Index b) { return graph.area(a) > graph.area(b); });
  std::map<Index, Index> number;
  for (Index i = 0; i < roots.size(); ++i) number[roots[i]] = i + 1;
  return number;
}

void describe_regions(const Mesh& mesh, const CurvatureField& field, Segmentation& s) {
  std::vector<std::vector<double>> mean(s.table.size()), gaussian(s.table.size());
  for (std::size_t i = 0; i < s.regions.size(); ++i) {
    if (s.regions[i] == 0) continue;
    const std::size_t r = s.regions[i] - 1;
    ++s.table[r].points;
    s.table[r].centroid += mesh.vertices[i];
    if (field.samples[i].k.status != PointStatus::Valid) continue;
    mean[r].push_back(field.samples[i].k.mean);
    gaussian[r].push_back(field.samples[i].k.gaussian);
  }
  for (std::size_t r = 0; r < s.table.size(); ++r) {
    s.table[r].centroid /= static_cast<double>(s.table[r].points);
    s.table[r].mean_curvature = percentile(mean[r], 50);
    s.table[r].gaussian_curvature = percentile(gaussian[r], 50);
  }
}

}  // namespace

std::vector<Label> classify(const CurvatureField& field, double threshold) {
  if (!(threshold >= 0 && std::isfinite(threshold)))
    throw Error(ErrorCode::InvalidArgument,
                "threshold = " + std::to_string(threshold) + ": give a finite curvature (1/length), 0 or more");
  std::vector<Label> labels(field.samples.size());
  std::transform(field.samples.begin(), field.samples.end(), labels.begin(),
                 [&](const CurvatureSample& s) { return classify(s.k.k_min, s.k.k_max, threshold); });
  return labels;
}

Segmentation find_regions(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
                          const RegionOptions& options, const std::vector<Index>& twins) {
  check_sizes(mesh, field, labels, twins, options);
  validate(mesh);
  RegionGraph graph(mesh, labels, twins);
  graph.merge_small(options.min_area);
  const std::map<Index, Index> number = number_regions(graph, labels.size());

  Segmentation s;
  s.labels.assign(labels.size(), Label::Undefined);
  s.regions.assign(labels.size(), 0);
  s.table.resize(number.size());
  for (Index i = 0; i < labels.size(); ++i) {
    const auto found = number.find(graph.root(i));
    if (found == number.end()) continue;
    s.labels[i] = graph.label(i);
    s.regions[i] = found->second;
  }
  for (const auto& [root, region] : number) {
    s.table[region - 1].label = graph.label(root);
    s.table[region - 1].area = graph.area(root);
    s.table[region - 1].border = graph.border(root);
  }
  describe_regions(mesh, field, s);
  return s;
}

}  // namespace kappa
