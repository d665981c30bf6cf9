// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa {

/// What `make_surface` is to do, decided from the options and from what the scan holds.
struct SurfaceChoice {
  SurfaceKind kind = SurfaceKind::Faces;      ///< never Auto
  std::string reason;                         ///< why that kind, in a few words
  NormalsKind normals = NormalsKind::Input;   ///< never Auto
  Orientation orientation = Orientation::Up;  ///< Auto: by the slope of the planes, once they are fitted
  std::optional<Vec3> viewpoint;              ///< relative to the origin of the scan
};

/// @throws Error InvalidArgument if the options contradict each other or the scan lacks what they ask for.
SurfaceChoice choose_surface(const Scan& scan, const SurfaceOptions& options);

}  // namespace kappa
