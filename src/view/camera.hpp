// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/view/figure.hpp"

class vtkCamera;

namespace kappa::view_detail {

/// Unit vector from the data to the eye.
Vec3 towards_eye(const Camera& camera);

/// Part of a viewport that the data may fill, as fractions from its lower left corner.
struct Frame {
  double left = 0.04, right = 0.96, bottom = 0.05, top = 0.95;
};

/// Places a VTK camera in the direction and with the up axis of `camera`, so that all finite points just fit into
/// `frame` if the zoom is 1. `aspect` is the width of the viewport over its height.
void place_camera(vtkCamera* placed, const std::vector<Vec3>& points, const Camera& camera, double aspect,
                  const Frame& frame);

}  // namespace kappa::view_detail
