// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/labels.hpp"
#include "kappa/curvature/field.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// Label of every sample of a field, `threshold` (1/length) as in `classify`.
std::vector<Label> classify(const CurvatureField& field, double threshold);

/// The size below which the data cannot tell a principal curvature from 0, from two fields of the same points
/// at different scales: noise and sampling change from scale to scale, and so does the bias, while
/// what is there stays. The estimate is one and a half times the median of |k(coarse) - k(fine)| over both k. With
/// the finer radius = coarser / 2, whose bias of order rho^2 is a quarter as large, this is about the bias of the
/// coarser; where noise rules, that of the finer exceeds that of the coarser and the estimate is about three standard
/// deviations of the latter. Never less than 1e-6 / scale. `scale` > 0 is the coarser radius, or the edge length at
/// radius 0. NaN if no point is valid in both.
double curvature_threshold(const CurvatureField& coarse, const CurvatureField& fine, double scale);

/// `curvature_threshold` for a field of balls (or, at radius 0, of vertices) around `centres`: the finer field is
/// computed for at most 20,000 of them, evenly spread. At radius 0 the field is compared with balls of radius
/// `spacing`, the typical length of an edge; fields of a higher order with those of that order. Where every point has
/// its own scale it is one and a half times the median of their std_error. NaN if no point is valid in both.
/// @throws Error InvalidArgument if sizes differ or spacing is not positive.
double estimate_threshold(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                          const CurvatureField& field, BallDefinition ball, double spacing, const Execution& run = {});

/// Percentile `p` in [0, 100] of the larger of |k_min| and |k_max| over the valid samples, NaN if there is none.
double curvature_percentile(const CurvatureField& field, double p);

struct RegionOptions {
  double min_area = 0;  ///< regions of a smaller area (length^2) are merged into a neighbour
};

struct Region {
  Label label = Label::Undefined;
  std::size_t points = 0;
  double area = 0;               ///< a third of the faces around its points, by weight; length^2
  double border = 0;             ///< length of its border with other regions and with undefined points
  Vec3 centroid = Vec3::Zero();  ///< mean of its points, in local coordinates
  double mean_curvature = kNaN, gaussian_curvature = kNaN;  ///< medians over its valid points
};

/// A decomposition of the points into regions.
struct Segmentation {
  std::vector<Label> labels;   ///< after merging, one a point
  std::vector<Index> regions;  ///< number of each point's region from 1, 0 where the label is undefined
  std::vector<Region> table;   ///< region i is table[i - 1]; by decreasing area
};

/// Connected components of the points of one label, joined along edges of faces. Regions smaller than
/// `min_area` are merged, smallest first, into the neighbour they share the longest border with; the
/// border inside a face runs through the midpoints of its edges. Regions of one label that come to touch by that are
/// joined, so that neighbours always differ in label. A region without neighbour stays.
/// `twins`, if not empty, gives for each point another one at the same position that it belongs
/// with (CloudSurface::representative), kNoIndex for none.
/// @throws Error InvalidArgument if sizes differ or min_area is negative or not finite, InvalidData as `validate`.
Segmentation find_regions(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
                          const RegionOptions& options, const std::vector<Index>& twins = {});

}  // namespace kappa
