// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/memory.h>
#include <pcl/pcl_macros.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <boost/mpl/vector/vector30.hpp>
#include <boost/preprocessor/seq/enum.hpp>
#include <boost/preprocessor/seq/for_each.hpp>
#include <cstdint>
#include <limits>

#include "kappa/core/types.hpp"

namespace kappa {

/// Signed curvature at a point: the fields that every kappa file has, as a PCL point type.
///
/// Sign and units as in `Curvatures`: outward normals on a convex surface give positive values; mean, k_min and
/// k_max are 1/length, gaussian 1/length^2, mu0 and area length^2, mu1 length. `status` is a `PointStatus`:
/// anything but 0 goes with NaN in the curvatures and directions. Everything is computed in double and rounded
/// to float here. A fresh point is NaN throughout, with status Invalid.
struct EIGEN_ALIGN16 PointCurvature {
// The unions of PCL's macros hold structs without a name, as every PCL point does.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
  PCL_ADD_POINT4D;   // x y z
  PCL_ADD_NORMAL4D;  // normal_x normal_y normal_z
#pragma GCC diagnostic pop
  float mean_curvature = kUnset;
  float gaussian_curvature = kUnset;
  float k_min = kUnset, k_max = kUnset;
  float dir_min_x = kUnset, dir_min_y = kUnset, dir_min_z = kUnset;
  float dir_max_x = kUnset, dir_max_y = kUnset, dir_max_z = kUnset;
  float mu0 = kUnset, mu1 = kUnset, mu2 = kUnset;
  float area = kUnset;
  float coverage = kUnset;
  std::uint32_t face_count = 0;
  std::uint8_t status = static_cast<std::uint8_t>(PointStatus::Invalid);

  PointCurvature() : data{kUnset, kUnset, kUnset, 1.0F}, data_n{kUnset, kUnset, kUnset, 0.0F} {}

  static constexpr float kUnset = std::numeric_limits<float>::quiet_NaN();

  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace kappa

// What POINT_CLOUD_REGISTER_POINT_STRUCT does, in PCL's own parts: that macro names boost::mpl::vector, which ends at
// 20 fields, where vector23 is needed. Its sums of points are left out, they mean nothing for curvatures.
// clang-format off
#define KAPPA_POINT_CURVATURE_FIELDS                                                            \
  ((float, x, x))((float, y, y))((float, z, z))                                                 \
  ((float, normal_x, normal_x))((float, normal_y, normal_y))((float, normal_z, normal_z))       \
  ((float, mean_curvature, mean_curvature))((float, gaussian_curvature, gaussian_curvature))    \
  ((float, k_min, k_min))((float, k_max, k_max))                                                \
  ((float, dir_min_x, dir_min_x))((float, dir_min_y, dir_min_y))((float, dir_min_z, dir_min_z)) \
  ((float, dir_max_x, dir_max_x))((float, dir_max_y, dir_max_y))((float, dir_max_z, dir_max_z)) \
  ((float, mu0, mu0))((float, mu1, mu1))((float, mu2, mu2))                                     \
  ((float, area, area))((float, coverage, coverage))                                            \
  ((std::uint32_t, face_count, face_count))((std::uint8_t, status, status))
namespace pcl {
namespace fields {
BOOST_PP_SEQ_FOR_EACH(POINT_CLOUD_REGISTER_FIELD_TAG, _, KAPPA_POINT_CURVATURE_FIELDS)
}
namespace traits {
BOOST_PP_SEQ_FOR_EACH(POINT_CLOUD_REGISTER_FIELD_NAME, kappa::PointCurvature, KAPPA_POINT_CURVATURE_FIELDS)
BOOST_PP_SEQ_FOR_EACH(POINT_CLOUD_REGISTER_FIELD_OFFSET, kappa::PointCurvature, KAPPA_POINT_CURVATURE_FIELDS)
BOOST_PP_SEQ_FOR_EACH(POINT_CLOUD_REGISTER_FIELD_DATATYPE, kappa::PointCurvature, KAPPA_POINT_CURVATURE_FIELDS)
template <>
struct fieldList<kappa::PointCurvature> {
  using type = boost::mpl::vector23<BOOST_PP_SEQ_ENUM(POINT_CLOUD_EXTRACT_TAGS(KAPPA_POINT_CURVATURE_FIELDS))>;
};
}  // namespace traits
}  // namespace pcl
#undef KAPPA_POINT_CURVATURE_FIELDS
// clang-format on
