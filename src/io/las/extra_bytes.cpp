// SPDX-License-Identifier: BSD-3-Clause
#include "extra_bytes.hpp"

#include <cmath>

#include "bytes.hpp"
#include "io/file_bytes.hpp"
#include "layout.hpp"

namespace kappa::io {

namespace {

// Positions in a descriptor.
constexpr std::size_t kType = 2, kOptions = 3, kName = 4, kNoData = 40, kMin = 64, kMax = 88, kScale = 112,
                      kOffset = 136;
constexpr unsigned kHasNoData = 1, kHasMin = 2, kHasMax = 4, kHasScale = 8, kHasOffset = 16;
constexpr unsigned kTypes = 10;  // and as many pairs and triples of them

constexpr Scalar kScalars[kTypes] = {Scalar::UInt8, Scalar::Int8,   Scalar::UInt16, Scalar::Int16,   Scalar::UInt32,
                                     Scalar::Int32, Scalar::UInt64, Scalar::Int64,  Scalar::Float32, Scalar::Float64};

/// Type of the numbers in a descriptor that has values of `type`.
Scalar widened(Scalar type) {
  if (is_floating(type)) return Scalar::Float64;
  const bool is_signed =
      type == Scalar::Int8 || type == Scalar::Int16 || type == Scalar::Int32 || type == Scalar::Int64;
  return is_signed ? Scalar::Int64 : Scalar::UInt64;
}

std::string name_in(std::string_view field) {
  return std::string(field.substr(0, std::min(field.find('\0'), field.size())));
}

void parse_numbers(std::string_view bytes, unsigned options, ExtraBytes& extra) {
  for (std::size_t i = 0; i < extra.values; ++i) {
    if (options & kHasNoData)
      extra.no_data[i] = load(bytes.data() + kNoData + 8 * i, widened(*extra.type), ByteOrder::Little);
    if (options & kHasScale) extra.scale[i] = get_double(bytes, kScale + 8 * i);
    if (options & kHasOffset) extra.offset[i] = get_double(bytes, kOffset + 8 * i);
  }
}

ExtraBytes parse_descriptor(const std::string& path, std::string_view bytes) {
  ExtraBytes extra;
  extra.name = name_in(bytes.substr(kName, kExtraNameSize));
  const unsigned type = get<std::uint8_t>(bytes, kType), options = get<std::uint8_t>(bytes, kOptions);
  if (type == 0) {
    extra.values = options;
    return extra;
  }
  if (type > 3 * kTypes) {
    refuse(path, "its record of the extra bytes has a value of type " + std::to_string(type) +
                     ", of which 0 to 30 are defined: it is damaged; remove the record or fetch the file again");
  }
  extra.type = kScalars[(type - 1) % kTypes];
  extra.values = (type - 1) / kTypes + 1;
  parse_numbers(bytes, options, extra);
  for (std::size_t i = 0; i < extra.values; ++i) {
    if (std::isfinite(extra.scale[i]) && extra.scale[i] != 0 && std::isfinite(extra.offset[i])) continue;
    refuse(path, "its record of the extra bytes has a scale of " + std::to_string(extra.scale[i]) +
                     " and an offset of " + std::to_string(extra.offset[i]) +
                     ", with which no value can be had: correct the record");
  }
  return extra;
}

}  // namespace

LasRecord* extra_bytes_record(LasFile& las) {
  for (std::vector<LasRecord>* records : {&las.records, &las.extended}) {
    for (LasRecord& record : *records) {
      if (record.is("LASF_Spec", kExtraBytesRecord)) return &record;
    }
  }
  return nullptr;
}

const LasRecord* extra_bytes_record(const LasFile& las) {
  return extra_bytes_record(const_cast<LasFile&>(las));
}

std::vector<ExtraBytes> parse_extra_bytes(const std::string& path, const LasFile& las) {
  std::vector<ExtraBytes> all;
  const LasRecord* record = extra_bytes_record(las);
  if (!record) return all;
  const std::string_view data = record->data;
  if (data.size() % kDescriptorSize != 0) {
    refuse(path, "its record of the extra bytes has " + std::to_string(data.size()) + " bytes, no multiple of " +
                     std::to_string(kDescriptorSize) + ": it is damaged; remove the record or fetch the file again");
  }
  const std::size_t extra = las.record_length - las::point_size(las.format);
  std::size_t described = 0;
  for (std::size_t at = 0; at < data.size(); at += kDescriptorSize) {
    all.push_back(parse_descriptor(path, data.substr(at, kDescriptorSize)));
    described += all.back().bytes();
  }
  if (described > extra) {
    refuse(path, "its record of the extra bytes describes " + std::to_string(described) +
                     " bytes a point where the points have " + std::to_string(extra) +
                     ": it is damaged; remove the record or fetch the file again");
  }
  return all;
}

std::string descriptor(const std::string& name, Scalar type) {
  std::string bytes(kDescriptorSize, '\0');
  for (unsigned i = 0; i < kTypes; ++i) {
    if (kScalars[i] == type) put(bytes, kType, static_cast<std::uint8_t>(i + 1));
  }
  return bytes.replace(kName, name.size(), name);
}

std::string undescribed(const std::string& name, std::size_t bytes) {
  std::string text(kDescriptorSize, '\0');
  put(text, kOptions, static_cast<std::uint8_t>(bytes));
  return text.replace(kName, name.size(), name);
}

void forget_range(LasRecord& record, std::size_t position) {
  const std::size_t at = position * kDescriptorSize;
  const unsigned options = get<std::uint8_t>(record.data, at + kOptions);
  if (get<std::uint8_t>(record.data, at + kType) == 0) return;
  put(record.data, at + kOptions, static_cast<std::uint8_t>(options & ~(kHasMin | kHasMax)));
  record.data.replace(at + kMin, kMax + 24 - kMin, kMax + 24 - kMin, '\0');
}

}  // namespace kappa::io
