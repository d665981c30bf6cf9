// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa {

/// Puts the points of a cloud along a space-filling curve, and what was made of them back in the order of the file.
/// Neighbours then lie side by side in memory through all stages: on a cloud in random order that halves the time.
/// Points at one position keep their order. Leaves alone what has faces or rows.
class PointOrder {
 public:
  PointOrder() = default;
  PointOrder(const Scan& scan, const Execution& run);

  /// False if everything stays where it is.
  bool changes() const { return !file_.empty(); }

  /// What a surface is made of, in the new order: points, normals, viewpoint and the field "ring".
  Scan sorted(const Scan& scan) const;

  /// Place in the new order of each point of the file; empty if they are the same.
  std::vector<Index> places() const;

  /// Back from the new order to that of the file.
  void restore(Surface& surface) const;
  void restore(CurvatureField& field) const;

 private:
  std::vector<Index> file_;  ///< place in the file of each point of the new order; empty if they are the same
};

}  // namespace kappa
