// SPDX-License-Identifier: BSD-3-Clause
#include "las_check.hpp"

#include <cstring>
#include <sstream>
#include <stdexcept>

#include "io/columns.hpp"
#include "io/las/read.hpp"
#include "io/las/write.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"

namespace kappa::fuzz {

namespace {

const char* const kProbe = "fuzz_probe";

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

Scan read(const std::string& bytes) {
  const io::FileBytes file{"fuzz.las", bytes};
  Scan scan = io::read_las(file, {});
  io::finish(file.path, scan);
  return scan;
}

bool equal(const std::vector<LasRecord>& a, const std::vector<LasRecord>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].reserved != b[i].reserved || a[i].user_id != b[i].user_id || a[i].id != b[i].id ||
        a[i].description != b[i].description || a[i].data != b[i].data)
      return false;
  }
  return true;
}

/// Every point record of `before` is the beginning of that of `after`.
bool same_points(const LasFile& before, const LasFile& after) {
  if (before.point_count() != after.point_count() || before.record_length > after.record_length) return false;
  for (std::size_t i = 0; i < before.point_count(); ++i) {
    if (std::memcmp(before.points.data() + i * before.record_length, after.points.data() + i * after.record_length,
                    before.record_length) != 0)
      return false;
  }
  return true;
}

/// The scan written and read again; nothing if LAS 1.4 has no room for it.
std::shared_ptr<Scan> again(const Scan& scan) {
  std::ostringstream out;
  try {
    io::write_las(out, scan, {});
  } catch (const Error& error) {
    require(error.code() == ErrorCode::InvalidArgument, "refused for a wrong reason");
    return nullptr;
  }
  return std::make_shared<Scan>(read(out.str()));
}

void check_copy(const Scan& scan) {
  const auto copy = again(scan);
  if (!copy) return;
  require(same_points(*las_of(scan), *las_of(*copy)), "points differ");
  require(las_of(scan)->record_length == las_of(*copy)->record_length, "points have grown");
  require(equal(las_of(scan)->records, las_of(*copy)->records), "records differ");
  require(equal(las_of(scan)->extended, las_of(*copy)->extended), "extended records differ");
  require(scan.points == copy->points, "coordinates differ");
  require(scan.fields.size() == copy->fields.size(), "fields differ");
}

void check_with_field(Scan scan) {
  if (scan.field(kProbe)) return;
  Field probe{kProbe, Field::Type::Float64, std::vector<double>(scan.points.size())};
  for (std::size_t i = 0; i < probe.values.size(); ++i) probe.values[i] = 0.1 * static_cast<double>(i);
  scan.fields.push_back(probe);
  const auto copy = again(scan);
  if (!copy) return;
  require(same_points(*las_of(scan), *las_of(*copy)), "points differ under a new field");
  require(copy->field(kProbe) && copy->field(kProbe)->values == probe.values, "the new field differs");
}

}  // namespace

bool check_las(const std::string& bytes) {
  Scan scan;
  try {
    scan = read(bytes);
  } catch (const Error&) {
    return false;
  }
  looks_geographic(scan);
  scan.units.z_scale();
  check_copy(scan);
  check_with_field(std::move(scan));
  return true;
}

}  // namespace kappa::fuzz
