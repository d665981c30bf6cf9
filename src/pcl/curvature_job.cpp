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

MeasuredTriangles triangles_of(const CurvatureJob& job, const Execution& execution) {
  const Mesh& given = job.surface;
  if (!given.faces.empty()) return triangles_for_tree(given, job.normals, job.quads, execution);
  const auto umbrella = umbrella_surface(given.origin, given.vertices, job.normals, job.umbrella, execution);
  return triangles_for_tree(umbrella.mesh, job.normals, job.quads, execution);
}

CurvatureOptions options_of(const CurvatureJob& job, double radius) {
  CurvatureOptions options;
  options.radii = {radius};
  options.ball = job.ball;
  options.order = job.order;
  return options;
}

CurvatureSample sample_of(const BallSum& balls, const CurvatureJob& job, std::size_t i) {
  if (job.radii[i] > 0) {
    const auto fields = estimate_curvatures(balls, std::vector<Vec3>{job.centres[i]}, Normals{job.centre_normals[i]},
                                            options_of(job, job.radii[i]));
    return fields.front().samples.front();
  }
  CurvatureSample sample;
  const Vec3& u = job.centre_normals[i];
  const bool valid = is_finite(job.centres[i]) && is_finite(u) && !u.isZero(0);
  sample.k.status = valid ? PointStatus::Empty : PointStatus::Invalid;
  return sample;
}

}  // namespace

std::vector<CurvatureSample> run(const CurvatureJob& job, const Execution& execution) {
  const MeasureTree balls(triangles_of(job, stage(execution, 0, 0.4)), Precision::Double, stage(execution, 0.4, 0.5));
  const Execution rest = stage(execution, 0.5, 1);
  if (job.radii.empty()) {
    auto fields = estimate_curvatures(balls, job.centres, job.centre_normals, options_of(job, job.radius), rest);
    return std::move(fields.front().samples);
  }
  std::vector<CurvatureSample> samples(job.centres.size());
  parallel_for(samples.size(), 64, rest, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) samples[i] = sample_of(balls, job, i);
  });
  return samples;
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
