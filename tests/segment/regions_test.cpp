// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/segment/regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "kappa/core/error.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

/// n x n vertices over [0, 1]^2 and a field that is valid everywhere.
struct Patch {
  Mesh mesh;
  CurvatureField field;
  std::vector<Label> labels;
};

Patch patch(int n, Label label) {
  Patch p;
  p.mesh = shapes::square(n).mesh;
  p.field.samples.resize(p.mesh.vertices.size());
  for (CurvatureSample& s : p.field.samples) {
    s.k.status = PointStatus::Valid;
    s.k.mean = 1;
    s.k.gaussian = 2;
  }
  p.labels.assign(p.mesh.vertices.size(), label);
  return p;
}

void paint(Patch& p, double x0, double x1, double y0, double y1, Label label) {
  for (std::size_t i = 0; i < p.labels.size(); ++i) {
    const Vec3& v = p.mesh.vertices[i];
    if (v.x() >= x0 && v.x() <= x1 && v.y() >= y0 && v.y() <= y1) p.labels[i] = label;
  }
}

double total_area(const Segmentation& s) {
  return std::accumulate(s.table.begin(), s.table.end(), 0.0, [](double sum, const Region& r) { return sum + r.area; });
}

TEST(FindRegions, HalvesOfASquare) {
  Patch p = patch(21, Label::Flat);
  paint(p, 0.61, 1, 0, 1, Label::Convex);
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {});
  ASSERT_EQ(s.table.size(), 2u);
  EXPECT_EQ(s.table[0].label, Label::Flat);
  EXPECT_EQ(s.table[1].label, Label::Convex);
  // Vertices up to x = 0.6 and from 0.65: the border runs half-way, along the height of the square.
  EXPECT_NEAR(s.table[0].area, 0.625, 1e-2);
  EXPECT_NEAR(total_area(s), 1.0, 1e-12);
  EXPECT_NEAR(s.table[0].border, s.table[1].border, 1e-12);
  EXPECT_GE(s.table[0].border, 1.0);
  EXPECT_LE(s.table[0].border, 1.5);
  EXPECT_EQ(s.table[0].points + s.table[1].points, p.labels.size());
  EXPECT_EQ(s.table[1].mean_curvature, 1);
  EXPECT_EQ(s.table[1].gaussian_curvature, 2);
  EXPECT_NEAR(s.table[1].centroid.x(), 0.825, 1e-12);
  for (std::size_t i = 0; i < s.regions.size(); ++i) {
    ASSERT_GE(s.regions[i], 1u);
    EXPECT_EQ(s.table[s.regions[i] - 1].label, s.labels[i]);
  }
}

TEST(FindRegions, OneLabelInTwoPlacesIsTwoRegions) {
  Patch p = patch(21, Label::Flat);
  paint(p, 0, 0.2, 0, 0.2, Label::Saddle);
  paint(p, 0.8, 1, 0.8, 1, Label::Saddle);
  EXPECT_EQ(find_regions(p.mesh, p.field, p.labels, {}).table.size(), 3u);
}

TEST(FindRegions, SmallOnesGoToTheNeighbourOfTheLongestBorder) {
  Patch p = patch(41, Label::Flat);
  paint(p, 0.5, 1, 0, 1, Label::Convex);
  paint(p, 0.45, 0.7, 0.4, 0.6, Label::Saddle);  // mostly beside Convex
  EXPECT_EQ(find_regions(p.mesh, p.field, p.labels, {0.01}).table.size(), 3u);
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {0.2});
  ASSERT_EQ(s.table.size(), 2u);
  for (std::size_t i = 0; i < p.labels.size(); ++i)
    EXPECT_EQ(s.labels[i], p.labels[i] == Label::Saddle ? Label::Convex : p.labels[i]);
  EXPECT_NEAR(total_area(s), 1.0, 1e-12);
}

TEST(FindRegions, MergedBordersAreThoseOfTheUnion) {
  Patch p = patch(41, Label::Flat);
  paint(p, 0.5, 1, 0, 1, Label::Convex);
  const double before = find_regions(p.mesh, p.field, p.labels, {}).table[0].border;
  paint(p, 0.7, 0.8, 0.4, 0.6, Label::Saddle);  // inside Convex: merging it must leave the outer border alone
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {0.1});
  ASSERT_EQ(s.table.size(), 2u);
  EXPECT_NEAR(s.table[0].border, before, 1e-12);
}

TEST(FindRegions, AChainOfSmallOnesGrowsUntilItIsLargeEnough) {
  Patch p = patch(41, Label::Flat);
  for (int i = 0; i < 10; ++i) paint(p, 0.1 * i, 0.1 * i + 0.099, 0, 1, i % 2 ? Label::Convex : Label::Concave);
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {0.25});
  for (const Region& r : s.table) EXPECT_GE(r.area, 0.25);
  EXPECT_NEAR(total_area(s), 1.0, 1e-12);
  const Segmentation one = find_regions(p.mesh, p.field, p.labels, {10.0});
  EXPECT_EQ(one.table.size(), 1u);
}

TEST(FindRegions, MergingJoinsWhatItBringsTogether) {
  Patch p = patch(41, Label::Flat);
  paint(p, 0.45, 0.55, 0, 1, Label::Saddle);
  EXPECT_EQ(find_regions(p.mesh, p.field, p.labels, {0.01}).table.size(), 3u);
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {0.2});
  ASSERT_EQ(s.table.size(), 1u);
  EXPECT_NEAR(s.table[0].area, 1.0, 1e-12);
  EXPECT_EQ(s.table[0].border, 0.0);
}

TEST(FindRegions, NeighboursHaveOneRegionExactlyIfTheyHaveOneLabel) {
  Patch p = patch(41, Label::Flat);
  std::uint32_t state = 1;
  for (Label& label : p.labels) {
    state = state * 1664525U + 1013904223U;
    label = static_cast<Label>(1 + (state >> 24) % 6);
  }
  for (const double min_area : {0.0, 0.001, 0.01, 0.1, 0.4}) {
    const Segmentation s = find_regions(p.mesh, p.field, p.labels, {min_area});
    for (std::size_t f = 0; f < p.mesh.faces.size(); ++f) {
      const Faces::View face = p.mesh.faces[f];
      for (std::size_t i = 0; i < face.size(); ++i) {
        const Index a = face[i], b = face[(i + 1) % face.size()];
        ASSERT_EQ(s.labels[a] == s.labels[b], s.regions[a] == s.regions[b]) << min_area << " points " << a << ' ' << b;
      }
    }
    for (const Region& r : s.table) EXPECT_GE(r.area, min_area);
    EXPECT_NEAR(total_area(s), 1.0, 1e-12);
  }
}

TEST(FindRegions, UndefinedPointsHaveNoRegionAndTakeNone) {
  Patch p = patch(21, Label::Flat);
  paint(p, 0.4, 0.6, 0, 1, Label::Undefined);
  const Segmentation s = find_regions(p.mesh, p.field, p.labels, {10.0});
  ASSERT_EQ(s.table.size(), 2u);
  for (std::size_t i = 0; i < p.labels.size(); ++i) {
    EXPECT_EQ(s.labels[i], p.labels[i]);
    EXPECT_EQ(s.regions[i] == 0, p.labels[i] == Label::Undefined);
  }
}

TEST(FindRegions, TwinsBelongTogether) {
  Patch p = patch(11, Label::Flat);
  const std::size_t n = p.labels.size();
  p.mesh.vertices.insert(p.mesh.vertices.end(), p.mesh.vertices.begin(), p.mesh.vertices.end());
  p.field.samples.insert(p.field.samples.end(), p.field.samples.begin(), p.field.samples.end());
  p.labels.assign(2 * n, Label::Flat);
  std::vector<Index> twins(2 * n);
  for (Index i = 0; i < 2 * n; ++i) twins[i] = i % static_cast<Index>(n);
  EXPECT_EQ(find_regions(p.mesh, p.field, p.labels, {}, twins).table.size(), 1u);
  EXPECT_EQ(find_regions(p.mesh, p.field, p.labels, {}).table.size(), n + 1);
}

TEST(FindRegions, RefusesSizesThatDiffer) {
  Patch p = patch(5, Label::Flat);
  EXPECT_THROW(find_regions(p.mesh, p.field, {}, {}), Error);
  EXPECT_THROW(find_regions(p.mesh, p.field, p.labels, {-1.0}), Error);
  EXPECT_THROW(find_regions(p.mesh, p.field, p.labels, {kNaN}), Error);
  EXPECT_THROW(find_regions(p.mesh, p.field, p.labels, {}, {1, 2}), Error);
  p.mesh.faces.add(0, 1, 25);
  EXPECT_THROW(find_regions(p.mesh, p.field, p.labels, {}), Error);
}

}  // namespace
}  // namespace kappa
