// SPDX-License-Identifier: BSD-3-Clause
// What the PCL feature computes, against truth and against kappa's own functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clouds.hpp"
#include "kappa/balls/measure_tree.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/curvature/in_balls.hpp"
#include "kappa/mesh/normals.hpp"
#include "kappa/pcl/convert.hpp"
#include "kappa/pcl/corrected_curvature_estimation.hpp"

namespace kappa::test {
namespace {

using Estimation = CorrectedCurvatureEstimation<pcl::PointXYZ, pcl::Normal, PointCurvature>;

void set_shape(const Shape& shape, Estimation& estimation) {
  estimation.setInputCloud(shape.cloud);
  estimation.setInputNormals(shape.normals);
}

Output compute(Estimation& estimation) {
  Output out;
  estimation.compute(out);
  EXPECT_TRUE(estimation.status().ok()) << estimation.status().message();
  return out;
}

Output compute(const Shape& shape, double radius) {
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setRadiusSearch(radius);
  return compute(estimation);
}

/// The pipeline of kappa's own functions on a cloud, its umbrella surface or the given faces.
struct Pipeline {
  Vec3 origin;
  std::vector<Vec3> points;
  Normals normals;
  Triangles triangles;

  explicit Pipeline(const Shape& shape, const Faces& faces = {}, QuadMeasures quads = QuadMeasures::Split)
      : points(points_of(*shape.cloud)), normals(normalised(normals_of(*shape.normals))) {
    origin = choose_origin(bounds(points));
    for (Vec3& x : points) x -= origin;
    Mesh mesh;
    if (faces.empty()) {
      mesh = umbrella_surface(origin, points, normals, {}).mesh;
    } else {
      mesh.vertices = points;
      mesh.faces = faces;
    }
    triangles = triangles_of(mesh, normals, quads);
  }

  CurvatureField field(double radius, BallDefinition ball = BallDefinition::ExactDensity) const {
    return curvatures_in_balls(MeasureTree(triangles), points, normals, BallPlan{{radius}, 1, ball}).front();
  }
};

void expect_same(const Output& out, const Output& expected) {
  ASSERT_EQ(out.size(), expected.size());
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_TRUE(same_bits(out[i], expected[i])) << "point " << i;
}

TEST(CorrectedCurvatureEstimation, SphereHasItsCurvaturesAndTheKnownBias) {
  const double radius = 2, ball = 0.5;
  const Output out = compute(sphere(radius, 3000), ball);
  ASSERT_EQ(out.size(), 3000U);
  EXPECT_TRUE(out.is_dense);
  const double k = (1 - ball * ball / (4 * radius * radius)) / radius;
  for (const PointCurvature& p : out) {
    // True normals give mean and gaussian exactly; float coordinates leave 1e-7 of an edge of 0.13.
    EXPECT_NEAR(p.mean_curvature, 1 / radius, 2e-6);
    EXPECT_NEAR(p.gaussian_curvature, 1 / (radius * radius), 2e-6);
    EXPECT_NEAR(p.k_min, k, 2e-3);
    EXPECT_NEAR(p.k_max, k, 2e-3);
    EXPECT_NEAR(p.coverage, 1, 0.02);
    EXPECT_EQ(p.status, 0);
    EXPECT_GT(p.face_count, 20U);
  }
}

TEST(CorrectedCurvatureEstimation, TorusHasItsCurvaturesAndDirections) {
  const Output out = compute(torus(190, 64), 0.25);
  double worst_k = 0, worst_mean = 0;
  for (const PointCurvature& p : out) {
    const TorusTruth truth = torus_truth(p);
    worst_mean = std::max(worst_mean, std::abs(double{p.mean_curvature} - truth.mean));
    worst_k = std::max({worst_k, std::abs(double{p.k_max} - 1), std::abs(double{p.k_min} - truth.k_min)});
    const Vec3 direction(p.dir_max_x, p.dir_max_y, p.dir_max_z);
    EXPECT_NEAR(std::abs(direction.dot(truth.dir_max)), 1, 1e-3);
  }
  // The bias of a ball of 0.25 (SPEC, section 7: 1.2e-3 and 1.7e-2 rms), with room for the worst point.
  EXPECT_LT(worst_mean, 5e-3);
  EXPECT_LT(worst_k, 3e-2);
  EXPECT_GT(worst_k, 5e-3);
}

TEST(CorrectedCurvatureEstimation, OrdersCancelTheBiasOfTheBall) {
  const double radius = 2, k = 1 / radius;
  Estimation estimation;
  set_shape(sphere(radius, 3000), estimation);
  estimation.setRadiusSearch(0.5);
  double worst[3];
  for (int order = 1; order <= 3; ++order) {
    estimation.setOrder(order);
    const Output out = compute(estimation);
    ASSERT_EQ(estimation.getStandardErrors().size(), out.size());
    double& of_order = worst[order - 1] = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      of_order = std::max(of_order, std::abs(double{out[i].k_max} - k));
      EXPECT_EQ(std::isnan(estimation.getStandardErrors()[i]), order == 1);
    }
  }
  // A ball of 0.5 on a sphere of 2 loses 1/64 of each curvature at order 1.
  EXPECT_NEAR(worst[0], k / 64, 2e-3);
  EXPECT_LT(worst[1], worst[0] / 3);
  EXPECT_LT(worst[2], worst[0] / 3);
}

TEST(CorrectedCurvatureEstimation, AnOrderThatIsNoneIsToldInTheStatus) {
  for (const int order : {0, 4, -1}) {
    Estimation estimation;
    set_shape(sphere(2, 300), estimation);
    estimation.setRadiusSearch(0.5);
    estimation.setOrder(order);
    Output out;
    estimation.compute(out);
    EXPECT_TRUE(out.empty()) << order;
    EXPECT_EQ(estimation.status().code(), ErrorCode::InvalidArgument) << order;
  }
}

TEST(CorrectedCurvatureEstimation, FlippedNormalsFlipTheSigns) {
  Shape shape = torus(95, 32);
  const Output out = compute(shape, 0.5);
  for (pcl::Normal& n : *shape.normals) n.getNormalVector3fMap() *= -1;
  const Output flipped = compute(shape, 0.5);
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_NEAR(flipped[i].mean_curvature, -out[i].mean_curvature, 1e-6);
    EXPECT_NEAR(flipped[i].gaussian_curvature, out[i].gaussian_curvature, 1e-6);
    EXPECT_NEAR(flipped[i].k_min, -out[i].k_max, 1e-6);
    EXPECT_NEAR(flipped[i].k_max, -out[i].k_min, 1e-6);
  }
}

TEST(CorrectedCurvatureEstimation, EqualsKappasOwnPipeline) {
  const Shape shape = torus(60, 20);
  const Pipeline direct(shape);
  for (const BallDefinition ball : {BallDefinition::ExactDensity, BallDefinition::AreaFraction}) {
    Estimation estimation;
    set_shape(shape, estimation);
    estimation.setRadiusSearch(0.6);
    estimation.setBallDefinition(ball);
    const Output out = compute(estimation);
    expect_same(out, to_curvature_cloud(direct.points, direct.normals, direct.field(0.6, ball), direct.origin));
  }
}

TEST(CorrectedCurvatureEstimation, PolygonsAreTheSurface) {
  const Shape shape = torus(60, 20);
  const auto quads = torus_quads(60, 20);
  for (const QuadMeasures measures : {QuadMeasures::Split, QuadMeasures::Bilinear}) {
    Estimation estimation;
    set_shape(shape, estimation);
    estimation.setRadiusSearch(0.6);
    estimation.setPolygons(quads);
    estimation.setQuadMeasures(measures);
    const Output out = compute(estimation);
    const Pipeline direct(shape, to_faces(quads, shape.cloud->size()), measures);
    expect_same(out, to_curvature_cloud(direct.points, direct.normals, direct.field(0.6), direct.origin));
  }
}

TEST(CorrectedCurvatureEstimation, PointsFarFromEveryPolygonAreEmpty) {
  const Shape shape = torus(60, 20);
  auto quads = torus_quads(60, 20);
  quads.resize(10 * 20);  // Of 60 slices.
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setRadiusSearch(0.3);
  estimation.setPolygons(quads);
  Output out = compute(estimation);
  EXPECT_FALSE(out.is_dense);
  EXPECT_EQ(out[5 * 20].status, static_cast<int>(PointStatus::Valid));
  EXPECT_EQ(out[30 * 20].status, static_cast<int>(PointStatus::Empty));
  EXPECT_TRUE(std::isnan(out[30 * 20].mean_curvature));
  EXPECT_EQ(out[30 * 20].face_count, 0U);
  estimation.setPolygons({});  // Back to the umbrella surface.
  EXPECT_TRUE(compute(estimation).is_dense);
}

TEST(CorrectedCurvatureEstimation, IndicesSelectTheOutput) {
  const Shape shape = torus(60, 20);
  const Output all = compute(shape, 0.6);
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setRadiusSearch(0.6);
  const pcl::IndicesPtr indices(new pcl::Indices{700, 3, 3, 1199});
  estimation.setIndices(indices);
  const Output some = compute(estimation);
  ASSERT_EQ(some.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_bits(some[i], all[static_cast<std::size_t>((*indices)[i])]));
}

/// Points on the torus between those of the grid.
Shape points_between() {
  Shape shape;
  for (int i = 0; i < 40; ++i) {
    const double a = 0.37 + 0.153 * i, b = 0.11 + 1.7 * i;
    const Vec3 u(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
    shape.add(Vec3(3 * std::cos(a), 3 * std::sin(a), 0) + u, u);
  }
  return shape;
}

TEST(CorrectedCurvatureEstimation, SearchSurfaceIsWhatIsMeasured) {
  const Shape surface = torus(190, 64), queries = points_between();
  Estimation estimation;
  estimation.setInputCloud(queries.cloud);
  estimation.setSearchSurface(surface.cloud);
  estimation.setInputNormals(surface.normals);
  estimation.setRadiusSearch(0.25);
  const Output out = compute(estimation);

  const Pipeline direct(surface);
  const MeasureTree balls(direct.triangles);
  ASSERT_EQ(out.size(), queries.cloud->size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 x = points_of(*queries.cloud)[i] - direct.origin;
    const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - x).squaredNorm() < (b - x).squaredNorm(); };
    const auto nearest = std::min_element(direct.points.begin(), direct.points.end(), nearer) - direct.points.begin();
    const Vec3 u = direct.normals[static_cast<std::size_t>(nearest)];
    const CurvatureField field = curvatures_in_balls(balls, {x}, {u}, BallPlan{{0.25}}).front();
    EXPECT_TRUE(same_bits(out[i], to_curvature_cloud({x}, {u}, field, direct.origin)[0])) << "point " << i;
    EXPECT_NEAR(out[i].mean_curvature, torus_truth(out[i]).mean, 5e-3);
    EXPECT_NEAR(out[i].k_min, torus_truth(out[i]).k_min, 3e-2);
  }
}

/// Distance of the k-th of the points to `x`, counting from 1.
double kth_distance(const std::vector<Vec3>& points, const Vec3& x, std::size_t k) {
  std::vector<double> distances;
  for (const Vec3& p : points) distances.push_back((p - x).norm());
  std::sort(distances.begin(), distances.end());
  return distances[k - 1];
}

TEST(CorrectedCurvatureEstimation, KSearchMeasuresTheBallOfTheKNearest) {
  const Shape shape = sphere(2, 900);
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setKSearch(30);
  const Output out = compute(estimation);
  const Pipeline direct(shape);
  const BruteForceBallSum balls(direct.triangles);
  for (std::size_t i = 0; i < out.size(); i += 13) {
    const Vec3 x = direct.points[i];
    const double radius = kth_distance(direct.points, x, 30);
    const auto fields = curvatures_in_balls(balls, {x}, {direct.normals[i]}, BallPlan{{radius}});
    const CurvatureSample& by_hand = fields.front().samples.front();
    EXPECT_NEAR(out[i].k_min, by_hand.k.k_min, 1e-6);
    EXPECT_NEAR(out[i].area, by_hand.area, 1e-6 * by_hand.area);
    EXPECT_NEAR(out[i].coverage, by_hand.area / (kPi * radius * radius), 1e-5);
  }
}

TEST(CorrectedCurvatureEstimation, KSearchAmongFewerPointsTakesAll) {
  const Shape shape = sphere(2, 60);
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setKSearch(1000);
  const Output out = compute(estimation);
  for (const PointCurvature& p : out) {
    EXPECT_NEAR(p.area, out[0].area, 1e-5F * out[0].area);  // The whole surface.
    EXPECT_NEAR(p.mean_curvature, 0.5, 1e-5);
  }
}

TEST(CorrectedCurvatureEstimation, KPointsAtOnePositionHaveNoBall) {
  Shape shape = sphere(2, 300);
  const auto first = shape.cloud->front();
  const auto normal = shape.normals->front();
  for (int i = 0; i < 5; ++i) {
    shape.cloud->push_back(first);
    shape.normals->push_back(normal);
  }
  Estimation estimation;
  set_shape(shape, estimation);
  estimation.setKSearch(4);
  const Output out = compute(estimation);
  EXPECT_EQ(out[0].status, static_cast<int>(PointStatus::Empty));
  EXPECT_TRUE(std::isnan(out[0].mean_curvature));
  EXPECT_EQ(out[50].status, static_cast<int>(PointStatus::Valid));
  EXPECT_FALSE(out.is_dense);
}

TEST(CorrectedCurvatureEstimation, ThreadsDoNotChangeOneBit) {
  Shape shape = torus(60, 20);
  (*shape.cloud)[77].x = std::numeric_limits<float>::quiet_NaN();
  for (const int k : {0, 25}) {
    Estimation estimation;
    set_shape(shape, estimation);
    estimation.setKSearch(k);
    estimation.setRadiusSearch(k > 0 ? 0 : 0.6);
    const Output one = compute(estimation);
    estimation.setNumberOfThreads(2);
    expect_same(compute(estimation), one);
    estimation.setNumberOfThreads(0);
    expect_same(compute(estimation), one);
  }
}

/// A grid on a paraboloid z = (x^2 + y^2) / 2048 with a spacing of 4, moved by `shift`: exact in float.
Shape paraboloid(const Vec3& shift) {
  Shape shape;
  for (int i = -20; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) {
      const double x = 4 * i, y = 4 * j;
      shape.add(Vec3(x, y, (x * x + y * y) / 2048) + shift, Vec3(-x / 1024, -y / 1024, 1).normalized());
    }
  }
  return shape;
}

TEST(CorrectedCurvatureEstimation, GeoreferencedCoordinatesLoseNoMoreThanTheCloudDid) {
  const Output near = compute(paraboloid(Vec3::Zero()), 20);
  const Vec3 shift(500000, 5400000, 128);
  const Output far = compute(paraboloid(shift), 20);
  for (std::size_t i = 0; i < near.size(); ++i) {
    // Upward normals on a valley: negative. The points are the same but for the shift.
    EXPECT_LT(far[i].mean_curvature, 0);
    EXPECT_NEAR(far[i].mean_curvature, near[i].mean_curvature, 1e-6F * std::abs(near[i].mean_curvature));
    EXPECT_NEAR(far[i].k_min, near[i].k_min, 1e-6F * std::abs(near[i].k_min));
  }
  // What a float cloud cannot hold: two points 0.2 apart at a UTM northing are one.
  Shape shape;
  shape.add(shift, Vec3::UnitZ());
  shape.add(shift + Vec3(0, 0.2, 0), Vec3::UnitZ());
  EXPECT_EQ((*shape.cloud)[0].y, (*shape.cloud)[1].y);
}

}  // namespace
}  // namespace kappa::test
