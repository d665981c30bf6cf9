// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/fields.hpp"

#include "kappa/core/checks.hpp"
#include "kappa/core/decimal.hpp"

namespace kappa {

namespace {

/// Writes a value of each of some samples.
using Take = void (*)(const CurvatureSample* const* from, std::size_t count, double* to);

struct Entry {
  const char* name;
  Field::Type type;
  Take take;
};

template <auto kMember>
double of_sample(const CurvatureSample& s) {
  return static_cast<double>(s.*kMember);
}

template <auto kMember>
double of_curvature(const CurvatureSample& s) {
  return static_cast<double>(s.k.*kMember);
}

template <auto kMember, int kAxis>
double of_direction(const CurvatureSample& s) {
  return (s.k.*kMember)[kAxis];
}

template <double (*kValue)(const CurvatureSample&)>
void take(const CurvatureSample* const* from, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = kValue(*from[i]);
}

constexpr Field::Type kReal = Field::Type::Float64;

constexpr Entry kEntries[] = {
    {"mean_curvature", kReal, take<of_curvature<&Curvatures::mean>>},
    {"gaussian_curvature", kReal, take<of_curvature<&Curvatures::gaussian>>},
    {"k_min", kReal, take<of_curvature<&Curvatures::k_min>>},
    {"k_max", kReal, take<of_curvature<&Curvatures::k_max>>},
    {"dir_min_x", kReal, take<of_direction<&Curvatures::dir_min, 0>>},
    {"dir_min_y", kReal, take<of_direction<&Curvatures::dir_min, 1>>},
    {"dir_min_z", kReal, take<of_direction<&Curvatures::dir_min, 2>>},
    {"dir_max_x", kReal, take<of_direction<&Curvatures::dir_max, 0>>},
    {"dir_max_y", kReal, take<of_direction<&Curvatures::dir_max, 1>>},
    {"dir_max_z", kReal, take<of_direction<&Curvatures::dir_max, 2>>},
    {"mu0", kReal, take<of_sample<&CurvatureSample::mu0>>},
    {"mu1", kReal, take<of_sample<&CurvatureSample::mu1>>},
    {"mu2", kReal, take<of_sample<&CurvatureSample::mu2>>},
    {"area", kReal, take<of_sample<&CurvatureSample::area>>},
    {"coverage", kReal, take<of_sample<&CurvatureSample::coverage>>},
    {"face_count", Field::Type::UInt32, take<of_sample<&CurvatureSample::face_count>>},
    {"status", Field::Type::UInt8, take<of_curvature<&Curvatures::status>>},
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

constexpr Entry kError = {"std_error", kReal, take<of_sample<&CurvatureSample::std_error>>};
constexpr Entry kScale[] = {{"radius", kReal, take<of_sample<&CurvatureSample::radius>>},
                            {"order", Field::Type::UInt8, take<of_sample<&CurvatureSample::order>>}};

std::vector<Entry> entries_of(const CurvatureField& field) {
  std::vector<Entry> entries(std::begin(kEntries), std::end(kEntries));
  if (field.order != 1) entries.push_back(kError);
  if (field.own_scales()) entries.insert(entries.end(), std::begin(kScale), std::end(kScale));
  return entries;
}

}  // namespace

std::vector<Field> curvature_fields(const CurvatureField& field, const std::string& suffix,
                                    const std::vector<Index>& order, const Execution& run) {
  const std::size_t count = field.samples.size();
  if (!order.empty()) check_one_each(order.size(), "place", count, "sample");
  const std::vector<Entry> entries = entries_of(field);
  std::vector<Field> fields(entries.size());
  parallel_for(fields.size(), 1, stage(run, 0.0, 0.0), [&](std::size_t c, std::size_t, int) {
    fields[c].name = entries[c].name + suffix;
    fields[c].type = entries[c].type;
    fields[c].values.resize(count);
  });
  constexpr std::size_t kNear = 256;  // samples that stay at hand for all of their columns
  parallel_for(count, kNear, run, [&](std::size_t begin, std::size_t end, int) {
    const CurvatureSample* near[kNear];
    for (std::size_t i = begin; i < end; ++i) near[i - begin] = &field.samples[order.empty() ? i : order[i]];
    for (std::size_t c = 0; c < fields.size(); ++c) entries[c].take(near, end - begin, &fields[c].values[begin]);
  });
  return fields;
}

std::vector<Field> segment_fields(const Segmentation& segmentation) {
  return {field_of("label", Field::Type::UInt8, segmentation.labels),
          field_of("region", Field::Type::UInt32, segmentation.regions)};
}

std::string radius_suffix(double radius) {
  return "_r" + decimal(radius);
}

}  // namespace kappa
