// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/labels.hpp"
#include "kappa/curvature/field.hpp"

namespace kappa {

/// The label of every sample of a field, one for each sample. `threshold` (1/length) is that of `classify` for one
/// point.
/// @throws Error InvalidArgument if the threshold is negative or not finite; Cancelled.
std::vector<Label> classify(const CurvatureField& field, double threshold, const Execution& run = {});

/// An estimated threshold is kThresholdMedians times the median by which curvatures change between two scales.
///
/// Derivation. Where noise rules, the ball of half the radius has 2^(3/2) times the noise of the larger ball, because
/// noise enters on the rim: it falls as radius^(-3/2). Then the change has sqrt(1 + 2^3) = 3 standard deviations of the
/// larger ball, and its median, 0.67 times that, is 2 of them. So 1.5 medians are 3 standard deviations of the
/// curvature that is labelled, beyond which lie 0.3 % of normal deviates. Where the bias c radius^2 rules, the change
/// is 3/4 of the bias of the larger ball. So every factor above 4/3 covers this bias.
inline constexpr double kThresholdMedians = 1.5;

/// An estimated threshold is at least kLeastTurn / radius. The normals of a surface with this curvature turn by a
/// millionth over the radius. Normals stored in single precision are rounded by 6e-8 (2^-24) in each coordinate; such a
/// rounding at both ends of a radius, of either sign, makes an error of up to 2 * sqrt(2) * 6e-8 = 1.7e-7 in the turn,
/// which is a fifth of this.
inline constexpr double kLeastTurn = 1e-6;

/// `estimate_threshold` looks at every n-th point, with the largest n that leaves kThresholdSample of them. The error
/// of a median of m absolute normal deviates is 1.17 / sqrt(m) of it (one standard deviation): 0.6 % for the two
/// curvatures of 20,000 points.
inline constexpr std::size_t kThresholdSample = 20000;

/// The size below which the data cannot tell a principal curvature from 0 (1/length), from two fields of the same
/// points at different scales. Noise, sampling and bias change from scale to scale, and what is there stays: the
/// threshold is kThresholdMedians times the median of |k(coarse) - k(fine)| over both principal curvatures of all
/// points that are valid in both fields. It is at least kLeastTurn / scale. It is NaN if no point is valid in both.
///
/// `scale` > 0 is the radius of the coarse field, or the length of an edge if that is 0.
/// @throws Error InvalidArgument if the fields differ in their number of samples or the scale is not positive;
/// Cancelled.
double curvature_threshold(const CurvatureField& coarse, const CurvatureField& fine, double scale,
                           const Execution& run = {});

/// The `curvature_threshold` of a field of balls around `centres`, or of vertices, with the corrected normals `u`
/// there.
///
/// The fine field is measured here, at the order of `field`, for at least kThresholdSample of the centres and fewer
/// than twice as many, evenly spread; for all if they are fewer. It has (a) half the radius of `field`; (b) the radius
/// `spacing`, a typical length of an edge, if the radius of `field` is 0. If every point of the field has a radius of
/// its own, nothing is measured: the threshold is kThresholdMedians times the median of std_error, and at least
/// kLeastTurn / typical_radius(field).
/// @throws Error InvalidArgument if there is not one sample and one normal for each centre, or the spacing is not
/// positive; Cancelled.
double estimate_threshold(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                          const CurvatureField& field, BallDefinition ball, double spacing, const Execution& run = {});

/// The percentile `p`, in [0, 100], of the larger of |k_min| and |k_max| over the valid samples. NaN if there is none.
/// @throws Cancelled.
double curvature_percentile(const CurvatureField& field, double p, const Execution& run = {});

/// The choices that a user may make about labels and regions. What is not given is taken from the data.
struct LabelOptions {
  std::optional<double> kappa_max;   ///< the curvature that `flatness` is a part of; 1/length, > 0
  std::optional<double> flatness;    ///< a curvature below this part of kappa_max counts as 0; in [0, 1]
  std::optional<double> min_region;  ///< smaller regions are merged into a neighbour; area, >= 0

  /// Whether the threshold is estimated from the data: neither kappa_max nor flatness is given.
  bool estimates_threshold() const { return !kappa_max && !flatness; }
};

/// Checks the options.
/// @throws Error InvalidArgument if one is out of its range.
void validate(const LabelOptions& options);

/// kappa_max where flatness alone is given: this percentile of the curvatures, at which the colours of pictures end,
/// too. The rest are creases, borders and outliers, which say nothing of the surface as a whole.
inline constexpr double kKappaMaxPercentile = 98;

/// flatness where kappa_max alone is given: a twentieth, which a map of colours hardly shows.
inline constexpr double kFlatness = 0.05;

/// The threshold for the labels of a field: flatness * kappa_max if one of the two is given; else `estimate_threshold`
/// with these arguments. It is NaN if no threshold can be estimated because too few points have a curvature.
/// @throws Error InvalidArgument as `validate` and `estimate_threshold` do; Cancelled.
double label_threshold(const LabelOptions& options, const BallSum& balls, const std::vector<Vec3>& centres,
                       const Normals& u, const CurvatureField& field, BallDefinition ball, double spacing,
                       const Execution& run = {});

/// Where min_region is not given, it is the area of a disc with kRegionRadius times the radius of the balls. The balls
/// around any two places of such a disc have at least 39 % of their areas in common, so what differs within it is noise
/// rather than shape.
inline constexpr double kRegionRadius = 0.5;

/// The area below which regions of a field are merged: min_region if it is given. Else it is pi (kRegionRadius r)^2,
/// with r = typical_radius(field), and 0 at radius 0.
/// @throws Error InvalidArgument as `validate` does.
double least_region(const LabelOptions& options, const CurvatureField& field);

}  // namespace kappa
