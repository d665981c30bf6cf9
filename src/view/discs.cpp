// SPDX-License-Identifier: BSD-3-Clause
#include "discs.hpp"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "steps.hpp"

namespace kappa::view_detail {
namespace {

constexpr int kNeighbours = 16;   // more than are used: scans hold points twice
constexpr std::size_t kRing = 8;  // neighbours of other positions that surround a point
constexpr double kOverlap =
    1.05;  // of the distance to the last of them: closes a square grid, and a random one almost everywhere
constexpr double kWidest = 3;  // radii above this times the median are cut
constexpr std::size_t kSample = 2000;

/// The finite points and a locator on them.
class Neighbourhoods {
 public:
  Neighbourhoods(const std::vector<Vec3>& points, const Execution& run) : points_(points) {
    vtkNew<vtkPoints> finite;
    finite->SetDataTypeToDouble();
    each(points.size(), run, [&](std::size_t i) {
      if (!is_finite(points[i])) return;
      indices_.push_back(static_cast<Index>(i));
      finite->InsertNextPoint(points[i].data());
    });
    data_->SetPoints(finite);
    locator_->SetDataSet(data_);
    if (!indices_.empty()) locator_->BuildLocator();
  }

  std::size_t size() const { return indices_.size(); }
  Index point(std::size_t i) const { return indices_[i]; }

  /// Positions of up to kRing neighbours of the i-th finite point, none at its own position.
  void ring(std::size_t i, vtkIdList* found, std::vector<Vec3>& ring) const {
    const Vec3& x = points_[indices_[i]];
    locator_->FindClosestNPoints(kNeighbours, x.data(), found);
    ring.clear();
    for (vtkIdType j = 0; j < found->GetNumberOfIds() && ring.size() < kRing; ++j) {
      const Vec3& y = points_[indices_[static_cast<std::size_t>(found->GetId(j))]];
      if (y != x) ring.push_back(y);
    }
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<Index> indices_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkStaticPointLocator> locator_;
};

Vec3 plane_normal(const Vec3& x, const std::vector<Vec3>& ring, const Vec3& towards) {
  Vec3 mean = x;
  for (const Vec3& y : ring) mean += y;
  mean /= static_cast<double>(ring.size() + 1);
  Mat3 covariance = (x - mean) * (x - mean).transpose();
  for (const Vec3& y : ring) covariance += (y - mean) * (y - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  const Vec3 n = solver.eigenvectors().col(0);
  return n.dot(towards) < 0 ? Vec3(-n) : n;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void limit_radii(std::vector<Disc>& discs) {
  std::vector<double> radii;
  for (const Disc& disc : discs) radii.push_back(disc.radius);
  const double widest = kWidest * median(std::move(radii));
  for (Disc& disc : discs) disc.radius = std::min(disc.radius, widest);
}

}  // namespace

std::vector<Disc> make_discs(const std::vector<Vec3>& points, const Normals& normals, const Vec3& towards,
                             const Execution& run) {
  const Neighbourhoods neighbourhoods(points, stage(run, 0.0, 0.2));
  std::vector<Disc> discs(neighbourhoods.size());
  parallel_for(discs.size(), 1024, stage(run, 0.2, 1.0), [&](std::size_t begin, std::size_t end, int) {
    vtkNew<vtkIdList> found;
    std::vector<Vec3> ring;
    for (std::size_t i = begin; i < end; ++i) {
      const Index p = neighbourhoods.point(i);
      neighbourhoods.ring(i, found, ring);
      const double reach = ring.empty() ? 0.0 : (ring.back() - points[p]).norm();
      const bool given = p < normals.size() && is_finite(normals[p]) && normals[p].norm() > 0;
      discs[i] = {p, given ? Vec3(normals[p].normalized()) : plane_normal(points[p], ring, towards), kOverlap * reach};
    }
  });
  limit_radii(discs);
  return discs;
}

double median_spacing(const std::vector<Vec3>& points, const Execution& run) {
  const Neighbourhoods neighbourhoods(points, run);
  check_cancelled(run);
  const std::size_t step = std::max<std::size_t>(1, neighbourhoods.size() / kSample);
  vtkNew<vtkIdList> found;
  std::vector<Vec3> ring;
  std::vector<double> distances;
  for (std::size_t i = 0; i < neighbourhoods.size(); i += step) {
    neighbourhoods.ring(i, found, ring);
    if (!ring.empty()) distances.push_back((ring.front() - points[neighbourhoods.point(i)]).norm());
  }
  return median(std::move(distances));
}

}  // namespace kappa::view_detail
