// SPDX-License-Identifier: BSD-3-Clause
#include "names.hpp"

#include <string_view>

namespace kappa::io {

namespace {

constexpr std::string_view kNames[][2] = {{"mean_curvature", "Mean_Curvature"},
                                          {"gaussian_curvature", "Gauss_Curvature"},
                                          {"k_min", "Minimum_Curvature"},
                                          {"k_max", "Maximum_Curvature"}};
constexpr std::string_view kDirections[] = {"dir_min", "dir_max"};
constexpr std::string_view kComponents[] = {"_x", "_y", "_z"};

/// What follows `stem` in `name` if that is nothing or a suffix "_...".
bool split(std::string_view name, std::string_view stem, std::string_view& suffix) {
  if (name.substr(0, stem.size()) != stem) return false;
  suffix = name.substr(stem.size());
  return suffix.empty() || suffix[0] == '_';
}

std::string translate(const std::string& name, std::size_t from, std::size_t to) {
  for (const auto& pair : kNames) {
    std::string_view suffix;
    if (split(name, pair[from], suffix)) return std::string(pair[to]).append(suffix);
  }
  return name;
}

}  // namespace

std::string to_vtk_name(const std::string& name) {
  return translate(name, 0, 1);
}

std::string from_vtk_name(const std::string& name) {
  return translate(name, 1, 0);
}

std::string direction_of(const std::string& component) {
  for (const std::string_view direction : kDirections) {
    for (const std::string_view part : kComponents) {
      std::string_view suffix;
      const std::string stem = std::string(direction).append(part);
      if (split(component, stem, suffix)) return std::string(direction).append(suffix);
    }
  }
  return {};
}

std::string component_name(const std::string& name, int component) {
  const std::string_view part = kComponents[component];
  for (const std::string_view direction : kDirections) {
    std::string_view suffix;
    if (split(name, direction, suffix)) return std::string(direction).append(part).append(suffix);
  }
  return std::string(name).append(part);
}

}  // namespace kappa::io
