// SPDX-License-Identifier: BSD-3-Clause
#include "parse.hpp"

#include <algorithm>
#include <cmath>

#include "bytes.hpp"
#include "io/columns.hpp"
#include "io/pace.hpp"
#include "io/text.hpp"
#include "layout.hpp"

namespace kappa::io {

namespace {

const char* const kDamaged = ": it is damaged or cut off; fetch it again from where it came";

/// Numbers of the header that say where the parts of the file are.
struct Contents {
  unsigned minor = 0;
  std::size_t header_size = 0, points_start = 0, points_end = 0;
  std::uint64_t records = 0, points = 0, extended_start = 0, extended = 0, waveform_start = 0;
};

std::string text_of(std::uint64_t value) {
  return std::to_string(value);
}

void check_kind(const FileBytes& file) {
  if (file.bytes.compare(0, 4, "LASF") != 0) {
    refuse(file.path, "begins with " + in_quotes(file.bytes.substr(0, 4)) +
                          " in place of 'LASF': it is no LAS file; give it the extension of what it is");
  }
  if (file.bytes.size() < las::kSmallestHeader) {
    refuse(file.path, "has " + text_of(file.bytes.size()) + " bytes, fewer than the " + text_of(las::kSmallestHeader) +
                          " of a LAS header" + kDamaged);
  }
  const unsigned major = get<std::uint8_t>(file.bytes, las::kMajor), minor = get<std::uint8_t>(file.bytes, las::kMinor);
  if (major != 1 || minor > 4) {
    refuse(file.path, "is LAS version " + text_of(major) + "." + text_of(minor) +
                          ", of which 1.0 to 1.4 are read: convert it to 1.4, with 'pdal translate' for one");
  }
}

void parse_point_format(const FileBytes& file, LasFile& las) {
  const unsigned format = get<std::uint8_t>(file.bytes, las::kFormat);
  if (format & 0xc0) refuse(file.path, laz_remedy(file.path));
  if (format > las::kLastFormat) {
    refuse(file.path,
           "has points of format " + text_of(format) + ", of which 0 to 10 are defined" + std::string(kDamaged));
  }
  las.format = static_cast<int>(format);
  las.record_length = get<std::uint16_t>(file.bytes, las::kRecordLength);
  if (las.record_length < las::point_size(las.format)) {
    refuse(file.path, "has point records of " + text_of(las.record_length) + " bytes where format " + text_of(format) +
                          " needs " + text_of(las::point_size(las.format)) + kDamaged);
  }
}

void parse_grid(const FileBytes& file, LasFile& las) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<std::size_t>(8 * axis);
    las.scale[axis] = get_double(file.bytes, las::kScale + step);
    las.offset[axis] = get_double(file.bytes, las::kOffset + step);
    const std::string name(1, "xyz"[axis]);
    if (!std::isfinite(las.scale[axis]) || las.scale[axis] == 0) {
      refuse(file.path, "its scale of " + name + " is " + std::to_string(las.scale[axis]) +
                            ", with which no coordinate can be had: correct the header");
    }
    if (!std::isfinite(las.offset[axis])) {
      refuse(file.path, "its offset of " + name + " is " + std::to_string(las.offset[axis]) +
                            ", with which no coordinate can be had: correct the header");
    }
  }
}

/// The number of points, which LAS 1.4 has twice.
std::uint64_t point_count(const FileBytes& file, unsigned minor) {
  const std::uint64_t legacy = get<std::uint32_t>(file.bytes, las::kLegacyCount);
  if (minor < 4) return legacy;
  const auto count = get<std::uint64_t>(file.bytes, las::kPointCount);
  if (count != 0 && legacy != 0 && count != legacy) {
    refuse(file.path, "its header promises " + text_of(count) + " points and, in the field of older versions, " +
                          text_of(legacy) + kDamaged);
  }
  return count != 0 ? count : legacy;
}

Contents parse_contents(const FileBytes& file) {
  Contents c;
  c.minor = get<std::uint8_t>(file.bytes, las::kMinor);
  c.header_size = get<std::uint16_t>(file.bytes, las::kHeaderSize);
  c.points_start = get<std::uint32_t>(file.bytes, las::kPointsStart);
  c.records = get<std::uint32_t>(file.bytes, las::kRecordCount);
  if (c.header_size < las::header_size(c.minor)) {
    refuse(file.path, "has a header of " + text_of(c.header_size) + " bytes where LAS 1." + text_of(c.minor) +
                          " needs " + text_of(las::header_size(c.minor)) + kDamaged);
  }
  if (c.points_start < c.header_size || c.points_start > file.bytes.size()) {
    refuse(file.path, "its points should begin at byte " + text_of(c.points_start) + ", which is not between the " +
                          text_of(c.header_size) + " bytes of the header and the " + text_of(file.bytes.size()) +
                          " of the file" + kDamaged);
  }
  c.points = point_count(file, c.minor);
  if (c.minor >= 3) c.waveform_start = get<std::uint64_t>(file.bytes, las::kWaveformStart);
  if (c.minor >= 4) {
    c.extended_start = get<std::uint64_t>(file.bytes, las::kExtendedStart);
    c.extended = get<std::uint32_t>(file.bytes, las::kExtendedCount);
  }
  return c;
}

/// In parts, each given back when it has been copied: so the file is not in memory twice.
void copy_points(const FileBytes& file, const Contents& c, std::string& points, const Execution& run) {
  constexpr std::size_t kPart = std::size_t{1} << 24;
  points.reserve(c.points_end - c.points_start);
  Pace pace(run, c.points_end - c.points_start, kPart);
  for (std::size_t at = c.points_start; at < c.points_end; at += kPart) {
    points += file.bytes.substr(at, std::min(kPart, c.points_end - at));
    file.done_before(at);
    pace.at(points.size());
  }
}

void parse_points(const FileBytes& file, Contents& c, LasFile& las, const Execution& run) {
  const std::size_t held = file.bytes.size() - c.points_start;
  if (c.points > held / las.record_length) {
    refuse(file.path, "promises " + text_of(c.points) + " points of " + text_of(las.record_length) +
                          " bytes but holds " + text_of(held) + " bytes of points (" +
                          text_of(held / las.record_length) + " whole ones)" + kDamaged);
  }
  check_count(file.path, c.points);
  c.points_end = c.points_start + c.points * las.record_length;
  copy_points(file, c, las.points, run);
}

/// The record that begins at `at`, moved behind it; refused if it does not end before `end`.
LasRecord parse_record(const FileBytes& file, std::size_t header_size, std::size_t& at, std::size_t end,
                       const std::string& name) {
  if (at > end || end - at < header_size) {
    refuse(file.path, name + " does not fit between byte " + text_of(at) + " and byte " + text_of(end) + kDamaged);
  }
  LasRecord record;
  record.reserved = get<std::uint16_t>(file.bytes, at);
  record.user_id = file.bytes.substr(at + 2, 16);
  record.id = get<std::uint16_t>(file.bytes, at + 18);
  const bool extended = header_size == las::kExtendedHeader;
  const std::uint64_t size =
      extended ? get<std::uint64_t>(file.bytes, at + 20) : get<std::uint16_t>(file.bytes, at + 20);
  record.description = file.bytes.substr(at + (extended ? 28 : 22), 32);
  at += header_size;
  if (size > end - at) {
    refuse(file.path,
           name + " promises " + text_of(size) + " bytes at byte " + text_of(at) + " of " + text_of(end) + kDamaged);
  }
  record.data = file.bytes.substr(at, size);
  at += size;
  return record;
}

void parse_records(const FileBytes& file, const Contents& c, LasFile& las, const Execution& run) {
  std::size_t at = c.header_size;
  for_each_row(c.records, run, [&](std::uint64_t i) {
    const std::string name = "variable length record " + text_of(i + 1) + " of " + text_of(c.records);
    las.records.push_back(parse_record(file, las::kRecordHeader, at, c.points_start, name));
  });
  las.gap = file.bytes.substr(at, c.points_start - at);
}

std::size_t after_points(const FileBytes& file, const Contents& c, std::uint64_t start, const std::string& name) {
  if (start >= c.points_end && start <= file.bytes.size()) return start;
  refuse(file.path, name + " should begin at byte " + text_of(start) +
                        ", which is not between the end of the points (" + text_of(c.points_end) +
                        ") and that of the file (" + text_of(file.bytes.size()) + ")" + kDamaged);
}

void parse_extended(const FileBytes& file, const Contents& c, LasFile& las, const Execution& run) {
  if (c.extended == 0) return;
  std::size_t at = after_points(file, c, c.extended_start, "the extended variable length records");
  for_each_row(c.extended, run, [&](std::uint64_t i) {
    if (at == c.waveform_start) las.waveform = i;
    const std::string name = "extended variable length record " + text_of(i + 1) + " of " + text_of(c.extended);
    las.extended.push_back(parse_record(file, las::kExtendedHeader, at, file.bytes.size(), name));
  });
}

/// The waveform packets, which LAS 1.3 has in a record that no count speaks of.
void parse_waveform(const FileBytes& file, const Contents& c, LasFile& las) {
  if (las.waveform || c.waveform_start == 0 || !las::has_waveform(las.format)) return;
  const std::string name = "the record of the waveform packets";
  std::size_t at = after_points(file, c, c.waveform_start, name);
  las.waveform = las.extended.size();
  las.extended.push_back(parse_record(file, las::kExtendedHeader, at, file.bytes.size(), name));
}

}  // namespace

LasFile parse_las(const FileBytes& file, const Execution& run) {
  check_kind(file);
  LasFile las;
  parse_point_format(file, las);
  Contents contents = parse_contents(file);
  parse_grid(file, las);
  las.header = file.bytes.substr(0, contents.header_size);
  parse_records(file, contents, las, silent(run));
  parse_points(file, contents, las, run);
  parse_extended(file, contents, las, silent(run));
  parse_waveform(file, contents, las);
  return las;
}

std::string laz_remedy(const std::string& path) {
  return "LAZ (compressed LAS) is not read: expand it with 'pdal translate " + path + " out.las' or 'laszip -i " +
         path + " -o out.las'";
}

}  // namespace kappa::io
