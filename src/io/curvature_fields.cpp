// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "kappa/io/write.hpp"
#include "writers.hpp"

namespace kappa {

namespace {

using Value = double (*)(const CurvatureSample&);

struct Entry {
  const char* name;
  Field::Type type;
  Value value;
};

constexpr Field::Type kReal = Field::Type::Float64;

constexpr Entry kEntries[] = {
    {"mean_curvature", kReal, [](const CurvatureSample& s) { return s.k.mean; }},
    {"gaussian_curvature", kReal, [](const CurvatureSample& s) { return s.k.gaussian; }},
    {"k_min", kReal, [](const CurvatureSample& s) { return s.k.k_min; }},
    {"k_max", kReal, [](const CurvatureSample& s) { return s.k.k_max; }},
    {"dir_min_x", kReal, [](const CurvatureSample& s) { return s.k.dir_min.x(); }},
    {"dir_min_y", kReal, [](const CurvatureSample& s) { return s.k.dir_min.y(); }},
    {"dir_min_z", kReal, [](const CurvatureSample& s) { return s.k.dir_min.z(); }},
    {"dir_max_x", kReal, [](const CurvatureSample& s) { return s.k.dir_max.x(); }},
    {"dir_max_y", kReal, [](const CurvatureSample& s) { return s.k.dir_max.y(); }},
    {"dir_max_z", kReal, [](const CurvatureSample& s) { return s.k.dir_max.z(); }},
    {"mu0", kReal, [](const CurvatureSample& s) { return s.mu0; }},
    {"mu1", kReal, [](const CurvatureSample& s) { return s.mu1; }},
    {"mu2", kReal, [](const CurvatureSample& s) { return s.mu2; }},
    {"area", kReal, [](const CurvatureSample& s) { return s.area; }},
    {"coverage", kReal, [](const CurvatureSample& s) { return s.coverage; }},
    {"face_count", Field::Type::UInt32, [](const CurvatureSample& s) { return static_cast<double>(s.face_count); }},
    {"status", Field::Type::UInt8, [](const CurvatureSample& s) { return static_cast<double>(s.k.status); }},
};

template <class T>
Field field_of(const char* name, Field::Type type, const std::vector<T>& values) {
  Field field;
  field.name = name;
  field.type = type;
  field.values.reserve(values.size());
  for (const T value : values) field.values.push_back(static_cast<double>(value));
  return field;
}

constexpr Entry kError = {"std_error", kReal, [](const CurvatureSample& s) { return s.std_error; }};
constexpr Entry kScale[] = {
    {"radius", kReal, [](const CurvatureSample& s) { return s.radius; }},
    {"order", Field::Type::UInt8, [](const CurvatureSample& s) { return static_cast<double>(s.order); }}};

std::vector<Entry> entries_of(const CurvatureField& field) {
  std::vector<Entry> entries(std::begin(kEntries), std::end(kEntries));
  if (field.order != 1) entries.push_back(kError);
  if (field.own_scales()) entries.insert(entries.end(), std::begin(kScale), std::end(kScale));
  return entries;
}

}  // namespace

std::vector<Field> curvature_fields(const CurvatureField& field, const std::string& suffix) {
  const std::vector<Entry> entries = entries_of(field);
  const std::size_t count = field.samples.size();
  std::vector<Field> fields(entries.size());
  for (std::size_t c = 0; c < fields.size(); ++c) {
    fields[c].name = entries[c].name + suffix;
    fields[c].type = entries[c].type;
    fields[c].values.resize(count);
  }
  constexpr std::size_t kNear = 256;  // samples that stay at hand for all of their columns
  for (std::size_t begin = 0; begin < count; begin += kNear) {
    const std::size_t end = std::min(count, begin + kNear);
    for (std::size_t c = 0; c < fields.size(); ++c) {
      for (std::size_t i = begin; i < end; ++i) fields[c].values[i] = entries[c].value(field.samples[i]);
    }
  }
  return fields;
}

std::vector<Field> segment_fields(const Segmentation& segmentation) {
  return {field_of("label", Field::Type::UInt8, segmentation.labels),
          field_of("region", Field::Type::UInt32, segmentation.regions)};
}

std::string radius_suffix(double radius) {
  std::string suffix = "_r";
  io::append_decimal(suffix, radius);
  return suffix;
}

}  // namespace kappa
