// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "kappa/core/error.hpp"
#include "kappa/io/filter.hpp"

namespace kappa {

namespace {

/// Normals are perpendicular to a surface, not along it: where heights grow, they lean less.
Vec3 stretched(const Vec3& normal, double z_scale) {
  const double length = normal.norm();
  const Vec3 turned(normal.x(), normal.y(), normal.z() / z_scale);
  return length > 0 ? (turned * (length / turned.norm())).eval() : normal;
}

}  // namespace

std::vector<Index> find_no_returns(const Scan& scan) {
  constexpr std::size_t kFewest = 10, kShare = 1000;
  std::vector<Index> found;
  if (scan.is_mesh()) return found;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if ((scan.points[i] + scan.origin).isZero(0)) found.push_back(static_cast<Index>(i));
  }
  const bool are_many = found.size() >= kFewest && found.size() * kShare > scan.points.size();
  return are_many ? found : std::vector<Index>();
}

MeasuringFrame::MeasuringFrame(Scan& scan, double z_scale) : z_scale_(z_scale), no_returns_(find_no_returns(scan)) {
  if (!(z_scale > 0) || !std::isfinite(z_scale)) {
    throw Error(ErrorCode::InvalidArgument,
                "heights cannot be scaled by " + std::to_string(z_scale) + ": give a positive number");
  }
  for (const Index i : no_returns_) {
    zeros_.push_back(scan.points[i]);
    scan.points[i].setConstant(kNaN);
  }
  if (z_scale == 1) return;
  heights_.reserve(scan.points.size());
  for (Vec3& p : scan.points) {
    heights_.push_back(p.z());
    p.z() *= z_scale;
  }
  normals_ = scan.normals;
  for (Vec3& u : scan.normals) u = stretched(u, z_scale);
  origin_height_ = scan.origin.z();
  scan.origin.z() *= z_scale;
  viewpoint_ = scan.viewpoint;
  if (scan.viewpoint) scan.viewpoint->z() *= z_scale;
}

void MeasuringFrame::undo(Scan& scan) const {
  if (z_scale_ != 1) {
    for (std::size_t i = 0; i < scan.points.size(); ++i) scan.points[i].z() = heights_[i];
    scan.normals = normals_;
    scan.origin.z() = origin_height_;
    scan.viewpoint = viewpoint_;
  }
  for (std::size_t k = 0; k < no_returns_.size(); ++k) scan.points[no_returns_[k]] = zeros_[k];
}

Vec3 MeasuringFrame::normal_of_file(const Vec3& normal) const {
  return z_scale_ == 1 ? normal : stretched(normal, 1 / z_scale_);
}

}  // namespace kappa
