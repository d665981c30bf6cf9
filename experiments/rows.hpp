// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/surface/surface.hpp"
#include "scans.hpp"
#include "subjects.hpp"

/// Measured rows of the tables of surfaces of clouds. One thread throughout.
namespace kappa::experiments {

/// sprintf.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

struct Row {
  std::string normals, surface, setting;
  std::string wrong_signs;  ///< per cent, see `Oriented`
  Errors errors;
  double points_per_second = 0;  ///< of CPU time, search and surface included, normals given
};

/// A cloud with the normals that it is measured with.
struct Oriented {
  KnownScan known;
  Normals u;
  double automatic_radius = 0;  ///< that the program would take
  std::string normals;          ///< what they are, in a few words
  std::string wrong_signs;      ///< per cent of the points whose normal the program would have turned round; or empty
  int runs = 3;                 ///< whose median time is told
};

Oriented with_exact_normals(const KnownScan& known);

/// Normals of quadrics, fitted as the options say (normal_neighbours, normal_radius), and without any as the program
/// does. Their signs are those of the exact normals.
Oriented with_fitted_normals(const KnownScan& known, SurfaceOptions options = {});

/// The cloud turned about the origin.
KnownScan rotated(const KnownScan& known, const Mat3& rotation);

/// 100 triangles a point for Uniform.
Row scheme_row(const Oriented& cloud, TriangleScheme scheme, int neighbours);
/// Every triangle split in four `refine` times.
Row umbrella_row(const Oriented& cloud, const CurvatureOptions& options, int refine = 0);
/// Faces and normals as make_surface makes them.
Row surface_row(const KnownScan& known, SurfaceKind kind, NormalsKind normals, const CurvatureOptions& options);

/// Names of the columns of `print_rows`: of every curvature the root mean square error and the largest one.
void print_columns();
/// CSV rows of one cloud. Points per second have two digits, for the machine may be busy.
void print_rows(const std::string& cloud, double noise_percent, const std::vector<Row>& rows);

}  // namespace kappa::experiments
