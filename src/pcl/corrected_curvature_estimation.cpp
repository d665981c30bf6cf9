// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/corrected_curvature_estimation.hpp"

#include "kappa/pcl/impl/corrected_curvature_estimation.hpp"

namespace kappa {

template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalCurvatures>;
template class CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::PointNormal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZI, pcl::Normal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZI, pcl::Normal, pcl::PrincipalCurvatures>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGB, pcl::Normal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGB, pcl::Normal, pcl::PrincipalCurvatures>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGBA, pcl::Normal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGBA, pcl::Normal, pcl::PrincipalCurvatures>;
template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::Normal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::PointNormal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PrincipalCurvatures>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGBNormal, pcl::PointXYZRGBNormal, PointCurvature>;
template class CorrectedCurvatureEstimation<pcl::PointXYZRGBNormal, pcl::PointXYZRGBNormal, pcl::PrincipalCurvatures>;

}  // namespace kappa
