// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/labels.hpp"
#include "kappa/curvature/field.hpp"
#include "kappa/mesh/mesh.hpp"

namespace kappa {

/// What regions are made.
struct RegionOptions {
  double min_area = 0;  ///< regions with a smaller area are merged into a neighbour; length^2
};

/// A connected part of a surface with one label.
struct Region {
  Label label = Label::Undefined;
  std::size_t points = 0;
  double area = 0;                   ///< length^2
  double border = 0;                 ///< length of its border with other regions and with undefined points
  Vec3 centroid = Vec3::Zero();      ///< mean of its points, relative to the origin of the mesh
  double mean_curvature = kNaN;      ///< median of its valid points, 1/length; NaN if there are none
  double gaussian_curvature = kNaN;  ///< median of its valid points, 1/length^2; NaN if there are none
};

/// A decomposition of the points of a surface into regions.
struct Segmentation {
  std::vector<Label> labels;   ///< one for each point, after merging
  std::vector<Index> regions;  ///< the number of each point's region, from 1 on; 0 where the label is undefined
  std::vector<Region> table;   ///< region i is table[i - 1]; by decreasing area
};

/// Divides the points of a surface into regions: connected components of points of one label, joined along the edges of
/// faces.
///
/// `labels` and the samples of `field` are one for each vertex of `mesh`. `twins` is empty, or gives each point another
/// one at the same position to which it belongs (CloudSurface::representative), or kNoIndex for none.
///
/// A point has a third of the triangles around it as area, by the weights of the faces; a polygon is split at its
/// barycentre. Within a face the border of two regions runs from the midpoints of its edges to its barycentre.
///
/// Regions smaller than `min_area` are merged, the smallest first, into the neighbour with which they share the longest
/// border. Where regions of one label come to touch by this, they become one. So neighbours always differ in label.
/// A region without a neighbour stays.
/// @throws Error InvalidArgument if the numbers of labels, samples, twins and vertices differ, or min_area is negative
/// or not finite; InvalidData as `validate` does for the mesh; Cancelled.
Segmentation find_regions(const Mesh& mesh, const CurvatureField& field, const std::vector<Label>& labels,
                          const RegionOptions& options, const std::vector<Index>& twins = {},
                          const Execution& run = {});

}  // namespace kappa
