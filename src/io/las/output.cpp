// SPDX-License-Identifier: BSD-3-Clause
#include "output.hpp"

#include <algorithm>

#include "io/pace.hpp"
#include "io/safe_name.hpp"
#include "kappa/core/error.hpp"
#include "layout.hpp"
#include "positions.hpp"

namespace kappa::io {

namespace {

constexpr std::size_t kLargestRecord = 65535;
constexpr char kAxes[] = {'x', 'y', 'z'};

bool same(double a, double b) {
  return a == b || (a != a && b != b);
}

const LasDimension* find(const std::vector<LasDimension>& dimensions, const std::string& name) {
  const auto found =
      std::find_if(dimensions.begin(), dimensions.end(), [&](const LasDimension& d) { return d.name == name; });
  return found == dimensions.end() ? nullptr : &*found;
}

/// Whether the attribute holds all values of the field as they are.
bool holds(const LasDimension& dimension, const Field& field, std::string record, const Execution& run) {
  return !any_row(field.values.size(), run, [&](std::size_t i) {
    const double value = field.values[i];
    return !(store(record.data(), dimension, value) && same(load(record.data(), dimension), value));
  });
}

/// The format that has places for the colours of the scan.
int choose_format(const Scan& scan, const Execution& run) {
  constexpr int kPlain = 6, kColour = 7, kInfrared = 8;
  const std::vector<LasDimension> all = standard_dimensions(kInfrared);
  const std::string record(las::point_size(kInfrared), '\0');
  const auto has = [&](const char* name) {
    const Field* field = scan.field(name);
    return field && holds(*find(all, name), *field, record, run);
  };
  if (!has("red") || !has("green") || !has("blue")) return kPlain;
  return has("nir") ? kInfrared : kColour;
}

std::string blank_record(const Scan& scan, int format) {
  std::string record(las::point_size(format), '\0');
  for (const LasDimension& d : standard_dimensions(format)) {
    const bool counts_returns = d.name == "return_number" || d.name == "number_of_returns";
    if (counts_returns && !scan.field(d.name)) store(record.data(), d, 1);
  }
  return record;
}

/// Builds the output of one scan.
class Planner {
 public:
  Planner(const Scan& scan, const Execution& run) : scan_(scan), run_(run) {}

  LasOutput plan() {
    if (las_) {
      copy_frame(*las_);
    } else {
      make_frame();
    }
    const std::size_t fields = scan_.fields.size(), axes = scan_.normals.empty() ? 0 : 3;
    for (std::size_t k = 0; k < fields; ++k) place(scan_.fields[k], part(run_, k, fields + axes));
    for (std::size_t k = 0; k < axes; ++k) place_normals(static_cast<int>(k), part(run_, fields + k, fields + axes));
    if (!descriptors_.empty()) describe();
    return std::move(out_);
  }

 private:
  void copy_frame(const LasFile& source) {
    out_.frame.header = source.header;
    out_.frame.format = source.format;
    out_.frame.record_length = source.record_length;
    out_.frame.scale = source.scale;
    out_.frame.offset = source.offset;
    out_.frame.records = source.records;
    out_.frame.gap = source.gap;
    out_.frame.extended = source.extended;
    out_.frame.waveform = source.waveform;
    known_ = dimensions_of("LAS output", source, silent(run_));
  }

  void make_frame() {
    out_.frame.format = choose_format(scan_, silent(run_));
    out_.frame.record_length = las::point_size(out_.frame.format);
    choose_grid(scan_, out_.frame, silent(run_));
    known_ = standard_dimensions(out_.frame.format);
    out_.blank = blank_record(scan_, out_.frame.format);
  }

  void place(const Field& field, const Execution& run) {
    const LasDimension* known = find(known_, safe_name(field.name));
    if (known && !las_ && !holds(*known, field, out_.blank, run)) known = nullptr;
    add(known, field.name, scalar_of(field.type), {&field, 0, {}}, run);
  }

  void place_normals(int axis, const Execution& run) {
    const std::string name = std::string("n") + kAxes[axis];
    add(find(known_, name), name, Scalar::Float64, {nullptr, axis, {}}, run);
  }

  void add(const LasDimension* known, const std::string& name, Scalar type, LasColumn column, const Execution& run) {
    if (!known) {
      column.dimension = append(safe_name(name), type);
    } else {
      column.dimension = *known;
      if (las_ && !changes(column, name, run)) return;
      if (known->descriptor) forget_range(*extra_bytes_record(out_.frame), *known->descriptor);
    }
    out_.columns.push_back(std::move(column));
  }

  /// Whether the values differ from those of the source, which must be able to hold them.
  bool changes(const LasColumn& column, const std::string& name, const Execution& run) const {
    bool changed = false;
    const LasFile& source = *las_;
    std::string record(source.record_length, '\0');
    for_each_row(scan_.points.size(), run, [&](std::size_t i) {
      const double value = column.value(scan_, i);
      if (same(load(source.points.data() + i * source.record_length, column.dimension), value)) return;
      changed = true;
      if (store(record.data(), column.dimension, value)) return;
      throw Error(ErrorCode::InvalidArgument, "field '" + name + "' holds " + std::to_string(value) + " at point " +
                                                  std::to_string(i) +
                                                  ", which the attribute of that name of its LAS file cannot hold: "
                                                  "rename the field");
    });
    return changed;
  }

  LasDimension append(const std::string& name, Scalar type) {
    if (name.size() > kExtraNameSize) {
      throw Error(ErrorCode::InvalidArgument,
                  "a field cannot be called '" + name + "' in LAS, where names have at most " +
                      std::to_string(kExtraNameSize) + " characters: shorten it, or write .ply");
    }
    if (descriptors_.empty()) cover_undescribed();
    const LasDimension d = extra_dimension(name, type, out_.frame.record_length);
    descriptors_ += descriptor(name, type);
    out_.frame.record_length += size_of(type);
    if (out_.frame.record_length > kLargestRecord) too_many();
    return d;
  }

  /// Descriptors count from the end of the standard attributes: bytes without one must get one first.
  void cover_undescribed() {
    std::size_t bytes = out_.frame.record_length - las::point_size(out_.frame.format);
    for (const ExtraBytes& extra : parse_extra_bytes("LAS output", out_.frame)) bytes -= extra.bytes();
    constexpr std::size_t kMost = 255;
    for (; bytes > 0; bytes -= std::min(bytes, kMost))
      descriptors_ += undescribed("undescribed", std::min(bytes, kMost));
  }

  void describe() {
    LasRecord* record = extra_bytes_record(out_.frame);
    if (!record) {
      out_.frame.records.push_back({0, "LASF_Spec", kExtraBytesRecord, "Extra bytes", ""});
      record = &out_.frame.records.back();
      record->user_id.resize(16);
      record->description.resize(las::kTextSize);
    }
    record->data += descriptors_;
    if (record->data.size() > kLargestRecord) too_many();
  }

  [[noreturn]] static void too_many() {
    throw Error(ErrorCode::InvalidArgument,
                "the points have more attributes than LAS can hold: remove fields, or write .ply");
  }

  const Scan& scan_;
  const Execution& run_;
  const LasFile* const las_ = las_of(scan_);  ///< that the scan came from, if any
  LasOutput out_;
  std::vector<LasDimension> known_;  ///< attributes that the records have without further ones
  std::string descriptors_;          ///< of the attributes that are added
};

}  // namespace

LasOutput plan_las(const Scan& scan, const Execution& run) {
  return Planner(scan, run).plan();
}

}  // namespace kappa::io
