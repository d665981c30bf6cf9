// SPDX-License-Identifier: BSD-3-Clause
#include "format_table.hpp"

#include <algorithm>

#include "las/read.hpp"
#include "las/write.hpp"
#include "obj/read.hpp"
#include "off/read.hpp"
#include "pcd/read.hpp"
#include "pcd/write.hpp"
#include "ply/read.hpp"
#include "ply/write.hpp"
#include "stl/read.hpp"
#include "text/read.hpp"
#include "text/write.hpp"
#include "vtp/read.hpp"
#include "vtp/write.hpp"

namespace kappa::io {

const std::vector<Format>& format_table() {
  static const std::vector<Format> table = {
      {".ply", read_ply, write_ply, true}, {".pcd", read_pcd, write_pcd, false}, {".csv", read_text, write_csv, false},
      {".vtp", read_vtp, write_vtp, true}, {".las", read_las, write_las, false}, {".obj", read_obj, nullptr, true},
      {".off", read_off, nullptr, true},   {".stl", read_stl, nullptr, true},    {".xyz", read_text, nullptr, false},
      {".pts", read_text, nullptr, false}, {".txt", read_text, nullptr, false}};
  return table;
}

const Format* format_of(const std::string& path) {
  const std::vector<Format>& table = format_table();
  const std::string extension = extension_of(path);
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Format& f) { return f.extension == extension; });
  return found == table.end() ? nullptr : &*found;
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : " ") + word;
  return list;
}

}  // namespace kappa::io
