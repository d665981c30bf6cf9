// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Names of our fields in VTK files, where they differ. A field may carry a suffix ("_r0.5").
namespace kappa::io {

/// mean_curvature -> Mean_Curvature, gaussian_curvature -> Gauss_Curvature, k_min -> Minimum_Curvature,
/// k_max -> Maximum_Curvature; any other name as it is.
std::string to_vtk_name(const std::string& name);
std::string from_vtk_name(const std::string& name);

/// Name of the vector that a component such as dir_min_y_r0.5 belongs to (dir_min_r0.5), empty for any
/// other name.
std::string direction_of(const std::string& component);

/// Name of component 0, 1 or 2 of the vector `name`: dir_min_r0.5 -> dir_min_x_r0.5, any other name
/// followed by _x, _y, _z.
std::string component_name(const std::string& name, int component);

}  // namespace kappa::io
