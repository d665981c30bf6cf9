// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/impl/curvature_job.hpp"

#include <cmath>
#include <exception>
#include <new>
#include <sstream>
#include <utility>

#include "kappa/balls/measure_tree.hpp"

namespace kappa::detail {

namespace {

Triangles triangles_of(const CurvatureJob& job, const Execution& execution) {
  const Mesh& given = job.surface;
  if (!given.faces.empty()) return kappa::triangles_of(given, job.normals, job.quads, execution);
  const auto umbrella =
      umbrella_surface(given.origin, given.vertices, job.normals, job.umbrella, stage(execution, 0, 0.8));
  return kappa::triangles_of(umbrella.mesh, job.normals, job.quads, stage(execution, 0.8, 1));
}

}  // namespace

std::vector<CurvatureSample> run(const CurvatureJob& job, const Execution& execution) {
  const MeasureTree balls(triangles_of(job, stage(execution, 0, 0.4)), Precision::Double, stage(execution, 0.4, 0.5));
  const Execution rest = stage(execution, 0.5, 1);
  if (!job.radii.empty())
    return curvatures_in_own_balls(balls, job.centres, job.centre_normals, job.radii, job.order, job.ball, rest);
  const BallPlan plan{{job.radius}, job.order, job.ball};
  auto fields = curvatures_in_balls(balls, job.centres, job.centre_normals, plan, rest);
  return std::move(fields.front().samples);
}

void check_search(double radius, int k) {
  const auto fail = [&](const char* remedy) {
    std::ostringstream message;
    message << "The search has radius " << radius << " and k " << k << ": " << remedy;
    throw Error(ErrorCode::InvalidArgument, message.str());
  };
  if (radius == 0 && k == 0) fail("set one of them, by setRadiusSearch or setKSearch.");
  if (radius != 0 && k != 0) fail("set one of them to 0.");
  if (k == 0 && !(std::isfinite(radius) && radius > 0)) fail("the radius must be finite and above 0.");
  if (radius == 0 && k < 2) fail("k must be 2 or more, since the nearest point is the point itself.");
}

void check_indices(const std::vector<int>& indices, std::size_t size) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= 0 && static_cast<std::size_t>(indices[i]) < size) continue;
    throw Error(ErrorCode::InvalidData, "Index " + std::to_string(indices[i]) + " at position " + std::to_string(i) +
                                            " of setIndices is not a point of the cloud: use 0 to " +
                                            std::to_string(size - 1) + ".");
  }
}

Status status_of(const std::function<void()>& call) {
  try {
    call();
    return {};
  } catch (const Error& e) {
    return {e.code(), e.what()};
  } catch (const Cancelled&) {
    return {ErrorCode::Cancelled, "The computation was cancelled: there is no result."};
  } catch (const std::bad_alloc&) {
    return {ErrorCode::Unavailable, "Memory ran out: use fewer points."};
  } catch (const std::exception& e) {
    return {ErrorCode::Unavailable, e.what()};
  }
}

}  // namespace kappa::detail
