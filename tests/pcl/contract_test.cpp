// SPDX-License-Identifier: BSD-3-Clause
// How the PCL feature behaves: conventions of PCL's features, bad points, bad calls.
#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "clouds.hpp"
#include "kappa/pcl/corrected_curvature_estimation.hpp"
#include "kappa/pcl/impl/corrected_curvature_estimation.hpp"

namespace kappa::test {
namespace {

using Estimation = CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, PointCurvature>;
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

/// An estimation of a torus of 60 x 20 points, and its output.
class Contract : public ::testing::Test {
 protected:
  Contract() {
    estimation.setInputCloud(shape.cloud);
    estimation.setInputNormals(shape.normals);
    estimation.setRadiusSearch(0.6);
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~Contract() override { pcl::console::setVerbosityLevel(pcl::console::L_INFO); }

  void compute() { estimation.compute(out); }

  /// Runs a call that cannot be served on an output that holds something.
  void expect_refused(ErrorCode code, const std::string& part_of_message) {
    out.resize(7);
    compute();
    EXPECT_TRUE(out.empty());
    EXPECT_EQ(out.width, 0U);
    EXPECT_EQ(out.height, 0U);
    EXPECT_FALSE(estimation.status().ok());
    EXPECT_EQ(estimation.status().code(), code);
    EXPECT_NE(estimation.status().message().find(part_of_message), std::string::npos) << estimation.status().message();
  }

  Shape shape = torus(60, 20);
  Estimation estimation;
  Output out;
};

TEST_F(Contract, OrganisedInputGivesOrganisedOutputWithItsHeader) {
  shape.cloud->header.frame_id = "scanner";
  shape.cloud->header.stamp = 42;
  EXPECT_TRUE(estimation.status().ok());
  compute();
  EXPECT_EQ(out.width, 20U);
  EXPECT_EQ(out.height, 60U);
  EXPECT_EQ(out.header.frame_id, "scanner");
  EXPECT_EQ(out.header.stamp, 42U);
  EXPECT_EQ(out[33].x, (*shape.cloud)[33].x);
  EXPECT_NEAR(out[33].normal_y, (*shape.normals)[33].normal_y, 1e-6);
}

TEST_F(Contract, IndicesGiveARow) {
  estimation.setIndices(pcl::IndicesPtr(new pcl::Indices{4, 2}));
  compute();
  EXPECT_EQ(out.width, 2U);
  EXPECT_EQ(out.height, 1U);
  EXPECT_EQ(out[0].z, (*shape.cloud)[4].z);
  estimation.setIndices(pcl::IndicesPtr(new pcl::Indices));
  compute();
  EXPECT_TRUE(out.empty());
  EXPECT_TRUE(estimation.status().ok());
}

TEST_F(Contract, WorksThroughThePclBaseClass) {
  compute();
  CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, PointCurvature>::Ptr derived(new Estimation(2));
  const pcl::FeatureFromNormals<pcl::PointXYZ, pcl::Normal, PointCurvature>::Ptr from_normals = derived;
  from_normals->setInputNormals(shape.normals);
  const pcl::Feature<pcl::PointXYZ, PointCurvature>::Ptr base = from_normals;
  base->setInputCloud(shape.cloud);
  base->setRadiusSearch(0.6);
  Output through_base;
  base->compute(through_base);
  ASSERT_EQ(through_base.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(same_bits(through_base[i], out[i]));
}

TEST_F(Contract, PrincipalCurvaturesOfPclAreADropIn) {
  compute();
  CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalCurvatures> drop_in;
  drop_in.setInputCloud(shape.cloud);
  drop_in.setInputNormals(shape.normals);
  drop_in.setRadiusSearch(0.6);
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  drop_in.compute(curvatures);
  ASSERT_EQ(curvatures.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_EQ(curvatures[i].pc1, out[i].k_max);
    EXPECT_EQ(curvatures[i].pc2, out[i].k_min);
    EXPECT_EQ(curvatures[i].principal_curvature_x, out[i].dir_max_x);
    EXPECT_EQ(curvatures[i].principal_curvature_y, out[i].dir_max_y);
    EXPECT_EQ(curvatures[i].principal_curvature_z, out[i].dir_max_z);
  }
}

TEST_F(Contract, OnePointTypeCanHoldPositionsAndNormals) {
  compute();
  // The first is compiled in the library, the second here from the body in impl/.
  const auto check = [&](auto point) {
    using PointT = decltype(point);
    typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>(20, 60));
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      (*cloud)[i].getVector3fMap() = (*shape.cloud)[i].getVector3fMap();
      (*cloud)[i].getNormalVector3fMap() = (*shape.normals)[i].getNormalVector3fMap();
    }
    CorrectedCurvatureEstimation<PointT, PointT> both;
    both.setInputCloud(cloud);
    both.setInputNormals(cloud);
    both.setRadiusSearch(0.6);
    Output result;
    both.compute(result);
    ASSERT_EQ(result.size(), out.size());
    for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(same_bits(result[i], out[i]));
  };
  check(pcl::PointNormal());
  check(pcl::PointXYZINormal());
}

void expect_invalid(const PointCurvature& p) {
  EXPECT_EQ(p.status, static_cast<int>(PointStatus::Invalid));
  for (const float value : {p.mean_curvature, p.gaussian_curvature, p.k_min, p.k_max, p.dir_min_x, p.dir_max_z}) {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST_F(Contract, BadPointsAndNormalsGiveNaNAndTheOthersTheirCurvature) {
  (*shape.cloud)[5].y = kNotANumber;
  (*shape.cloud)[6].x = std::numeric_limits<float>::infinity();
  (*shape.normals)[605].normal_x = kNotANumber;
  (*shape.normals)[805].getNormalVector3fMap().setZero();
  for (const int k : {0, 30}) {
    estimation.setRadiusSearch(k > 0 ? 0 : 0.6);
    estimation.setKSearch(k);
    compute();
    EXPECT_TRUE(estimation.status().ok());
    EXPECT_FALSE(out.is_dense);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (i == 5 || i == 6 || i == 605 || i == 805) {
        expect_invalid(out[i]);
      } else {
        EXPECT_EQ(out[i].status, 0) << i;
        EXPECT_NEAR(out[i].mean_curvature, torus_truth(out[i]).mean, 0.05) << i;
      }
    }
  }
}

TEST_F(Contract, DropInOutputOfABadPointIsNaN) {
  (*shape.cloud)[5].y = kNotANumber;
  CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalCurvatures> drop_in;
  drop_in.setInputCloud(shape.cloud);
  drop_in.setInputNormals(shape.normals);
  drop_in.setRadiusSearch(0.6);
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  drop_in.compute(curvatures);
  EXPECT_TRUE(std::isnan(curvatures[5].pc1) && std::isnan(curvatures[5].pc2));
  EXPECT_TRUE(std::isnan(curvatures[5].principal_curvature_x));
  EXPECT_FALSE(curvatures.is_dense);
}

TEST_F(Contract, BadQueryOnASearchSurfaceIsInvalid) {
  const Shape queries = sphere(3.5, 4);
  (*queries.cloud)[2].z = kNotANumber;
  estimation.setInputCloud(queries.cloud);
  estimation.setSearchSurface(shape.cloud);
  estimation.setRadiusSearch(1);
  compute();
  ASSERT_EQ(out.size(), 4U);
  expect_invalid(out[2]);
  EXPECT_FALSE(out.is_dense);
}

/// A tree that counts what it is asked.
class CountingTree : public pcl::search::KdTree<pcl::PointXYZ> {
 public:
  using pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch;
  int nearestKSearch(const pcl::PointXYZ& point, int k, pcl::Indices& indices,
                     std::vector<float>& distances_sq) const override {
    ++calls;
    return pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch(point, k, indices, distances_sq);
  }
  mutable int calls = 0;
};

TEST_F(Contract, TheGivenSearchMethodIsUsed) {
  estimation.setRadiusSearch(0);
  estimation.setKSearch(25);
  compute();
  const Output expected = out;
  const pcl::shared_ptr<CountingTree> counting(new CountingTree);
  estimation.setSearchMethod(counting);
  compute();
  EXPECT_EQ(counting->calls, 1200);
  EXPECT_EQ(estimation.getSearchMethod(), counting);
  const pcl::search::Octree<pcl::PointXYZ>::Ptr octree(new pcl::search::Octree<pcl::PointXYZ>(0.5));
  const Output by_tree = out;
  estimation.setSearchMethod(octree);
  compute();
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_TRUE(same_bits(by_tree[i], expected[i]));
    EXPECT_NEAR(out[i].k_min, expected[i].k_min, 1e-5);  // Ties of the k-th neighbour fall as they like.
  }
}

TEST_F(Contract, PointsThatMovedSinceAreFoundWhereTheyAre) {
  estimation.setRadiusSearch(0);
  estimation.setKSearch(25);
  compute();
  const Output before = out;
  for (pcl::PointXYZ& p : *shape.cloud) p.getVector3fMap() *= 2;
  compute();
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i].area, 4 * before[i].area, 1e-5F * out[i].area);
}

TEST_F(Contract, CallsThatCannotBeServedLeaveAnEmptyOutputAndAStatus) {
  estimation.setInputCloud(nullptr);
  expect_refused(ErrorCode::InvalidArgument, "setInputCloud");
  estimation.setInputCloud(Cloud::Ptr(new Cloud));
  expect_refused(ErrorCode::InvalidArgument, "setInputCloud");
  estimation.setInputCloud(shape.cloud);
  estimation.setInputNormals(nullptr);
  expect_refused(ErrorCode::InvalidArgument, "setInputNormals");
  estimation.setInputNormals(NormalCloud::Ptr(new NormalCloud(3, 1)));
  expect_refused(ErrorCode::InvalidArgument, "3 normals for the 1200 points");
  estimation.setInputNormals(shape.normals);
  compute();
  EXPECT_TRUE(estimation.status().ok());
  EXPECT_EQ(out.size(), 1200U);
}

TEST_F(Contract, NormalsBelongToTheSearchSurface) {
  estimation.setSearchSurface(sphere(3, 10).cloud);
  expect_refused(ErrorCode::InvalidArgument, "1200 normals for the 10 points");
  estimation.setSearchSurface(Cloud::Ptr(new Cloud));
  expect_refused(ErrorCode::InvalidArgument, "setSearchSurface");
}

TEST_F(Contract, RadiusAndKMustMakeSense) {
  estimation.setKSearch(10);
  expect_refused(ErrorCode::InvalidArgument, "set one of them to 0");
  estimation.setRadiusSearch(0);
  for (const int k : {-1, 1}) {
    estimation.setKSearch(k);
    expect_refused(ErrorCode::InvalidArgument, "k must be 2 or more");
  }
  estimation.setKSearch(0);
  expect_refused(ErrorCode::InvalidArgument, "setRadiusSearch or setKSearch");
  for (const double radius : {-0.5, double{kNotANumber}, std::numeric_limits<double>::infinity()}) {
    estimation.setRadiusSearch(radius);
    expect_refused(ErrorCode::InvalidArgument, "finite and above 0");
  }
}

TEST_F(Contract, PolygonsAndIndicesMustBeInRange) {
  std::vector<pcl::Vertices> polygons = torus_quads(60, 20);
  polygons[17].vertices[2] = 1200;
  estimation.setPolygons(polygons);
  expect_refused(ErrorCode::InvalidData, "Polygon 17 has corner 1200");
  polygons[17].vertices[2] = -1;
  estimation.setPolygons(polygons);
  expect_refused(ErrorCode::InvalidData, "Polygon 17 has corner -1");
  polygons[17].vertices.resize(2);
  estimation.setPolygons(polygons);
  expect_refused(ErrorCode::InvalidData, "Polygon 17 has 2 corners");
  estimation.setPolygons({});
  for (const int index : {-1, 1200}) {
    estimation.setIndices(pcl::IndicesPtr(new pcl::Indices{0, index}));
    expect_refused(ErrorCode::InvalidData, "Index " + std::to_string(index) + " at position 1");
  }
}

TEST_F(Contract, OptionsMustBeInRange) {
  estimation.setUmbrellaNeighbours(2);
  expect_refused(ErrorCode::InvalidArgument, "neighbours");
  estimation.setUmbrellaNeighbours(16);
  estimation.setNumberOfThreads(std::numeric_limits<unsigned int>::max());
  expect_refused(ErrorCode::InvalidArgument, "threads");
}

TEST_F(Contract, ACloudWithoutAFinitePointIsRefused) {
  for (pcl::PointXYZ& p : *shape.cloud) p.x = kNotANumber;
  expect_refused(ErrorCode::InvalidArgument, "finite");
}

TEST_F(Contract, CancelLeavesAnEmptyOutput) {
  const std::atomic<bool> cancel(true);
  estimation.setCancel(&cancel);
  expect_refused(ErrorCode::Cancelled, "cancelled");
  estimation.setCancel(nullptr);
  compute();
  EXPECT_EQ(out.size(), 1200U);
}

TEST_F(Contract, AFailureIsLoggedInOneLine) {
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  estimation.setInputNormals(nullptr);
  ::testing::internal::CaptureStderr();
  compute();
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
  EXPECT_NE(log.find(estimation.status().message()), std::string::npos) << log;
}

}  // namespace
}  // namespace kappa::test
