// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/read.hpp"

#include "columns.hpp"
#include "format_table.hpp"
#include "kappa/core/error.hpp"
#include "las/parse.hpp"
#include "pace.hpp"

namespace kappa {

namespace {

/// What to do about a known format that is not read.
std::string remedy(const std::string& extension, const std::string& path) {
  if (extension == ".laz") return io::laz_remedy(path);
  if (extension == ".e57") {
    return "E57 is not read: convert it with 'pdal translate " + path +
           " out.las', or to .ply or .las with CloudCompare";
  }
  if (extension == ".vol")
    return "voxel volumes are not read by this version: extract a surface and save it as .ply or .obj";
  if (extension == ".vtk") return "legacy VTK files are not read: save it as .vtp, with ParaView for one";
  return "the extension '" + extension + "' is not known: convert it to one of " + io::listed(readable_extensions());
}

}  // namespace

Scan read_scan(const std::string& path, const Execution& run) {
  io::check_file(path);
  const io::Format* const format = io::format_of(path);
  if (!format) io::refuse(path, remedy(io::extension_of(path), path));
  io::begin_progress(run);
  const io::FileBytes file = io::load_file(path);
  if (file.bytes.empty()) io::refuse(path, "is empty: there is nothing to measure");
  Scan scan = format->read(file, stage(run, 0.0, 0.95));
  io::check_unchanged(file);
  check_cancelled(run);
  io::finish(path, scan);
  check_cancelled(run);
  io::end_progress(run);
  return scan;
}

Mesh read_mesh(const std::string& path, const Execution& run) {
  const Scan scan = read_scan(path, run);
  if (!scan.is_mesh()) {
    throw Error(ErrorCode::InvalidData, "'" + path + "' is a cloud, without faces: triangulate it first");
  }
  return mesh_of(scan);
}

const std::vector<std::string>& readable_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> names;
    for (const io::Format& format : io::format_table()) names.push_back(format.extension);
    return names;
  }();
  return extensions;
}

}  // namespace kappa
