// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/labels.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/colour_map.hpp"
#include "kappa/view/figure.hpp"

namespace kappa {

/// A field that can be shown: its name, its colours, and one value a point (NaN where there is none).
struct NamedValues {
  ScalarStyle style;
  std::vector<double> values;
};

/// What the viewer shows at one radius. `labels`, `status` and both directions have one entry a point or are empty.
struct ViewData {
  /// Radius of the measuring ball in units of the data, 0 for the finest scale of a mesh, NaN if it is not known.
  double radius = 0;
  std::vector<NamedValues> fields;  ///< at least one; the viewer keeps the field that it shows by its name
  std::vector<Label> labels;
  std::vector<PointStatus> status;
  DirectionFields directions;
};

/// Title, unit and colour map of a field, told from its name.
///
/// The title is the name with blanks for underscores. The unit is (a) 1/`length_unit` for mean_curvature, k_min and
/// k_max, (b) its square for gaussian_curvature, (c) empty for any other field; a suffix such as `_r2` does not matter.
/// The map is diverging for curvatures and for fields with a value below 0, else sequential.
ScalarStyle field_style(const Field& field, const std::string& length_unit = "length");

/// Labels that are stored as the numbers of `Label`. Any other number becomes `Label::Undefined`.
std::vector<Label> field_labels(const Field& field);

/// A set of curvatures that a scan holds in its fields.
struct StoredSet {
  /// What follows the names of its fields: empty, or "_r" and a radius, as `kappa curvature --radius 1,2` writes them.
  std::string suffix;
  double radius;  ///< of the suffix; NaN if the suffix is empty, since such a file does not tell its radius
};

/// The sets of curvatures of a scan, in the order of its fields: one for each suffix with which one of the fields
/// mean_curvature, gaussian_curvature, k_min, k_max or label occurs. Empty if the scan holds none of them.
std::vector<StoredSet> stored_sets(const Scan& scan);

/// The fields of a set as data for the viewer; nothing is computed.
///
/// `fields` holds, in this order, (a) mean curvature, gaussian curvature, k min, k max and coverage as far as the set
/// has them, (b) all other fields of the scan that belong to this set or to none, in the order of the scan. Names lose
/// the suffix. The fields label, status and dir_min_x ... dir_max_z become `labels`, `status` and `directions`; a scan
/// with no other field shows the numbers of its labels.
/// @throws Error InvalidArgument if `set` is none of `stored_sets(scan)`.
ViewData stored_data(const Scan& scan, const StoredSet& set);

}  // namespace kappa
