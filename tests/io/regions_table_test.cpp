// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/regions_table.hpp"

#include "support.hpp"

namespace kappa {
namespace {

Segmentation two_regions() {
  Segmentation s;
  s.table.resize(2);
  s.table[0] = {Label::Convex, 1, 2.5, 0.1, Vec3(0.25, 0, 0), 1.5, kNaN};
  s.table[1] = {Label::Valley, 1, 1.0, 0.1, Vec3(0, 0, -1), -2, 0};
  return s;
}

TEST(WriteRegions, GivesCentroidsInTheCoordinatesOfTheFile) {
  const test::TemporaryFolder folder;
  write_regions(folder.file("regions.csv"), two_regions(), Vec3(500000, 5400000, 100));
  EXPECT_EQ(test::content_of(folder.file("regions.csv")),
            "region,label,points,area,border,mean_curvature,gaussian_curvature,centroid_x,centroid_y,centroid_z\n"
            "1,convex,1,2.5,0.1,1.5,nan,500000.25,5400000,100\n"
            "2,valley,1,1,0.1,-2,0,500000,5400000,99\n");
}

}  // namespace
}  // namespace kappa
