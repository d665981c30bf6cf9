// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/io/filter.hpp"

namespace kappa {

namespace {

/// The vector with its height multiplied, of the length that it had. Where heights are multiplied, directions along the
/// surface are stretched alike, its normals by the inverse.
Vec3 stretched(const Vec3& v, double factor) {
  const double length = v.norm();
  const Vec3 turned(v.x(), v.y(), v.z() * factor);
  return length > 0 ? (turned * (length / turned.norm())).eval() : v;
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

SetAside::SetAside(Scan& scan, std::vector<Index> points) : points_(scan.points.size()), indices_(std::move(points)) {
  for (const Index i : indices_) {
    if (i >= points_)
      throw Error(ErrorCode::InvalidArgument, "point " + std::to_string(i) + " of " + std::to_string(points_) +
                                                  " cannot be set aside: give an index below their number");
    positions_.push_back(scan.points[i]);
  }
  for (const Index i : indices_) scan.points[i].setConstant(kNaN);
}

void SetAside::restore(Scan& scan) const {
  if (scan.points.size() != points_) return;
  for (std::size_t k = 0; k < indices_.size(); ++k) scan.points[indices_[k]] = positions_[k];
}

HeightUnit::HeightUnit(double z_scale) : z_scale_(z_scale) {
  if (z_scale > 0 && std::isfinite(z_scale)) return;
  throw Error(ErrorCode::InvalidArgument,
              "heights cannot be scaled by " + std::to_string(z_scale) + ": give a positive number");
}

void HeightUnit::apply(Scan& scan) {
  if (z_scale_ == 1) return;
  heights_.reserve(scan.points.size());
  for (Vec3& p : scan.points) {
    heights_.push_back(p.z());
    p.z() *= z_scale_;
  }
  normals_ = scan.normals;
  for (Vec3& u : scan.normals) u = stretched(u, 1 / z_scale_);
  origin_height_ = scan.origin.z();
  scan.origin.z() *= z_scale_;
  viewpoint_ = scan.viewpoint;
  if (scan.viewpoint) scan.viewpoint->z() *= z_scale_;
}

void HeightUnit::restore(Scan& scan) const {
  if (z_scale_ == 1) return;
  for (std::size_t i = 0; i < scan.points.size(); ++i) scan.points[i].z() = heights_[i];
  scan.normals = normals_;
  scan.origin.z() = origin_height_;
  scan.viewpoint = viewpoint_;
}

Vec3 HeightUnit::point_of_file(const Vec3& point) const {
  return {point.x(), point.y(), point.z() / z_scale_};
}

Vec3 HeightUnit::normal_of_file(const Vec3& normal) const {
  return z_scale_ == 1 ? normal : stretched(normal, z_scale_);
}

Vec3 HeightUnit::direction_of_file(const Vec3& direction) const {
  return z_scale_ == 1 ? direction : stretched(direction, 1 / z_scale_);
}

}  // namespace kappa
