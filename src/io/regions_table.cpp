// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/regions_table.hpp"

#include "kappa/core/decimal.hpp"
#include "pace.hpp"
#include "stream.hpp"

namespace kappa {

void write_regions(const std::string& path, const Segmentation& segmentation, const Vec3& origin,
                   const Execution& run) {
  io::begin_progress(run);
  io::write_stream(path, run, [&](std::ostream& out) {
    out << "region,label,points,area,border,mean_curvature,gaussian_curvature,centroid_x,centroid_y,centroid_z\n";
    std::string line;
    io::for_each_row(segmentation.table.size(), stage(run, 0.0, 0.99), [&](std::size_t i) {
      const Region& region = segmentation.table[i];
      line = std::to_string(i + 1) + "," + name(region.label) + "," + std::to_string(region.points);
      const Vec3 centroid = origin + region.centroid;
      for (const double value : {region.area, region.border, region.mean_curvature, region.gaussian_curvature,
                                 centroid.x(), centroid.y(), centroid.z()}) {
        line += ',';
        append_decimal(line, value);
      }
      out << line << '\n';
    });
  });
  io::end_progress(run);
}

}  // namespace kappa
