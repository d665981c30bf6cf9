// SPDX-License-Identifier: BSD-3-Clause
#include "write.hpp"

// LAS 1.4: header, variable length records, points, extended records.
#include <algorithm>
#include <limits>

#include "bytes.hpp"
#include "io/pace.hpp"
#include "kappa/core/error.hpp"
#include "layout.hpp"
#include "output.hpp"
#include "positions.hpp"

namespace kappa::io {

namespace {

/// What the header says about the points.
struct Statistics {
  std::uint64_t points = 0;
  LasRange range;
  std::array<std::uint64_t, las::kMaxReturns> returns{};

  void add(const LasPosition& position, const std::string& record, int format) {
    if (points++ == 0) range = {position, position};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.min[axis] = std::min(range.min[axis], position[axis]);
      range.max[axis] = std::max(range.max[axis], position[axis]);
    }
    const unsigned number = get<std::uint8_t>(record, 14) & (format >= las::kFirstFormat14 ? 15u : 7u);
    if (number > 0) ++returns[number - 1];
  }
};

void write_bytes(std::ostream& out, const std::string& bytes) {
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string record_bytes(const LasRecord& record, bool extended) {
  std::string bytes(extended ? las::kExtendedHeader : las::kRecordHeader, '\0');
  put(bytes, 0, record.reserved);
  bytes.replace(2, 16, record.user_id);
  put(bytes, 18, record.id);
  if (extended) {
    put(bytes, 20, static_cast<std::uint64_t>(record.data.size()));
  } else {
    put(bytes, 20, static_cast<std::uint16_t>(record.data.size()));
  }
  bytes.replace(extended ? 28 : 22, las::kTextSize, record.description);
  return bytes + record.data;
}

/// The bits of the global encoding that version 1.`minor` has defined.
std::uint16_t defined_encoding(unsigned minor) {
  constexpr std::uint16_t kBits[] = {0, 0, 1, 15, 0xffff};
  return kBits[minor];
}

/// The source's header, or a new one, in the layout of LAS 1.4, with what does not depend on the points.
std::string header_14(const LasFile& frame) {
  constexpr std::uint16_t kWkt = 16;  // formats 6 to 10 demand it, whether or not there is a coordinate system
  std::string header = frame.header;
  if (header.empty()) {
    header.assign(las::kHeader14, '\0');
    put(header, las::kGlobalEncoding, kWkt);
    header.replace(las::kSoftware, 5, "kappa");
  } else {
    const unsigned minor = get<std::uint8_t>(header, las::kMinor);
    const auto encoding = get<std::uint16_t>(header, las::kGlobalEncoding);
    header.insert(las::header_size(minor), las::kHeader14 - las::header_size(minor), '\0');
    put(header, las::kGlobalEncoding, static_cast<std::uint16_t>(encoding & defined_encoding(minor)));
  }
  header.replace(0, 4, "LASF");
  put<std::uint8_t>(header, las::kMajor, 1);
  put<std::uint8_t>(header, las::kMinor, 4);
  put(header, las::kHeaderSize, static_cast<std::uint16_t>(header.size()));
  put(header, las::kRecordCount, static_cast<std::uint32_t>(frame.records.size()));
  put(header, las::kFormat, static_cast<std::uint8_t>(frame.format));
  put(header, las::kRecordLength, static_cast<std::uint16_t>(frame.record_length));
  return header;
}

void put_grid(std::string& header, const LasFile& frame, const LasRange& range) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto world = [&](std::int32_t stored) { return stored * frame.scale[axis] + frame.offset[axis]; };
    put_double(header, las::kScale + 8 * a, frame.scale[axis]);
    put_double(header, las::kOffset + 8 * a, frame.offset[axis]);
    const auto [low, high] = std::minmax({world(range.min[a]), world(range.max[a])});
    put_double(header, las::kBounds + 16 * a, high);
    put_double(header, las::kBounds + 16 * a + 8, low);
  }
}

/// Counts of points, and those of older versions where they are allowed and enough.
void put_counts(std::string& header, const LasFile& frame, const Statistics& statistics) {
  const bool legacy =
      frame.format < las::kFirstFormat14 && statistics.points <= std::numeric_limits<std::uint32_t>::max();
  const auto small = [&](std::uint64_t count) { return static_cast<std::uint32_t>(legacy ? count : 0); };
  put(header, las::kPointCount, statistics.points);
  put(header, las::kLegacyCount, small(statistics.points));
  for (std::size_t i = 0; i < las::kMaxReturns; ++i) {
    put(header, las::kReturns + 8 * i, statistics.returns[i]);
    if (i < 5) put(header, las::kLegacyReturns + 4 * i, small(statistics.returns[i]));
  }
}

void put_extended(std::string& header, const LasFile& frame, std::uint64_t start) {
  put(header, las::kExtendedStart, frame.extended.empty() ? std::uint64_t{0} : start);
  put(header, las::kExtendedCount, static_cast<std::uint32_t>(frame.extended.size()));
  std::uint64_t waveform = 0;
  for (std::size_t i = 0; i < frame.extended.size(); ++i) {
    if (frame.waveform == i) waveform = start;
    start += las::kExtendedHeader + frame.extended[i].data.size();
  }
  put(header, las::kWaveformStart, waveform);
}

/// What stands between the header and the first point.
std::string before_points(const LasFile& frame) {
  std::string bytes;
  for (const LasRecord& record : frame.records) bytes += record_bytes(record, false);
  return bytes + frame.gap;
}

void check_sizes(const std::string& header, const std::string& before) {
  if (header.size() <= std::numeric_limits<std::uint16_t>::max() &&
      header.size() + before.size() <= std::numeric_limits<std::uint32_t>::max())
    return;
  throw Error(ErrorCode::InvalidArgument, "the header and records before the points of its LAS file take " +
                                              std::to_string(header.size() + before.size()) +
                                              " bytes, more than LAS 1.4 allows: write .pcd or .ply");
}

Statistics write_points(std::ostream& out, const Scan& scan, const LasOutput& plan, const Execution& run) {
  const LasPositions positions(scan, plan.frame);
  Statistics statistics;
  const LasFile* const las = las_of(scan);
  std::string row;
  for_each_row(scan.points.size(), run, [&](std::size_t i) {
    if (las) {
      row.assign(las->points, i * las->record_length, las->record_length);
    } else {
      row = plan.blank;
    }
    row.resize(plan.frame.record_length);
    const LasPosition position = positions(i);
    for (std::size_t axis = 0; axis < 3; ++axis) put_int32(row, 4 * axis, position[axis]);
    for (const LasColumn& column : plan.columns) store(row.data(), column.dimension, column.value(scan, i));
    statistics.add(position, row, plan.frame.format);
    write_bytes(out, row);
  });
  return statistics;
}

}  // namespace

void write_las(std::ostream& out, const Scan& scan, const Execution& run) {
  check_records(scan);
  const LasOutput plan = plan_las(scan, stage(run, 0.0, 0.3));
  std::string header = header_14(plan.frame);
  const std::string before = before_points(plan.frame);
  check_sizes(header, before);
  const std::size_t points_start = header.size() + before.size();
  put(header, las::kPointsStart, static_cast<std::uint32_t>(points_start));
  // The counts and the extent in the header are known only after the points.
  const auto begin = out.tellp();
  write_bytes(out, header + before);
  const Statistics statistics = write_points(out, scan, plan, stage(run, 0.3, 1.0));
  for (const LasRecord& record : plan.frame.extended) write_bytes(out, record_bytes(record, true));
  put_grid(header, plan.frame, statistics.range);
  put_counts(header, plan.frame, statistics);
  put_extended(header, plan.frame, points_start + statistics.points * plan.frame.record_length);
  out.seekp(begin);
  write_bytes(out, header);
  out.seekp(0, std::ios::end);
}

}  // namespace kappa::io
