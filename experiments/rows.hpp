// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/surface/surface.hpp"
#include "scans.hpp"
#include "subjects.hpp"

/// Measured lines of the tables of docs/surfaces.md. One thread throughout.
namespace kappa::experiments {

/// sprintf.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

struct Row {
  std::string surface, setting;
  int order = 1;   ///< 0: each point its own
  int refine = 0;  ///< levels
  Errors errors;
  double points_per_second = 0;  ///< of CPU time, search and surface included, normals given
};

/// "98,000": two digits, since machines are busy.
std::string speed(const Row& row);

/// A cloud with the normals that it is measured with.
struct Oriented {
  KnownScan known;
  Normals u;
  double automatic_radius = 0;  ///< that the program would take
  std::string normals;          ///< what they are, in a few words
  int runs = 3;                 ///< whose median time is told
};

Oriented with_exact_normals(const KnownScan& known);

/// Normals of quadrics, fitted as the options say (normal_neighbours, normal_radius), and without any as the program
/// does. Their signs are those of the exact normals; `normals` tells how many the program itself would have given
/// another.
Oriented with_fitted_normals(const KnownScan& known, SurfaceOptions options = {});

/// The cloud turned about the origin.
KnownScan rotated(const KnownScan& known, const Mat3& rotation);

/// 100 triangles a point for Uniform.
Row scheme_row(const Oriented& cloud, TriangleScheme scheme, int neighbours);
Row umbrella_row(const Oriented& cloud, const CurvatureOptions& options);
/// Faces and normals as make_surface makes them.
Row surface_row(const KnownScan& known, SurfaceKind kind, NormalsKind normals, const CurvatureOptions& options);

/// A Markdown table under its title: rms / greatest error of every curvature.
std::string table(const std::string& title, const std::vector<Row>& rows);

}  // namespace kappa::experiments
