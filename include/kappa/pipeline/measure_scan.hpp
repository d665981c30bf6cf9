// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/pipeline/filter_scan.hpp"
#include "kappa/pipeline/stages.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/segment/labels.hpp"
#include "kappa/segment/regions.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa {

/// What is kept when the curvatures are known.
enum class Keep {
  Everything,  ///< surface, balls and curvatures, in the order of the scan
  /// Mesh and balls are given up as early as can be: half of the memory. Normals and curvatures stay in the order in
  /// which they were computed, see `ScanResult::places`.
  Curvatures
};

/// How a scan becomes curvatures.
struct ScanOptions {
  std::string name = "the scan";  ///< what messages call it, such as the path of its file
  FilterOptions filter;
  SurfaceOptions surface;
  bool flip = false;  ///< whether all normals are turned round, and with them the signs of mean, k_min and k_max
  MeasureOptions measure;
  CurvatureOptions curvature = automatic_scale();
  /// If given, the points get labels and regions.
  std::optional<LabelOptions> labels;
  Keep keep = Keep::Everything;

  /// One radius, from the spacing and the noise of the scan.
  static CurvatureOptions automatic_scale() {
    CurvatureOptions options;
    options.scale = ScaleChoice::Automatic;
    options.radii.clear();
    return options;
  }
};

/// Checks all that can be checked without a scan.
/// @throws OptionError that names the member at fault by the struct it is in ("curvature.order", "ground.scaling").
void validate(const ScanOptions& options);

/// @throws OptionError unless the surface that the options ask for has faces.
void need_faces(const ScanOptions& options);

/// A scan with its surface.
struct SurfacedScan {
  Scan scan;  ///< what the filters left, in the coordinates of the file
  FilteredScan filtered;
  Surface surface;  ///< its heights in the unit of x and y, its vertices the points in the order of the scan
};

/// Filters a scan and makes its surface, with all points and normals in the order of the scan.
///
/// The result depends on the positions of the points and not on their order: a cloud without rows is put along a
/// space-filling curve before the surface is made, and its surface back in the order of the scan.
/// @throws OptionError as `validate` does; Error InvalidData if x and y are degrees, or as the stages do; Cancelled.
SurfacedScan surface_scan(Scan scan, const ScanOptions& options, StageWatch& watch);
SurfacedScan surface_scan(Scan scan, const ScanOptions& options, const Execution& run = {});

/// A scan whose balls can be measured.
struct PreparedScan {
  SurfacedScan surfaced;
  std::unique_ptr<BallSum> balls;  ///< null if the surface has no faces
  std::size_t faces = 0;           ///< of the surface
  std::size_t dropped_faces = 0;   ///< that could not be measured: a corner lacks position or normal
  /// Faces were refined, but the normals are too far from those of a smooth surface for that to gain anything.
  bool rough_normals = false;
};

/// The same, with the sums of balls built: all that is needed to measure at any radius.
/// @throws the same, and OptionError for a surface without faces, which has no balls.
PreparedScan prepare_scan(Scan scan, const ScanOptions& options, StageWatch& watch);
PreparedScan prepare_scan(Scan scan, const ScanOptions& options, const Execution& run = {});

/// The curvature options with the radii to be measured: the automatic one in place of ScaleChoice::Automatic.
/// @throws Error InvalidData if no radius can be chosen, OptionError for radius 0 on a cloud.
CurvatureOptions with_radii(const CurvatureOptions& options, const Surface& surface, const std::string& name);

/// Curvatures of a prepared scan, one field a radius, with directions in the coordinates of the file.
/// @throws OptionError as `estimate_curvatures` does; Cancelled.
std::vector<CurvatureField> measure(const PreparedScan& prepared, const CurvatureOptions& options,
                                    const Execution& run = {});

/// Labels and regions of the points at one radius.
struct LabelledScan {
  double threshold = 0;    ///< curvature (1/length) below which it counts as 0
  bool estimated = false;  ///< from the data; else as the options ask
  Segmentation segmentation;
};

/// Labels and regions of a field of a prepared scan; centroids are in the coordinates of the file relative to its
/// origin.
/// @throws Error InvalidData if too few points have a curvature to tell flat from curved; Cancelled.
LabelledScan label(const PreparedScan& prepared, const CurvatureField& field, const ScanOptions& options,
                   const Execution& run = {});

/// A scan with its curvatures.
struct ScanResult {
  PreparedScan prepared;               ///< with Keep::Curvatures without mesh, twins and balls
  std::vector<CurvatureField> fields;  ///< one a radius; one alone where every point has its own, or has no ball
  std::vector<LabelledScan> labels;    ///< one a field, if asked for
  bool automatic_radius = false;       ///< the radius was chosen from the data
  bool has_faces = true;               ///< else triangles of each point alone were measured
  /// Place of each point of the scan in `prepared.surfaced.surface.u` and in the fields; empty if they are the same.
  std::vector<Index> places;
};

/// Curvatures of a scan, and if asked labels and regions: filters, surface, balls, curvatures.
///
/// Equal scans give equal bits whatever the number of threads, and clouds whatever the order of their points.
/// Memory: about 560 bytes a point of a cloud with Keep::Curvatures.
/// @throws OptionError as `validate` does; Error InvalidData if x and y are degrees, if no radius can be chosen or no
/// point has a curvature, or as the stages do; Cancelled.
ScanResult measure_scan(Scan scan, const ScanOptions& options, StageWatch& watch);
ScanResult measure_scan(Scan scan, const ScanOptions& options = {}, const Execution& run = {});

}  // namespace kappa
