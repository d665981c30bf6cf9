// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/regions_table.hpp"

#include "kappa/core/decimal.hpp"
#include "stream.hpp"

namespace kappa {

void write_regions(const std::string& path, const Segmentation& segmentation, const Vec3& origin) {
  io::write_stream(path, [&](std::ostream& out) {
    out << "region,label,points,area,border,mean_curvature,gaussian_curvature,centroid_x,centroid_y,centroid_z\n";
    std::string line;
    for (std::size_t i = 0; i < segmentation.table.size(); ++i) {
      const Region& region = segmentation.table[i];
      line = std::to_string(i + 1) + "," + label_name(region.label) + "," + std::to_string(region.points);
      const Vec3 centroid = origin + region.centroid;
      for (const double value : {region.area, region.border, region.mean_curvature, region.gaussian_curvature,
                                 centroid.x(), centroid.y(), centroid.z()}) {
        line += ',';
        append_decimal(line, value);
      }
      out << line << '\n';
    }
  });
}

}  // namespace kappa
