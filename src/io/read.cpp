// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/read.hpp"

#include <algorithm>
#include <utility>

#include "columns.hpp"
#include "kappa/core/error.hpp"
#include "las/parse.hpp"
#include "las/read.hpp"
#include "obj/read.hpp"
#include "off/read.hpp"
#include "pace.hpp"
#include "pcd/read.hpp"
#include "ply/read.hpp"
#include "stl/read.hpp"
#include "text/read.hpp"
#include "vtp/read.hpp"

namespace kappa {

namespace {

using Reader = Scan (*)(const io::FileBytes&, const Execution&);

const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> table = {
      {".pcd", io::read_pcd},  {".ply", io::read_ply},  {".obj", io::read_obj},  {".off", io::read_off},
      {".stl", io::read_stl},  {".vtp", io::read_vtp},  {".xyz", io::read_text}, {".pts", io::read_text},
      {".txt", io::read_text}, {".csv", io::read_text}, {".las", io::read_las}};
  return table;
}

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
  std::string known;
  for (const std::string& readable : readable_extensions()) known += (known.empty() ? "" : " ") + readable;
  return "the extension '" + extension + "' is not known: convert it to one of " + known;
}

}  // namespace

Scan read_scan(const std::string& path, const Execution& run) {
  const std::string extension = io::extension_of(path);
  const auto& table = readers();
  const auto reader = std::find_if(table.begin(), table.end(), [&](const auto& r) { return r.first == extension; });
  io::check_file(path);
  if (reader == table.end()) io::refuse(path, remedy(extension, path));
  io::begin_progress(run);
  const io::FileBytes file = io::load_file(path);
  if (file.bytes.empty()) io::refuse(path, "is empty: there is nothing to measure");
  Scan scan = reader->second(file, stage(run, 0.0, 0.95));
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
    for (const auto& reader : readers()) names.push_back(reader.first);
    return names;
  }();
  return extensions;
}

}  // namespace kappa
