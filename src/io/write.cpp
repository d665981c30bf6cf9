// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/write.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "file_bytes.hpp"
#include "format_table.hpp"
#include "kappa/core/checks.hpp"
#include "kappa/core/error.hpp"
#include "pace.hpp"
#include "safe_name.hpp"
#include "scalar.hpp"
#include "stream.hpp"

namespace kappa {

namespace fs = std::filesystem;

namespace {

const io::Format& format_to_write(const std::string& path) {
  const io::Format* const format = io::format_of(path);
  if (format && format->write) return *format;
  throw Error(ErrorCode::FileWrite, "'" + path + "': files of extension '" + io::extension_of(path) +
                                        "' are not written: use one of " + io::listed(writable_extensions()));
}

/// Extensions of those formats that are written and meant.
std::vector<std::string> extensions_where(bool (*is_meant)(const io::Format&)) {
  std::vector<std::string> names;
  for (const io::Format& format : io::format_table()) {
    if (format.write && is_meant(format)) names.push_back(format.extension);
  }
  return names;
}

void check_field(const Field& field, std::size_t points, const Execution& run) {
  check_one_each(field.values.size(), "'" + field.name + "' value", points, "point");
  if (field.type == Field::Type::Float64) return;
  io::for_each_row(points, run, [&](std::size_t i) {
    if (io::fits(field.values[i], field.type)) return;
    throw Error(ErrorCode::InvalidArgument, "field '" + field.name + "' holds " + std::to_string(field.values[i]) +
                                                ", which is not of its type " + io::type_name(field.type));
  });
}

void check_names(const Scan& scan) {
  std::set<std::string> names = {"x", "y", "z", "nx", "ny", "nz", "normal_x", "normal_y", "normal_z"};
  for (const Field& field : scan.fields) {
    if (field.name.empty() || !names.insert(io::safe_name(field.name)).second) {
      throw Error(ErrorCode::InvalidArgument, "a field cannot be called '" + field.name + "': the name is taken");
    }
  }
}

void check_faces(const Scan& scan, const Execution& run) {
  const std::vector<Index>& corners = scan.faces.corners();
  const std::size_t points = scan.points.size();
  io::for_each_row(corners.size(), run, [&](std::size_t c) {
    if (corners[c] < points) return;
    throw Error(ErrorCode::InvalidArgument, "a face has vertex " + std::to_string(corners[c]) + " of " +
                                                std::to_string(points) + ": indices must be below that");
  });
}

void check_scan(const Scan& scan, const Execution& run) {
  const std::size_t points = scan.points.size();
  if (!scan.normals.empty()) check_one_each(scan.normals.size(), "normal", points, "point");
  for (const Field& field : scan.fields) check_field(field, points, run);
  check_names(scan);
  if (scan.is_organised()) check_one_each(scan.width * scan.height, "grid cell", points, "point");
  check_faces(scan, run);
}

}  // namespace

void write_scan(const std::string& path, const Scan& scan, const Execution& run) {
  const io::Format& format = format_to_write(path);
  io::begin_progress(run);
  check_scan(scan, io::silent(run));
  io::write_stream(path, run, [&](std::ostream& out) { format.write(out, scan, stage(run, 0.0, 0.99)); });
  io::end_progress(run);
}

const std::vector<std::string>& writable_extensions() {
  static const std::vector<std::string> extensions = extensions_where([](const io::Format&) { return true; });
  return extensions;
}

const std::vector<std::string>& writable_mesh_extensions() {
  static const std::vector<std::string> extensions =
      extensions_where([](const io::Format& format) { return format.holds_faces; });
  return extensions;
}

void check_writable(const std::string& path) {
  format_to_write(path);
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw Error(ErrorCode::FileWrite, "'" + path + "' cannot be written: there is no folder '" + folder + "'");
  }
  if (fs::is_directory(path, error)) {
    throw Error(ErrorCode::FileWrite, "'" + path + "' cannot be written: it is a folder");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::FileWrite, "'" + path + "' cannot be written: " + std::strerror(errno));
  }
}

}  // namespace kappa
