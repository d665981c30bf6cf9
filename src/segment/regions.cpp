// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/segment/regions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include <Eigen/Geometry>

#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {
namespace {

constexpr std::size_t kBlock = 4096;

/// Regions while they are merged: a forest over the points, and at each root its area and the lengths of its borders.
class RegionGraph {
 public:
  RegionGraph(const Mesh& mesh, const std::vector<Label>& labels, const std::vector<Index>& twins, const Execution& run)
      : labels_(labels), parent_(labels.size()), area_(labels.size(), 0.0), borders_(labels.size()) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    join_components(mesh, twins, stage(run, 0.0, 0.3));
    serial_for(mesh.faces.size(), kBlock, stage(run, 0.3, 1.0), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) add_face(mesh, f);
    });
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
  void merge_small(double min_area, const Execution& run) {
    constexpr std::size_t kMergedAtOnce = 256;
    for (Index i = 0; i < parent_.size(); ++i) {
      if (parent_[i] == i && labels_[i] != Label::Undefined && area_[i] < min_area) small_.emplace(area_[i], i);
    }
    Reporter report(run);
    const auto count = static_cast<double>(small_.size());
    for (std::size_t merged = 0; !small_.empty(); ++merged) {
      if (merged % kMergedAtOnce == 0) report(1 - static_cast<double>(small_.size()) / count);
      const Index from = small_.begin()->second;
      small_.erase(small_.begin());
      const Index to = best_neighbour(from);
      if (to != kNoIndex) merge(from, to, min_area);
    }
    report_progress(run, 1.0);
  }

 private:
  /// Merges a region into a neighbour. All of its neighbours with the label of that one become one with it.
  void merge(Index from, Index to, double min_area) {
    const std::vector<Index> touched = neighbours(from, labels_[to]);
    for (const Index other : touched) small_.erase({area_[other], other});
    absorb(from, to);
    for (Index other : touched) {
      other = root(other);
      if (other == to) continue;
      // The one of fewer neighbours goes into the other.
      if (borders_[other].size() > borders_[to].size()) std::swap(other, to);
      absorb(other, to);
    }
    if (area_[to] < min_area) small_.emplace(area_[to], to);
  }

  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  void join_alike(Index a, Index b) {
    if (labels_[a] == labels_[b]) join(a, b);
  }

  void join_components(const Mesh& mesh, const std::vector<Index>& twins, const Execution& run) {
    serial_for(mesh.faces.size(), kBlock, stage(run, 0.0, 0.8), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Faces::View face = mesh.faces[f];
        for (std::size_t i = 0; i < face.size(); ++i) join_alike(face[i], face[i + 1 < face.size() ? i + 1 : 0]);
      }
    });
    serial_for(twins.size(), kBlock, stage(run, 0.8, 1.0), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (twins[i] != kNoIndex) join_alike(static_cast<Index>(i), twins[i]);
      }
    });
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
  std::set<std::pair<double, Index>> small_;  ///< regions that are to be merged, by area
};

void check(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
           const std::vector<Index>& twins, const RegionOptions& options) {
  const std::size_t points = mesh.vertices.size();
  check_one_each(labels.size(), "label", points, "vertex");
  check_one_each(field.samples.size(), "sample", points, "vertex");
  if (!twins.empty()) check_one_each(twins.size(), "twin", points, "vertex");
  if (!(options.min_area >= 0 && std::isfinite(options.min_area)))
    throw Error(ErrorCode::InvalidArgument,
                "min_area = " + std::to_string(options.min_area) + ": give a finite area, 0 or more");
}

/// Numbers of the roots from 1, by decreasing area, ties by the first point.
std::map<Index, Index> number_regions(RegionGraph& graph, std::size_t points, const Execution& run) {
  std::vector<Index> roots;
  serial_for(points, kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (Index i = static_cast<Index>(begin); i < end; ++i) {
      if (graph.root(i) == i && graph.label(i) != Label::Undefined) roots.push_back(i);
    }
  });
  std::stable_sort(roots.begin(), roots.end(), [&](Index a, Index b) { return graph.area(a) > graph.area(b); });
  std::map<Index, Index> number;
  for (Index i = 0; i < roots.size(); ++i) number[roots[i]] = i + 1;
  return number;
}

/// Points, centroids and curvatures of the regions.
void describe_regions(const Mesh& mesh, const CurvatureField& field, Segmentation& s, const Execution& run) {
  std::vector<std::vector<double>> mean(s.table.size()), gaussian(s.table.size());
  const auto add_point = [&](std::size_t i) {
    if (s.regions[i] == 0) return;
    const std::size_t r = s.regions[i] - 1;
    ++s.table[r].points;
    s.table[r].centroid += mesh.vertices[i];
    if (field.samples[i].k.status != PointStatus::Valid) return;
    mean[r].push_back(field.samples[i].k.mean);
    gaussian[r].push_back(field.samples[i].k.gaussian);
  };
  serial_for(s.regions.size(), kBlock, stage(run, 0.0, 0.7), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) add_point(i);
  });
  constexpr std::size_t kRegionsAtOnce = 16;
  parallel_for(s.table.size(), kRegionsAtOnce, stage(run, 0.7, 1.0), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t r = begin; r < end; ++r) {
      s.table[r].centroid /= static_cast<double>(s.table[r].points);
      s.table[r].mean_curvature = median(mean[r]);
      s.table[r].gaussian_curvature = median(gaussian[r]);
    }
  });
}

/// Labels and regions of the points, and a row for each region with its label, area and border.
Segmentation segmentation_of(RegionGraph& graph, std::size_t points, const Execution& run) {
  const std::map<Index, Index> number = number_regions(graph, points, stage(run, 0.0, 0.4));
  Segmentation s;
  s.labels.assign(points, Label::Undefined);
  s.regions.assign(points, 0);
  s.table.resize(number.size());
  serial_for(points, kBlock, stage(run, 0.4, 1.0), [&](std::size_t begin, std::size_t end) {
    for (Index i = static_cast<Index>(begin); i < end; ++i) {
      const auto found = number.find(graph.root(i));
      if (found == number.end()) continue;
      s.labels[i] = graph.label(i);
      s.regions[i] = found->second;
    }
  });
  for (const auto& [root, region] : number) {
    s.table[region - 1].label = graph.label(root);
    s.table[region - 1].area = graph.area(root);
    s.table[region - 1].border = graph.border(root);
  }
  return s;
}

}  // namespace

Segmentation find_regions(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
                          const RegionOptions& options, const std::vector<Index>& twins, const Execution& run) {
  check(mesh, field, labels, twins, options);
  validate(mesh, stage(run, 0.0, 0.02));
  RegionGraph graph(mesh, labels, twins, stage(run, 0.02, 0.5));
  graph.merge_small(options.min_area, stage(run, 0.5, 0.8));
  Segmentation s = segmentation_of(graph, labels.size(), stage(run, 0.8, 0.9));
  describe_regions(mesh, field, s, stage(run, 0.9, 1.0));
  return s;
}

}  // namespace kappa
